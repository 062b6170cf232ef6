// The page: three panes that show the same selected block.

import "./style.css";
import { Backplot } from "./backplot/pane.ts";
import { download } from "./download.ts";
import type { Editor } from "./editor.ts";
import { element } from "./element.ts";
import { Gone, type Host } from "./host.ts";
import type { FormSide } from "./form.ts";
import { Header, without } from "./header.ts";
import { keys } from "./keys.ts";
import { Listing } from "./listing.ts";
import { findingsOf, type Marks, marksOf, noMarks, stops } from "./marks.ts";
import { base, jobName } from "./names.ts";
import { fitNote, noteOf, stoppedNote, verdictNote, whereOf } from "./note.ts";
import { withHandles } from "./panes.ts";
import { Program } from "./program.ts";
import { type Head, Scene, type ToolSize, type Verdict } from "./scene.ts";
import { StateStrip } from "./state.ts";
import { Timeline } from "./timeline.ts";

const PROVING = without("proving…");
const CHECKING = without("checking…");

/** The server's answer for a tab that was closed. */
const NO_JOB = "there is no such job";

/** The finding about a rapid through stock. */
const CRASH = { text: "this rapid goes through stock that is not cut yet", help: "the stock is the box of the cuts, up to the top of the part: look whether the tool is high enough" };

/** The message of an error from the server, in one line. */
export function plain(error: unknown): string {
  const text = error instanceof Error ? error.message : String(error);
  return text.replace(/^error: /, "").replace(/\n\s*help: /, "; ");
}

type From = "form" | "program" | "path" | "key" | "finding" | "time";

/** Milliseconds between two blocks that the program pane shows while the timeline plays. */
const PACE = 100;

export class Page {
  readonly listing = new Listing();
  readonly backplot: Backplot;
  readonly timeline = new Timeline();
  readonly editor: Editor | null;
  readonly header = new Header();
  private readonly state = new StateStrip();
  private readonly foot = element("span", { class: "where", "aria-live": "polite" });
  private readonly timing = element("span", { class: "ms", title: "From the key to the new picture and verdict" });
  private readonly beside = element("span", { class: "beside" });
  readonly keysButton = element("button", { title: "All keys (?)" }, "? keys");
  private readonly banner = element("div", { class: "banner", role: "alert", hidden: "" });

  private head: Head | null = null;
  /** The scene with the program that is shown. */
  private shown: Scene | null = null;
  program: Program | null = null;
  private old: Program | null = null;
  private line = 1;
  private job = 0;
  /** The texts on the disk, and the typed texts that are not saved yet. */
  private saved: Record<string, string> = {};
  private typed: Record<string, string> = {};
  /** The tools of the job, as far as they are known. */
  private sizes: ToolSize[] = [];
  /** Lines whose rapids go through the stock. */
  private crashes = new Set<number>();
  /** Files that were changed both on the disk and here, until the user has chosen which text to keep. */
  private readonly conflicts = new Set<string>();
  /** Replaces the verdict while the current text has no verdict, because the check is running or has failed. */
  private unchecked: Verdict | null = null;
  private running = false;
  private again: { key: number } | null = null;
  private next = { finding: 0, difference: 0 };
  /** The last keystrokes, with the milliseconds until the new picture and the new verdict were painted. */
  readonly painted: { key: number; picture: number; verdict: number }[] = [];

  /** Without a host, the page shows one scene. Without a form side, the page has two panes. */
  constructor(private readonly host: Host | null, private readonly form: FormSide | null) {
    this.editor = form?.editor ?? null;
    this.backplot = new Backplot(form?.solid ?? null);
    const { editor } = this;
    const main = element("main", { class: editor ? "three" : "two" });
    this.backplot.root.append(this.timeline.root);
    withHandles(main, [...(editor ? [editor.root] : []), this.listing.root, this.backplot.root]);
    const help = element("span", { class: "keys" }, "n p block · t T tool · i I item · f F finding · d D change · space play · ", this.keysButton);
    const footer = element("footer", {}, this.foot, help, this.timing, this.beside);
    document.body.append(this.header.root, this.banner, main, this.state.root, footer);
    this.wire();
  }

