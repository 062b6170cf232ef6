// The form pane: CodeMirror with findings below the words. The lines that printed the selected block are highlighted.

import { completionKeymap } from "@codemirror/autocomplete";
import { defaultKeymap, history, historyKeymap, indentLess, indentMore } from "@codemirror/commands";
import { bracketMatching, HighlightStyle, StreamLanguage, syntaxHighlighting } from "@codemirror/language";
import { type Diagnostic, lintGutter, setDiagnostics } from "@codemirror/lint";
import { highlightSelectionMatches, searchKeymap } from "@codemirror/search";
import { EditorState, RangeSetBuilder, StateEffect, StateField, Text } from "@codemirror/state";
import {
  Decoration, type DecorationSet, drawSelection, EditorView, highlightActiveLine, highlightActiveLineGutter, keymap, lineNumbers,
} from "@codemirror/view";
import { tags } from "@lezer/highlight";

import { element } from "./element.ts";
import { help } from "./help.ts";
import type { At, Help } from "./host.ts";
import { indentation } from "./indent.ts";
import { base } from "./names.ts";
import type { Finding, Place } from "./scene.ts";

interface Lit {
  /** Lines, counted from 0: `lines` printed the selected block, and `bad` printed differences. */
  lines: number[];
  bad: number[];
}

const light = StateEffect.define<Lit>();
const litLine = Decoration.line({ class: "cm-lit" });
const badLine = Decoration.line({ class: "cm-bad" });
const litLines = StateField.define<DecorationSet>({
  create: () => Decoration.none,
  update(lit, transaction) {
    for (const effect of transaction.effects) if (effect.is(light)) return lines(transaction.state.doc, effect.value);
    return lit.map(transaction.changes);
  },
  provide: (field) => EditorView.decorations.from(field),
});

function lines(doc: Text, { lines, bad }: Lit): DecorationSet {
  const builder = new RangeSetBuilder<Decoration>();
  for (const line of [...new Set([...lines, ...bad])].sort((a, b) => a - b)) {
    if (line >= doc.lines) continue;
    const at = doc.line(line + 1).from;
    builder.add(at, at, bad.includes(line) ? badLine : litLine);
  }
  return builder.finish();
}

