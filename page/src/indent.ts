// The indentation of lines between @if or @for and @end, as in `postform fmt`.

import { getIndentUnit, indentOnInput, indentService } from "@codemirror/language";
import { EditorState } from "@codemirror/state";

const OPENS = /^\s*@(if|elif|else|for)\b/i;
const CLOSES = /^\s*@(end|else|elif)/i;

export const indentation = [
  indentService.of((context, at) => {
    const { doc } = context.state;
    const unit = getIndentUnit(context.state);
    const own = doc.lineAt(at);
    // the indentation of a new line depends on the text before the line break; the indentation of a typed line depends on the previous line with text
    const isNew = context.simulatedBreak === at;
    let before = isNew ? own.text.slice(0, at - own.from) : "";
    for (let line = own.number - 1; line > 0 && !before.trim(); line--) before = doc.line(line).text;
    const after = isNew ? own.text.slice(at - own.from) : own.text;
    const inside = before.search(/\S|$/) + (OPENS.test(before) ? unit : 0);
    return Math.max(0, inside - (CLOSES.test(after) ? unit : 0));
  }),
  indentOnInput(),
  EditorState.languageData.of(() => [{ indentOnInput: /^\s*@(end|else|elif)$/i }]),
];