  private wire(): void {
    const { editor, listing, backplot } = this;
    listing.onPick = (line) => this.choose(line, "program");
    listing.onFound = (line) => this.choose(line, "key");
    listing.onHover = (line) => this.tell(line ?? this.line, line !== null);
    backplot.onPick = (line) => this.choose(line, "path");
    backplot.onHover = (line) => this.tell(line ?? this.line, line !== null);
    backplot.onCrash = (lines) => {
      if (String(lines) === String([...this.crashes])) return;
      this.crashes = new Set(lines);
      this.mark();
    };
    let told = 0;
    this.timeline.onTime = (cursor) => {
      backplot.drawTo(cursor);
      const now = performance.now();
      if (cursor.line === this.line || (this.timeline.isPlaying && now - told < PACE)) return;
      told = now;
      this.choose(cursor.line, "time");
    };
    this.timeline.onEnd = () => this.choose(this.program?.lines ?? 1, "key");
    this.state.onPick = (line) => this.choose(line, "key");
    this.header.verdict.onclick = () => this.explain();
    this.header.fit.onclick = () => {
      const fit = this.head?.fit;
      if (fit) this.listing.note.replaceChildren(...fitNote(fit));
    };
    this.header.lint.onclick = () => this.nextFinding(1);
    this.header.onJob = (job) => void this.showJob(job);
    this.header.saving.onclick = () => void this.save();
    if (editor) {
      this.form!.properties.onChange = () => {
        void this.load();
        void this.otherVerdicts();
      };
      this.form!.kit.onPick = (text) => editor.type(text);
      editor.onEdit = (name, text) => this.edit(name, text);
      editor.onLine = (file, line) => this.chooseFormLine(file, line);
      editor.onHelp = async (at) => (await this.host?.help({ job: this.job, texts: this.typed }, at)) ?? null;
      editor.onFormat = () => void this.form!.layOut(editor, this.host!, { job: this.job, texts: this.typed });
      editor.onCode = (code) => void this.form!.explain(this.host!, this.job, code);
      editor.onSave = () => void this.save();
      editor.onLeave = () => listing.focus();
      editor.onHint = () => (this.foot.textContent = "Esc again: to the keys of the program · Tab: out of the form");
      editor.onOpen = () => {
        this.relight(false);
        if (this.head) editor.setFindings(findingsOf(this.head));
      };
    }
    this.host?.onChange?.((connected) => {
      if (connected) {
        // the next scene removes the message of a failure; other messages stay
        void this.load();
      } else this.failed("postform has ended, or can't be reached");
    });
    window.addEventListener("beforeunload", (event) => {
      if (this.host?.save && !this.host.keeps && Object.keys(this.typed).length) event.preventDefault();
    });
    keys(this);
  }

  /** Shows another job. */
  async showJob(job: number): Promise<void> {
    this.job = job;
    this.program = null;
    this.sizes = [];
    await this.load();
  }

  say(text: string, ...actions: [string, () => void][]): void {
    this.banner.hidden = !text;
    this.banner.replaceChildren(text, ...actions.map(([name, act]) => {
      const button = element("button", {}, name);
      button.onclick = act;
      return button;
    }));
  }

  /** Requests a scene. If a request is running, another request follows. */
  async load(key = 0): Promise<void> {
    if (!this.host) return;
    this.pend(CHECKING);
    if (this.running) {
      this.again = { key };
      return;
    }
    this.running = true;
    try {
      let shown: Head | null = null;
      const before = this.shown;
      const asked = this.job;
      for await (const bytes of this.host.scenes({ job: this.job, texts: this.typed, properties: (this.form?.properties.set ?? []), shown: this.program && this.shown?.head.program, has: before?.head.hashes })) {
        // another job was selected in the meantime
        if (this.job !== asked) break;
        const scene = new Scene(bytes, before);
        // a verdict from before the last keystroke does not apply to the current text
        if (!this.again) this.unchecked = null;
        if (!shown) this.show(scene);
        else this.tellMore(scene);
        shown ??= scene.head;
        if (key) this.measure(key, !!(this.head?.verdict ?? this.head?.stopped));
        // text that was typed in the meantime is checked first
        if (this.again) break;
      }
    } catch (error) {
      // another page may have closed the last tabs
      if (this.job > 0 && plain(error) === NO_JOB) {
        this.job--;
        this.again = { key };
      } else this.failed(plain(error), error instanceof Gone);
    }
    this.running = false;
    const again = this.again;
    this.again = null;
    if (again) void this.load(again.key);
  }