/** Tokens of a form, as far as they can be recognised from a single line. */
const language = StreamLanguage.define<{ open: boolean }>({
  startState: () => ({ open: false }),
  token(stream, state) {
    if (stream.sol()) {
      stream.eatSpace();
      if (stream.match(/#.*/)) return "comment";
      if (stream.match(/End\b.*/i)) {
        state.open = false;
        return "keyword";
      }
      // the name of a sequence is alone on its line, a setting is followed by its value
      if (!state.open && stream.match(/[A-Za-z0-9]+[ \t]*$/)) {
        state.open = true;
        return "keyword";
      }
      if (!state.open && stream.match(/(Custom\d+|Upon)\b.*/i)) {
        state.open = true;
        return "keyword";
      }
      if (!state.open && stream.match(/[A-Za-z0-9]+/)) return "propertyName";
    }
    if (stream.match(/\[[^\]]*\]?/)) return "variableName";
    if (stream.match(/ {2,}.*|\t.*/)) return state.open ? "comment" : null;
    if (stream.match(/ #.*/)) return "comment";
    if (stream.match(/\([^)]*\)?/)) return "comment";
    stream.next();
    return null;
  },
});

const look = HighlightStyle.define([
  { tag: tags.keyword, color: "var(--key)", fontWeight: "600" },
  { tag: tags.propertyName, color: "var(--ink)" },
  { tag: tags.variableName, color: "var(--var)", fontWeight: "500" },
  { tag: tags.comment, color: "var(--dim)" },
]);

export class Editor {
  readonly root: HTMLElement;
  readonly view: EditorView;
  private readonly head = element("span", {});
  private readonly tabs = element("div", { class: "files", role: "tablist", "aria-label": "Files of the form" });
  private readonly states = new Map<string, EditorState>();
  private names: string[] = [];
  private file = 0;
  private quiet = false;
  /** The findings and the highlighted lines that are shown, as JSON, each with the text to which they belong. */
  private readonly shown: Record<string, { text: Text; what: string }> = {};
  onEdit: (name: string, text: string) => void = () => {};
  onLine: (file: number, line: number) => void = () => {};
  onSave: () => void = () => {};
  onLeave: () => void = () => {};
  /** Called to format the form in the canonical layout. */
  onFormat: () => void = () => {};
  /** Called when the code of a finding is clicked. */
  onCode: (code: string) => void = () => {};
  /** Called when Esc was pressed once, so that the page explains the second press. */
  onHint: () => void = () => {};
  private escaped = -Infinity;
  /** The help for a location in the file that is shown. */
  onHelp: (at: At) => Promise<Help | null> = () => Promise.resolve(null);

  constructor(readonly isEditable: boolean) {
    const holder = element("div", { class: "editor" });
    this.root = element("section", { class: "form", "aria-label": "Form" }, element("h2", {}, "Form", this.tabs, this.head), holder);
    this.view = new EditorView({ parent: holder, state: this.fresh("") });
  }

  /** The name of the file that is shown. */
  get name(): string {
    return this.names[this.file] ?? "";
  }

  get text(): string {
    return this.view.state.doc.toString();
  }

  get hasFocus(): boolean {
    return this.view.hasFocus;
  }

  private fresh(text: string): EditorState {
    return EditorState.create({
      doc: text,
      extensions: [
        lineNumbers(), highlightActiveLineGutter(), history(), drawSelection(), bracketMatching(), highlightActiveLine(),
        help((at) => this.onHelp({ ...at, file: this.name })),
        highlightSelectionMatches(), lintGutter(), litLines, language, indentation, syntaxHighlighting(look),
        EditorState.readOnly.of(!this.isEditable),
        EditorView.contentAttributes.of({ "aria-label": "Form", spellcheck: "false", tabindex: "0" }),
        keymap.of([
          { key: "Shift-Alt-f", run: () => (this.onFormat(), true), preventDefault: true },
          { key: "Mod-s", run: () => (this.onSave(), true), preventDefault: true },
          ...completionKeymap,
          { key: "Escape", run: () => this.escape() },
          ...defaultKeymap, ...historyKeymap, ...searchKeymap,
          { key: "Tab", run: (view) => this.indents(view.state) && indentMore(view), shift: (view) => this.indents(view.state) && indentLess(view) },
        ]),
        EditorView.updateListener.of((update) => {
          if (update.focusChanged) this.writes = false;
          if (this.quiet) return;
          if (update.docChanged) {
            this.writes = true;
            this.onEdit(this.name, this.text);
          }
          else if (update.selectionSet && update.view.hasFocus) {
            this.onLine(this.file, update.state.doc.lineAt(update.state.selection.main.head).number - 1);
          }
        }),
      ],
    });
  }

  /** Whether text was typed since the cursor entered the form. */
  private writes = false;

  /** Does Tab indent? Without a selection and without typed text, Tab moves to the next pane. */
  private indents(state: EditorState): boolean {
    return this.isEditable && (this.writes || !state.selection.main.empty);
  }

  /** Pressing Esc twice leaves the form, because a single press may only close a list. */
  private escape(): boolean {
    const now = performance.now();
    const again = now - this.escaped < 2000;
    this.escaped = again ? -Infinity : now;
    if (again) this.onLeave();
    else this.onHint();
    return false;
  }

  /** Sets the files of the form; texts that already exist stay as typed. */
  setFiles(names: string[], texts: string[]): void {
    const same = names.length === this.names.length && names.every((name, i) => name === this.names[i]);
    names.forEach((name, i) => {
      if (!this.states.has(name)) this.states.set(name, this.fresh(texts[i] ?? ""));
    });
    if (same) return;
    const shown = this.name;
    // keeps the typed text and its undo history
    if (shown) this.states.set(shown, this.view.state);
    this.names = names;
    this.file = -1;
    this.open(Math.max(0, names.indexOf(shown)));
    this.tabs.hidden = names.length < 2;
    this.tabs.replaceChildren(...names.map((name, i) => {
      const tab = element("button", { role: "tab", "aria-selected": String(i === this.file), title: name }, base(name));
      tab.onclick = () => this.open(i);
      return tab;
    }));
  }

  /** Replaces the text of a file with the text on the disk. */
  replace(name: string, text: string): void {
    if (name === this.name) {
      this.quiet = true;
      const top = this.view.scrollDOM.scrollTop;
      const at = Math.min(this.view.state.selection.main.head, text.length);
      this.view.dispatch({ changes: { from: 0, to: this.view.state.doc.length, insert: text }, selection: { anchor: at } });
      this.view.scrollDOM.scrollTop = top;
      this.quiet = false;
    } else {
      this.states.set(name, this.fresh(text));
    }
  }

  /** Inserts text into the file as if it were typed. */
  type(text: string): void {
    this.view.dispatch({ changes: { from: 0, to: this.view.state.doc.length, insert: text }, selection: { anchor: 0 }, scrollIntoView: true });
    this.view.focus();
  }

  /** Replaces the text by another layout of it. Equal text at the beginning and the end is kept, and so is the cursor. */
  layOut(text: string): void {
    const old = this.text;
    let from = 0;
    while (from < old.length && old[from] === text[from]) from++;
    let rest = 0;
    while (rest < old.length - from && rest < text.length - from && old[old.length - 1 - rest] === text[text.length - 1 - rest]) rest++;
    if (old !== text) this.view.dispatch({ changes: { from, to: old.length - rest, insert: text.slice(from, text.length - rest) } });
  }

  /** Forgets all files. */
  forget(): void {
    this.states.clear();
    [this.names, this.file] = [[], 0];
  }

  private open(file: number): void {
    if (file === this.file || !this.names[file]) return;
    if (this.names[this.file]) this.states.set(this.name, this.view.state);
    this.file = file;
    this.quiet = true;
    this.view.setState(this.states.get(this.names[file])!);
    this.quiet = false;
    [...this.tabs.children].forEach((tab, i) => tab.setAttribute("aria-selected", String(i === file)));
    this.onOpen();
  }

  /** Called when another file is shown: findings and highlighted lines must be set again. */
  onOpen: () => void = () => {};

  private offset(line: number, column: number): number {
    const { doc } = this.view.state;
    if (line >= doc.lines) return doc.length;
    const at = doc.line(line + 1);
    return Math.min(at.from + column, at.to);
  }

  private range([, line, column, endLine, endColumn]: Place): [number, number] {
    const from = this.offset(line, column);
    const to = this.offset(endLine, endColumn);
    // an empty range is shown as one character
    return to > from ? [from, to] : [from, Math.min(from + 1, this.view.state.doc.length)];
  }

  /** Marks findings under their words, with their fixes. */
  setFindings(findings: Finding[]): void {
    const here = findings.filter((finding) => finding.labels[0]?.at[0] === this.file);
    if (this.shows("findings", here)) return;
    const diagnostics: Diagnostic[] = here.map((finding) => {
      const [from, to] = this.range(finding.labels[0].at);
      const severity = { error: "error", warning: "warning", note: "info" }[finding.severity] as Diagnostic["severity"];
      const fix = this.isEditable ? finding.fix : null;
      return {
        from, to, severity, message: finding.message,
        renderMessage: () => told(finding, this.onCode),
        actions: fix ? [{ name: fix.title, apply: () => this.fix(fix.edits) }] : [],
      };
    });
    diagnostics.sort((a, b) => a.from - b.from);
    this.quiet = true;
    this.view.dispatch(setDiagnostics(this.view.state, diagnostics));
    this.quiet = false;
  }

  private fix(edits: { at: Place; text: string }[]): void {
    const here = edits.filter((edit) => edit.at[0] === this.file);
    this.view.dispatch({ changes: here.map(({ at, text }) => ({ from: this.offset(at[1], at[2]), to: this.offset(at[3], at[4]), insert: text })) });
  }

  /** Highlights the form lines that printed the selected block (`lit`) and the form lines with differences (`bad`). */
  light(lit: { file: number; line: number }[], bad: { file: number; line: number }[], scrolls: boolean): void {
    const first = lit[0];
    if (scrolls && first && first.file !== this.file) this.open(first.file);
    const here = (places: { file: number; line: number }[]) => places.filter((place) => place.file === this.file).map((place) => place.line);
    const lights = { lines: here(lit), bad: here(bad) };
    this.head.textContent = first ? `printed by line ${first.line + 1}` : "";
    if (this.shows("light", lights) && !scrolls) return;
    const effects: StateEffect<unknown>[] = [light.of(lights)];
    if (scrolls && first && first.line < this.view.state.doc.lines) {
      const at = this.view.state.doc.line(first.line + 1).from;
      effects.push(EditorView.scrollIntoView(at, { y: "nearest", yMargin: 60 }));
    }
    this.quiet = true;
    this.view.dispatch({ effects });
    this.quiet = false;
  }

  /** Whether these findings or lines are shown already for the same text. Showing them again would cost a layout of the page. */
  private shows(kind: "findings" | "light", shown: unknown): boolean {
    const now = { text: this.view.state.doc, what: JSON.stringify(shown) };
    const before = this.shown[kind];
    this.shown[kind] = now;
    return now.text === before?.text && now.what === before.what;
  }

  /** Moves the cursor to a finding. */
  goTo(at: Place): void {
    this.open(at[0]);
    const [from, to] = this.range(at);
    this.view.dispatch({ selection: { anchor: from, head: to }, effects: EditorView.scrollIntoView(from, { y: "center" }) });
  }

  lineText(line: number): string {
    return line < this.view.state.doc.lines ? this.view.state.doc.line(line + 1).text : "";
  }
}

function told(finding: Finding, onCode: (code: string) => void): HTMLElement {
  const code = element("button", { class: "code-name", title: `What ${finding.code} means` }, finding.code);
  code.onclick = () => onCode(finding.code);
  const text = element("div", { class: "told" }, code, ` ${finding.message}`);
  if (finding.help) text.append(element("div", { class: "help" }, finding.help));
  return text;
}
