// The page: three panes with one cursor.

import "./style.css";
import { Backplot } from "./backplot/pane.ts";
import type { Editor } from "./editor.ts";
import { element } from "./element.ts";
import { Gone, type Host } from "./host.ts";
import { keys } from "./keys.ts";
import { Listing } from "./listing.ts";
import { findingsOf, type Marks, marksOf, noMarks, stops } from "./marks.ts";
import { base, jobName } from "./names.ts";
import { fitNote, noteOf, stoppedNote, verdictNote, whereOf } from "./note.ts";
import { Program } from "./program.ts";
import { type Head, Scene, type Verdict } from "./scene.ts";
import { StateStrip } from "./state.ts";

/** In place of a verdict. */
const without = (text: string): Verdict => ({ kind: "none", text, line: 0, help: "", allowed: [], findings: [] });
const PROVING = without("proving…");
const CHECKING = without("checking…");

type From = "form" | "program" | "path" | "key" | "finding";

export class Page {
  readonly listing = new Listing();
  readonly backplot = new Backplot();
  private readonly state = new StateStrip();
  private readonly title = element("h1", {});
  private readonly verdict = element("button", { class: "verdict" });
  private readonly fit = element("button", { class: "fit", hidden: "" });
  private readonly lint = element("button", { class: "lint" });
  private readonly tabs = element("div", { class: "tabs", role: "tablist", "aria-label": "Jobs" });
  private readonly foot = element("span", { class: "where", "aria-live": "polite" });
  private readonly timing = element("span", { class: "ms", title: "From the key to the new picture and verdict" });
  private readonly beside = element("span", { class: "beside" });
  private readonly saving = element("button", { class: "save", hidden: "" }, "save");
  private readonly banner = element("div", { class: "banner", role: "alert", hidden: "" });

  private head: Head | null = null;
  /** The head with which the program came that is shown. */
  private shown: Head | null = null;
  program: Program | null = null;
  private old: Program | null = null;
  private line = 1;
  private job = 0;
  /** Texts that are on the disk, and those that were typed and not saved. */
  private saved: Record<string, string> = {};
  private typed: Record<string, string> = {};
  /** Files that are other on the disk than what was typed began with, and nobody said yet which is to stay. */
  private readonly conflicts = new Set<string>();
  /** What is shown in place of a verdict while there is none of the very text that is shown: it is being checked, or could not be. */
  private unchecked: Verdict | null = null;
  private running = false;
  private again: { key: number } | null = null;
  private playing = 0;
  private next = { finding: 0, difference: 0 };
  /** When a key was pressed, and milliseconds from it until the new picture and the new verdict were painted: the last ones. */
  readonly painted: { key: number; picture: number; verdict: number }[] = [];

  /** Without a host the page shows one scene; without an editor it has two panes. */
  constructor(private readonly host: Host | null, readonly editor: Editor | null) {
    const header = element("header", {}, this.title, this.saving, this.verdict, this.fit, this.lint, this.tabs);
    const main = element("main", { class: editor ? "three" : "two" });
    if (editor) main.append(editor.root);
    main.append(this.listing.root, this.backplot.root);
    const help = element("span", { class: "keys" }, "n p block · t T tool · i I item · f F finding · d D change · space play · ? keys");
    const footer = element("footer", {}, this.foot, help, this.timing, this.beside);
    document.body.append(header, this.banner, main, this.state.root, footer);
    this.wire();
  }