  /** Marks the verdict of this job as pending. If the form has unsaved text, the verdicts of the other jobs are also marked. */
  private pend(text: Verdict): void {
    this.unchecked = text;
    document.body.classList.add("pending");
    this.header.tell(this.job, text);
    this.header.showFit(null);
    if (!Object.keys(this.typed).length) return;
    for (let job = 0; job < this.header.jobs; job++) {
      if (job !== this.job) this.header.mark(job, without("checked when the form is saved"));
    }
  }

  /** Called if the text can't be checked: shows the reason and the possible actions. */
  private failed(why: string, gone = false): void {
    this.pend(without("not checked"));
    const again: [string, () => void] = ["try again", () => void this.load()];
    const typed = Object.values(this.typed);
    const copy: [string, () => void] = ["copy what was typed", () => void navigator.clipboard.writeText(typed.join("\n"))];
    const write: [string, () => void] = ["write it again", () => void this.writeAgain()];
    const more = [...(gone && this.editor && this.host?.save ? [write] : []), ...(typed.length ? [copy] : [])];
    this.say(`Not checked: ${why}.${typed.length ? " What was typed is kept here." : ""}`, again, ...more);
    this.sayingFailed = true;
  }

  private sayingFailed = false;
  /** Called when text was typed. */
  onTyped: () => void = () => {};

  /** Writes a deleted form again, with the text that is shown. */
  private async writeAgain(): Promise<void> {
    const name = this.head?.form?.files[0];
    if (!name) return;
    const text = this.typed[name] ?? this.saved[name] ?? "";
    const wrong = await this.host!.save!(name, text, "");
    if (wrong) return this.say(`${base(name)} was not written: ${wrong}`);
    this.saved[name] = text;
    delete this.typed[name];
    await this.load();
  }

  /** Handles later results for the shown program: the verdict and the changes, which take longer than the picture. */
  private tellMore(scene: Scene): void {
    const { verdict = this.head!.verdict, fit = this.head!.fit, saved = this.head!.saved, against = this.head!.against, toolSizes = this.head!.toolSizes } = scene.head;
    Object.assign(this.head!, { verdict, fit, saved, against, toolSizes });
    if (this.program?.path) this.form?.takeTimes(this.program.path, scene);
    this.mark();
    this.relight(false);
  }

  /** Measures the time from a key until its result is painted. */
  private measure(key: number, proven: boolean): void {
    requestAnimationFrame(() => setTimeout(() => {
      const time = performance.now() - key;
      if (!this.painted.length || this.painted.at(-1)!.key !== key) this.painted.push({ key, picture: time, verdict: 0 });
      if (proven) this.painted.at(-1)!.verdict = time;
      if (this.painted.length > 100) this.painted.shift();
      if (proven) this.timing.textContent = `${time.toFixed(0)} ms`;
    }));
  }

  /** Shows a scene. If nothing can be printed, the previous program stays, in grey. */
  show(scene: Scene): void {
    const head = scene.head;
    this.head = head;
    const first = !this.program;
    this.takeTexts(head);
    // an unchanged program is not sent again
    if (head.same) {
      const { picture, "old/picture": old, toolSizes } = this.shown?.head ?? {};
      Object.assign(head, { picture, "old/picture": old, toolSizes: head.toolSizes ?? toolSizes });
    } else if (head.picture) this.shown = scene;
    document.body.classList.toggle("stale", !!head.stopped);
    if (head.same) {
      // the program stays
    } else if (head.picture) {
      this.crashes = new Set();
      this.program = new Program(scene, "", this.program);
      this.old = scene.has("old/text") ? new Program(scene, "old/", this.old) : null;
    } else if (first || !head.stopped) {
      this.program = this.old = null;
    }
    const tabsChanged = this.titles(head);
    if (this.program?.path) this.form?.takeTimes(this.program.path, scene);
    this.mark();
    if (first && this.program) this.line = this.firstLine();
    this.line = Math.min(this.line, Math.max(1, this.program?.lines ?? 1));
    // at first, the form stays at its first line
    this.choose(this.line, "form", first);
    if (first || tabsChanged) void this.otherVerdicts();
  }

