// Help in the form pane: the possible words at a location, and the meaning of the word under the pointer.

import { autocompletion, type Completion, type CompletionContext, type CompletionResult, snippet } from "@codemirror/autocomplete";
import type { Extension } from "@codemirror/state";
import { type EditorView, hoverTooltip } from "@codemirror/view";

import { element } from "./element.ts";
import type { At, Help } from "./host.ts";

/** Requests help for a location in the file that is shown. */
export type Ask = (at: Omit<At, "file">) => Promise<Help | null>;

export function help(ask: Ask): Extension {
  return [
    autocompletion({ override: [(context) => complete(context, ask)], icons: false, maxRenderedOptions: 60 }),
    hoverTooltip(async (view, pos) => {
      const told = await ask({ ...placeOf(view, pos), ask: "hover" }).catch(() => null);
      if (!told?.text || !told.at) return null;
      const [, line, column, endLine, endColumn] = told.at;
      const text = told.text;
      return {
        pos: offset(view, line, column), end: offset(view, endLine, endColumn), above: true,
        create: () => ({ dom: element("div", { class: "known" }, ...markdown(text)) }),
      };
    }, { hoverTime: 500 }),
  ];
}

async function complete(context: CompletionContext, ask: Ask): Promise<CompletionResult | null> {
  const line = context.state.doc.lineAt(context.pos);
  const before = line.text.slice(0, context.pos - line.from);
  // completions are offered only after the beginning of a word, bracket or code, or on explicit request
  if (!context.explicit && !/\[[\w#]*$|(^|\s)[GM]\d+$|^\s*\w{2,}$|^\s*(End|Control|Machine|Units)\s+\w*$|@\w*$|^\s*@for\s+\w*$/.test(before)) return null;
  const told = await ask({ line: line.number - 1, column: before.length, ask: "complete" }).catch(() => null);
  const list = told?.list ?? [];
  if (!list.length || context.aborted) return null;
  const from = line.from + list[0].at[2];
  const options = list.map((found, at): Completion => ({
    label: found.label, detail: found.detail, boost: -at / 1000, type: found.kind,
    info: found.info ? () => element("div", { class: "known" }, ...markdown(found.info!)) : undefined,
    apply: found.snippet ? snippet(found.snippet.replace(/\$(\d+)/g, "$${$1}").replace(/\$\{0\}/g, "${}")) : found.text,
  }));
  return { from, options, validFor: /^\[?[\w#]*$/ };
}

function placeOf(view: EditorView, pos: number): { line: number; column: number } {
  const line = view.state.doc.lineAt(pos);
  return { line: line.number - 1, column: pos - line.from };
}

function offset(view: EditorView, line: number, column: number): number {
  const { doc } = view.state;
  if (line >= doc.lines) return doc.length;
  const at = doc.line(line + 1);
  return Math.min(at.from + column, at.to);
}

/** Converts the Markdown that postform writes: code blocks, rules, code, bold and italic words, and escaped characters. */
export function markdown(text: string): HTMLElement[] {
  return text.split(/^```.*$/m).flatMap((part, at): HTMLElement[] => {
    if (!part.trim()) return [];
    if (at % 2) return [element("pre", {}, part.replace(/^\n|\n$/g, ""))];
    return part.trim().split(/\n{2,}/).map((paragraph) => (paragraph === "---" ? element("hr", {}) : element("p", {}, ...words(paragraph))));
  });
}

function words(text: string): (Node | string)[] {
  const parts = text.match(/`[^`]+`|\*\*(?:\\.|[^*\\])+\*\*|\*(?:\\.|[^*\\])+\*|\\.|[^`*\\]+|[^]/g) ?? [];
  const plain = (part: string) => part.replace(/\\(.)/g, "$1");
  return parts.map((part) => {
    if (part.length > 2 && part.startsWith("`")) return element("code", {}, part.slice(1, -1));
    if (part.length > 4 && part.startsWith("**")) return element("b", {}, plain(part.slice(2, -2)));
    if (part.length > 2 && part.startsWith("*")) return element("em", {}, plain(part.slice(1, -1)));
    return plain(part);
  });
}