  private wire(): void {
    const { editor, listing, backplot } = this;
    listing.onPick = (line) => this.choose(line, "program");
    listing.onHover = (line) => this.tell(line ?? this.line, line !== null);
    backplot.onPick = (line) => this.choose(line, "path");
    backplot.onHover = (line) => this.tell(line ?? this.line, line !== null);
    this.state.onPick = (line) => this.choose(line, "key");
    this.verdict.onclick = () => this.explain();
    this.fit.onclick = () => {
      const fit = this.head?.fit;
      if (fit) this.listing.note.replaceChildren(...fitNote(fit));
    };
    this.lint.onclick = () => this.nextFinding(1);
    this.saving.onclick = () => void this.save();
    if (editor) {
      editor.onEdit = (name, text) => this.edit(name, text);
      editor.onLine = (file, line) => this.chooseFormLine(file, line);
      editor.onHelp = async (at) => (await this.host?.help({ job: this.job, texts: this.typed }, at)) ?? null;
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
        this.say("");
        void this.load();
      } else this.failed("postform has ended, or can't be reached");
    });
    window.addEventListener("beforeunload", (event) => {
      if (this.host?.save && Object.keys(this.typed).length) event.preventDefault();
    });
    keys(this);
  }

  say(text: string, ...actions: [string, () => void][]): void {
    this.banner.hidden = !text;
    this.banner.replaceChildren(text, ...actions.map(([name, act]) => {
      const button = element("button", {}, name);
      button.onclick = act;
      return button;
    }));
  }

  /** Asks for the scene again; while one is on its way, once more after it. */
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
      for await (const bytes of this.host.scenes({ job: this.job, texts: this.typed, shown: this.program && this.shown?.program })) {
        const scene = new Scene(bytes);
        // a verdict of what was there before the last key is none of what is there now
        if (!this.again) this.unchecked = null;
        if (!shown) this.show(scene);
        else this.tellMore(scene.head);
        shown ??= scene.head;
        if (key) this.measure(key, !!(this.head?.verdict ?? this.head?.stopped));
        // what was typed meanwhile is more important than what is said of what was there before
        if (this.again) break;
      }
    } catch (error) {
      this.failed(error instanceof Error ? error.message : String(error), error instanceof Gone);
    }
    this.running = false;
    const again = this.again;
    this.again = null;
    if (again) void this.load(again.key);
  }

  /** No verdict holds any more: not of this job, nor of the others where the form was changed. */
  private pend(text: Verdict): void {
    this.unchecked = text;
    document.body.classList.add("pending");
    this.sayVerdict(text);
    this.fit.hidden = true;
    if (!Object.keys(this.typed).length) return;
    for (let job = 0; job < this.tabs.childElementCount; job++) {
      if (job !== this.job) this.tabVerdict(job, without("checked when the form is saved"));
    }
  }

  /** The text can't be checked: why, and a way out. */
  private failed(why: string, gone = false): void {
    this.pend(without("not checked"));
    const again: [string, () => void] = ["try again", () => void this.load()];
    const typed = Object.values(this.typed);
    const copy: [string, () => void] = ["copy what was typed", () => void navigator.clipboard.writeText(typed.join("\n"))];
    const write: [string, () => void] = ["write it again", () => void this.writeAgain()];
    const more = [...(gone && this.editor && this.host?.save ? [write] : []), ...(typed.length ? [copy] : [])];
    this.say(`Not checked: ${why.replace(/^error: /, "")}.${typed.length ? " What was typed is kept here." : ""}`, again, ...more);
    this.sayingFailed = true;
  }

  private sayingFailed = false;

  /** The form was deleted: it is written as it is shown here. */
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

  /** What is said of what is shown, and took longer than its picture: the verdict, and what changed. */
  private tellMore(head: Partial<Head>): void {
    const { verdict = this.head!.verdict, fit = this.head!.fit, saved = this.head!.saved, against = this.head!.against } = head;
    Object.assign(this.head!, { verdict, fit, saved, against });
    this.mark();
    this.relight(false);
  }

  /** From a key until it is painted. */
  private measure(key: number, proven: boolean): void {
    requestAnimationFrame(() => setTimeout(() => {
      const time = performance.now() - key;
      if (!this.painted.length || this.painted.at(-1)!.key !== key) this.painted.push({ key, picture: time, verdict: 0 });
      if (proven) this.painted.at(-1)!.verdict = time;
      if (this.painted.length > 100) this.painted.shift();
      if (proven) this.timing.textContent = `${time.toFixed(0)} ms`;
    }));
  }

  /** Shows a scene. What can't be printed leaves the program of before, dimmed. */
  show(scene: Scene): void {
    const head = scene.head;
    this.head = head;
    const first = !this.program;
    this.takeTexts(head);
    // the same program is not sent again
    if (head.same) Object.assign(head, { picture: this.shown?.picture, "old/picture": this.shown?.["old/picture"] });
    else if (head.picture) this.shown = head;
    document.body.classList.toggle("stale", !!head.stopped);
    if (head.same) {
      // as it was
    } else if (head.picture) {
      this.program = new Program(scene, "", this.program);
      this.old = scene.has("old/text") ? new Program(scene, "old/", this.old) : null;
    } else if (first || !head.stopped) {
      this.program = this.old = null;
    }
    this.titles(head);
    this.mark();
    if (first && this.program) this.line = this.firstLine();
    this.line = Math.min(this.line, Math.max(1, this.program?.lines ?? 1));
    this.choose(this.line, first ? "key" : "form", first);
    if (first) void this.otherVerdicts();
  }

  /** The first difference, else the first block that cuts, one that the form printed if there is one. */
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
    this.saving.hidden = !this.host?.save || !Object.keys(this.typed).length;
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

  private titles(head: Head): void {
    const form = head.form?.files[0];
    const names = [form && base(form), head.job.name && base(head.job.name)].filter(Boolean);
    document.title = `${names.join(" · ")} · postform`;
    this.title.textContent = form ? base(form) : base(head.job.name);
    if (head.form) {
      const { errors, warnings, notes } = head.form;
      const count = (number: number, what: string) => `${number} ${what}${number === 1 ? "" : "s"}`;
      this.lint.textContent = `${count(errors, "error")}, ${count(warnings, "warning")}`;
      this.lint.setAttribute("aria-label", `${errors} errors, ${warnings} warnings, ${notes} notes of the form: show the next`);
      this.lint.className = errors ? "lint bad" : warnings ? "lint warn" : "lint";
    } else this.lint.hidden = true;
    const jobs = head.jobs ?? [];
    if (this.tabs.childElementCount !== jobs.length) {
      this.tabs.replaceChildren(...jobs.map((name, i) => {
        const tab = element("button", { role: "tab", class: "tab", title: name }, jobName(name), element("span", {}));
        tab.onclick = () => {
          this.job = i;
          this.program = null;
          void this.load();
        };
        return tab;
      }));
    }
    [...this.tabs.children].forEach((tab, i) => tab.setAttribute("aria-selected", String(i === this.job)));
    this.tabs.hidden = jobs.length < 1;
  }

  /** The verdicts of the jobs that are not shown. */
  private async otherVerdicts(): Promise<void> {
    for (let job = 0; job < this.tabs.childElementCount; job++) {
      if (job === this.job || !this.host) continue;
      try {
        this.tabVerdict(job, await this.host.verdict(job));
      } catch (error) {
        this.tabVerdict(job, without(error instanceof Error ? error.message : String(error)));
      }
    }
  }

  private tabVerdict(job: number, verdict: Verdict | undefined): void {
    const mark = this.tabs.children[job]?.querySelector("span");
    if (!mark) return;
    const kind = verdict?.kind ?? "none";
    [mark.textContent, mark.className] = { proven: ["✓", "ok"], unproven: ["?", "warn"], different: ["✗", "bad"], none: ["–", "dim"] }[kind];
    mark.setAttribute("aria-label", verdict?.text ?? "no verdict");
    this.tabs.children[job].setAttribute("title", verdict?.text ?? "");
  }

  private sayVerdict(verdict: Verdict | undefined, stopped?: Head["stopped"]): void {
    const class_ = { proven: "ok", unproven: "warn", different: "bad", none: "dim" }[verdict?.kind ?? "none"];
    this.verdict.className = `verdict ${stopped ? "bad" : class_}`;
    this.verdict.textContent = stopped ? `${stopped.by === "form" ? "the form has errors" : "no program"}: ${stopped.findings[0]?.message ?? stopped.message}` : verdict?.text ?? "";
    this.verdict.title = stopped ? (stopped.findings[0]?.help ?? "") : [verdict?.allowed.join("\n"), verdict?.help].filter(Boolean).join("\n");
    this.tabVerdict(this.job, stopped ? undefined : verdict);
  }

  /** What is marked in the panes: differences, changes, findings. */
  private mark(): void {
    const head = this.head!;
    const waits = !!this.host && !!head.picture && !head.stopped && !head.verdict;
    document.body.classList.toggle("pending", !!this.unchecked);
    if (this.unchecked) this.sayVerdict(this.unchecked);
    else this.sayVerdict(waits ? PROVING : head.verdict, head.stopped);
    if (!this.unchecked && this.sayingFailed) {
      this.sayingFailed = false;
      this.say("");
    }
    this.fit.hidden = !head.fit || !!head.stopped || !!this.unchecked;
    this.fit.className = `fit ${head.fit?.kind ?? "dim"}`;
    this.fit.textContent = head.fit?.text ?? "";
    this.fit.title = head.fit?.more.join("\n") ?? "";
    const marks = marksOf(head, this.old);
    const picture = head.picture;
    const count = picture ? `${picture.blocks} blocks · ${picture.time}` : "";
    this.marks = marks;
    this.listing.show(this.program, marks, count);
    this.backplot.show(this.program, this.old, [...marks.bad.keys()]);
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
    if (this.playing) this.backplot.drawTo(this.line);
    this.relight(scrolls && from !== "form");
    this.state.show(this.program, this.line);
    this.tell(this.line, false);
  }

  private relight(scrolls: boolean): void {
    const form = this.program?.form(this.line);
    const bad = (this.head?.verdict?.findings ?? []).flatMap((found) => (found.form ? [{ file: found.form[0], line: found.form[1] }] : []));
    this.editor?.light(form ? [form] : [], bad, scrolls);
  }

  /** A line of the form was clicked: the next block that it printed. */
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

  /** What is known of a block, in words. */
  private tell(line: number, hovers: boolean): void {
    const program = this.program;
    const stopped = stoppedNote(this.head?.stopped?.findings ?? []);
    if (!program) {
      this.listing.note.replaceChildren(...stopped);
      this.foot.textContent = "";
      return;
    }
    this.listing.note.replaceChildren(...stopped, ...noteOf(program, line, this.marks, this.formText(line)));
    this.foot.textContent = (hovers ? "pointer at " : "") + whereOf(program, line);
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

  // what keys do

  step(by: number): void {
    this.choose(this.line + by, "key");
  }

  /** The next block for which something else holds. */
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
    const all = (this.head?.form?.findings ?? []).filter((found) => found.labels.length);
    if (!all.length || !this.editor) return;
    this.next.finding = (this.next.finding + by + all.length) % all.length;
    const found = all[(this.next.finding - 1 + all.length) % all.length];
    this.editor.goTo(found.labels[0].at);
    this.listing.note.replaceChildren(element("div", {}, element("b", {}, found.code), ` ${found.message}`), element("div", { class: "dim" }, found.help ?? ""));
    this.editor.view.focus();
  }

  /** What the verdict means: its findings one after the other, from where on nothing is proven, or what was allowed. */
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
    if (this.playing) {
      clearInterval(this.playing);
      this.playing = 0;
      this.backplot.drawTo(Infinity);
      return;
    }
    const last = this.program?.lines ?? 0;
    if (this.line >= last) this.line = 0;
    // a program takes at most a minute to play
    const stride = Math.max(1, Math.round(last / 600));
    this.playing = window.setInterval(() => {
      if (this.line >= last) return this.play();
      this.step(stride);
    }, 100);
  }

  private edit(name: string, text: string): void {
    const key = performance.now();
    if (text === this.saved[name]) delete this.typed[name];
    else this.typed[name] = text;
    this.saving.hidden = !this.host?.save || !Object.keys(this.typed).length;
    void this.load(key);
    if (!Object.keys(this.typed).length) void this.otherVerdicts();
  }

  async save(): Promise<void> {
    if (!this.host?.save) return;
    for (const [name, text] of Object.entries(this.typed)) {
      if (this.conflicts.has(name)) return this.sayConflict(name);
      const wrong = await this.host.save(name, text, this.saved[name] ?? "");
      if (wrong) return this.say(`${base(name)} was not saved: ${wrong}`);
      this.saved[name] = text;
      delete this.typed[name];
    }
    this.saving.hidden = true;
    this.say("");
    await this.load();
    void this.otherVerdicts();
  }
}