  /** The line to select first: the first difference, otherwise the first cut, preferably a cut that the form printed. */
  private firstLine(): number {
    const difference = this.head?.verdict?.findings[0]?.line || this.head?.picture?.refused?.line;
    if (difference) return difference;
    const path = this.program!.path!;
    const cuts = (kind: number) => (kind & 15) === 1 || (kind & 15) === 2;
    const printed = path.moveKind.findIndex((kind, move) => cuts(kind) && !!this.program!.form(path.moveLine[move]));
    const cut = printed >= 0 ? printed : path.moveKind.findIndex(cuts);
    return cut >= 0 ? path.moveLine[cut] : 1;
  }

  private takeTexts(head: Head): void {
    const names = head.form?.files ?? [];
    if (!this.editor || !names.length) return;
    this.editor.setFiles(names, names.map((name, i) => this.typed[name] ?? head.texts?.[i] ?? ""));
    names.forEach((name, i) => {
      const text = (head.texts?.[i] ?? "").replace(/\r\n?/g, "\n");
      const before = this.saved[name];
      this.saved[name] = text;
      if (before === undefined || before === text) return;
      if (this.typed[name] === undefined) this.editor!.replace(name, text);
      else if (this.typed[name] !== text) {
        this.conflicts.add(name);
        this.sayConflict(name);
      } else delete this.typed[name];
    });
    this.header.saving.hidden = !this.host?.save || !Object.keys(this.typed).length;
  }

  private sayConflict(name: string): void {
    const settled = () => {
      this.conflicts.delete(name);
      this.say("");
    };
    this.say(`${base(name)} was changed on the disk, and here, too.`, ["take the disk's", () => {
      delete this.typed[name];
      this.editor!.replace(name, this.saved[name]);
      settled();
      void this.load();
    }], ["keep mine", settled]);
  }

  private titles(head: Head): boolean {
    const changed = this.header.show(head, this.job);
    this.listing.fileName = `${jobName(head.job.name) || "program"}.nc`;
    if (!head.form) return changed;
    this.form?.properties.show(head.form.properties, head.picture?.units ?? this.shown?.head.picture?.units ?? "");
    this.form?.kit.show(head.form.kit);
    return changed;
  }

  /** Requests the verdicts of the jobs that are not shown. */
  private async otherVerdicts(): Promise<void> {
    const run = ++this.verdictRun;
    for (let job = 0; job < this.header.jobs; job++) {
      if (job === this.job || !this.host) continue;
      const verdict = await this.host.verdict(job, (this.form?.properties.set ?? [])).catch((error) => without(plain(error)));
      // the tabs, the form or its properties have changed in the meantime
      if (run !== this.verdictRun) return;
      this.header.mark(job, verdict);
    }
  }

  private verdictRun = 0;

  /** Marks differences, changes and findings in the panes. */
  private mark(): void {
    const head = this.head!;
    const waits = !!this.host && !!head.picture && !head.stopped && !head.verdict;
    document.body.classList.toggle("pending", !!this.unchecked);
    if (this.unchecked) this.header.tell(this.job, this.unchecked);
    else this.header.tell(this.job, waits ? PROVING : head.verdict, head.stopped);
    if (!this.unchecked && this.sayingFailed) {
      this.sayingFailed = false;
      this.say("");
    }
    this.header.showFit(head.stopped || this.unchecked ? null : head.fit);
    const marks = marksOf(head, this.old);
    for (const line of this.crashes) if (!marks.bad.has(line)) marks.bad.set(line, CRASH);
    const picture = head.picture;
    const count = picture ? `${picture.blocks} blocks · ${picture.time}` : "";
    this.marks = marks;
    this.listing.show(this.program, marks, count, this.old, head.against?.hunks ?? []);
    this.backplot.show(this.program, this.old, [...marks.bad.keys()], (this.sizes = head.toolSizes ?? this.sizes));
    this.timeline.show(this.program);
    this.editor?.setFindings(findingsOf(head));
    const besides = [];
    if (head.saved?.blocks) besides.push(`${head.saved.blocks} block${head.saved.blocks > 1 ? "s" : ""} changed since the last save`);
    if (head.against) {
      const { blocks, name } = head.against;
      besides.push(`against ${base(name ?? "")}: ${blocks === 0 ? "no block differs" : blocks === 1 ? "1 block differs" : `${blocks} blocks differ`}`);
    }
    this.beside.textContent = besides.join(" · ");
  }

  private marks: Marks = noMarks();

  /** Shows a block in all panes. */
  choose(line: number, from: From, scrolls = true): void {
    this.line = Math.max(1, Math.min(line, this.program?.lines ?? 1));
    const form = this.program?.form(this.line);
    const sameLine = form ? this.program!.printedBy(form.file, form.line) : [];
    this.listing.choose(this.line, sameLine.length < 5000 ? sameLine : [], scrolls && from !== "program");
    this.backplot.choose(this.line, sameLine.length < 500 ? sameLine : []);
    if (from !== "time") {
      this.timeline.chose(this.line);
      this.backplot.drawTo(null);
    }
    this.relight(scrolls && from !== "form");
    this.state.show(this.program, this.line);
    this.tell(this.line, false);
  }

  private relight(scrolls: boolean): void {
    const form = this.program?.form(this.line);
    const bad = (this.head?.verdict?.findings ?? []).flatMap((found) => (found.form ? [{ file: found.form[0], line: found.form[1] }] : []));
    this.editor?.light(form ? [form] : [], bad, scrolls);
  }

  /** Selects the next block that a clicked line of the form printed. */
  private chooseFormLine(file: number, line: number): void {
    const printed = this.program?.printedBy(file, line) ?? [];
    if (!printed.length) {
      if (this.program) this.foot.textContent = `line ${line + 1} of the form printed no block here`;
      return;
    }
    const form = this.program!.form(this.line);
    if (form && form.file === file && form.line === line) return;
    this.choose(printed.find((at) => at > this.line) ?? printed[0], "form");
  }

  /** Describes a block in the note and the footer. */
  private tell(line: number, hovers: boolean): void {
    const program = this.program;
    const stopped = stoppedNote(this.head?.stopped?.findings ?? []);
    if (!program) {
      this.listing.note.replaceChildren(...stopped);
      this.foot.textContent = "";
      return;
    }
    this.listing.note.replaceChildren(...stopped, ...noteOf(program, line, this.marks, this.formText(line)), ...this.decidedBy(line));
    this.foot.textContent = (hovers ? "pointer at " : "") + whereOf(program, line);
  }

  /** Buttons for the form lines that determine the words of a block; a click shows the line. */
  private decidedBy(line: number): HTMLElement[] {
    const head = this.head?.form;
    if (!this.editor || !head?.formats || !this.program) return [];
    const texts = head.files.map((name) => this.typed[name] ?? this.saved[name] ?? "");
    const buttons = this.form!.sourcesOf(this.program.text(line), head.formats, texts).map(({ word, file, line, text }) => {
      const button = element("button", { title: `decides how ${word} is printed: line ${line + 1} of the form` }, element("code", {}, text));
      button.onclick = () => {
        this.editor!.goTo([file, line, 0, line, text.length]);
        this.editor!.view.focus();
      };
      return button;
    });
    return buttons.length ? [element("div", { class: "decided" }, "formats and commands: ", ...buttons)] : [];
  }

  /** The line of the form that printed a block. */
  private formText(line: number): string {
    const form = this.program?.form(line);
    if (!form) return "";
    if (this.editor && form.file === this.shownFile()) return this.editor.lineText(form.line);
    return (this.saved[this.head?.form?.files[form.file] ?? ""] ?? "").split("\n")[form.line] ?? "";
  }

  private shownFile(): number {
    return this.head?.form?.files.indexOf(this.editor?.name ?? "") ?? 0;
  }

  // functions of the keys

  step(by: number): void {
    this.choose(this.line + by, "key");
  }

  /** Selects the next block at which `same` is false. */
  seek(by: number, same: (a: number, b: number) => boolean): void {
    const last = this.program?.lines ?? 0;
    for (let line = this.line + by; line >= 1 && line <= last; line += by) {
      if (same(line, line - 1)) continue;
      return this.choose(line, "key");
    }
  }

  nextTool(by: number): void {
    this.seek(by, (line) => this.program!.held("tool", line)?.line !== line);
  }

  nextItem(by: number): void {
    this.seek(by, (line, before) => !this.program!.item(line) || this.program!.sameItem(line, before));
  }

  nextFinding(by: number): void {
    const all = (this.head ? findingsOf(this.head) : []).filter((found) => found.labels.length);
    if (!all.length || !this.editor) return;
    this.next.finding = (this.next.finding + by + all.length) % all.length;
    const found = all[(this.next.finding - 1 + all.length) % all.length];
    this.editor.goTo(found.labels[0].at);
    this.listing.note.replaceChildren(element("div", {}, element("b", {}, found.code), ` ${found.message}`), element("div", { class: "dim" }, found.help ?? ""));
    this.editor.view.focus();
  }

  /** Explains the verdict: steps through its findings, or shows the first block that is not proven, or the allowances. */
  private explain(): void {
    const verdict = this.head?.verdict;
    const bad = [...this.marks.bad.keys()].sort((a, b) => a - b);
    if (bad.length) return this.choose(bad.find((line) => line > this.line) ?? bad[0], "finding");
    if (!verdict || this.head?.stopped || this.unchecked) return;
    if (verdict.line) this.choose(verdict.line, "finding");
    this.listing.note.replaceChildren(...verdictNote(verdict));
  }

  nextDifference(by: number): void {
    const lines = stops(this.marks);
    if (!lines.length) return;
    const found = by > 0 ? lines.find((line) => line > this.line) ?? lines[0] : lines.findLast((line) => line < this.line) ?? lines[lines.length - 1];
    this.choose(found, "finding");
  }

  play(): void {
    this.timeline.toggle();
  }

  /** Starts again with other files of the host and with unsaved texts. */
  async reopen(typed: Record<string, string>): Promise<void> {
    this.program = this.old = this.head = this.shown = null;
    [this.job, this.line, this.saved, this.typed] = [0, 1, {}, { ...typed }];
    this.conflicts.clear();
    this.header.forgetJobs();
    this.editor?.forget();
    this.form?.properties.forget();
    this.say("");
    await this.load();
  }

  /** The unsaved texts of forms, by their names. */
  get texts(): Record<string, string> {
    return this.typed;
  }

  get shownJob(): number {
    return this.job;
  }

  /** Asks whether unsaved text may be lost. */
  mayLeave(): boolean {
    const names = Object.keys(this.typed).map(base);
    return !names.length || confirm(`What was typed in ${names.join(", ")} will be lost. Go on?`);
  }

  downloadForm(): void {
    if (this.editor) download(base(this.editor.name), this.editor.text);
  }

  private edit(name: string, text: string): void {
    const key = performance.now();
    if (text === this.saved[name]) delete this.typed[name];
    else this.typed[name] = text;
    this.header.saving.hidden = !this.host?.save || !Object.keys(this.typed).length;
    void this.load(key);
    this.onTyped();
    if (!Object.keys(this.typed).length) void this.otherVerdicts();
  }

  async save(): Promise<void> {
    if (!this.host?.save || this.saves) return;
    this.saves = true;
    try {
      await this.saveTyped();
    } catch (error) {
      this.say(`Not saved: ${error instanceof Error ? error.message : String(error)}. What was typed is kept here.`, ["try again", () => void this.save()]);
    }
    this.saves = false;
  }

  private saves = false;

  private async saveTyped(): Promise<void> {
    if (!this.host?.save) return;
    const names = Object.keys(this.typed).map(base);
    for (const [name, text] of Object.entries(this.typed)) {
      if (this.conflicts.has(name)) return this.sayConflict(name);
      const wrong = await this.host.save(name, text, this.saved[name] ?? "");
      if (wrong) return this.say(`${base(name)} was not saved: ${wrong}`);
      this.saved[name] = text;
      delete this.typed[name];
    }
    this.header.saving.hidden = true;
    this.say("");
    await this.load();
    this.foot.textContent = `${names.join(", ")} ${names.length > 1 ? "are" : "is"} saved`;
    void this.otherVerdicts();
  }
}
