// The program pane. Only visible lines are elements of the page, so that a million lines can be scrolled.

import { download } from "./download.ts";
import { element } from "./element.ts";
import { Find } from "./find.ts";
import { type Marks, noMarks } from "./marks.ts";
import type { Program } from "./program.ts";
import { Rows } from "./rows.ts";
import type { Hunks } from "./scene.ts";

const ROW = 20;
/** Maximum height of the list in pixels: browsers do not lay out more. Scrolling of a longer program is scaled. */
const TALLEST = 8_000_000;

export class Listing {
  readonly root: HTMLElement;
  private readonly head = element("span", {});
  private readonly view = element("div", {
    class: "code listing", role: "listbox", tabindex: "0", "aria-label": "Program",
  });
  private readonly spacer = element("div", { class: "spacer" });
  private readonly rows = element("div", { class: "rows" });
  readonly note = element("div", { class: "note", role: "group", tabindex: "0", "aria-label": "About the block", "aria-live": "polite" });
  private program: Program | null = null;
  private marks: Marks = noMarks();
  private old: Program | null = null;
  private places = new Rows(0, []);
  private line = 0;
  private lit = new Set<number>();
  private asked = 0;
  /** Whether the selected block was scrolled into view and the user has not scrolled since then. */
  private follows = false;
  onPick: (line: number) => void = () => {};
  onHover: (line: number | null) => void = () => {};
  /** Called when the search has found a line, so that the line is selected and shown. */
  onFound: (line: number) => void = () => {};
  /** The file name for saving the program. */
  fileName = "program.nc";
  readonly find = new Find();

  constructor() {
    this.view.append(this.spacer, this.rows);
    this.root = element("section", { class: "program", "aria-label": "Program" },
      element("h2", {}, "Program", this.head, this.tools()), this.find.root, this.view, this.note);
    this.find.onFind = (text, by) => {
      const line = (by ? this.program?.find(text, this.line, by) : this.program?.find(text, this.line - 1, 1)) ?? 0;
      if (line) this.onFound(line);
      return line > 0;
    };
    this.find.onClose = () => this.focus();
    this.view.onscroll = () => this.redraw();
    new ResizeObserver(() => {
      // the note about the selected block makes the list smaller, but the block must stay visible
      if (this.follows) this.reveal(this.line);
      this.redraw();
    }).observe(this.view);
    this.view.onwheel = this.view.onpointerdown = () => (this.follows = false);
    const lineOf = (event: Event) => {
      const row = (event.target as Element).closest("[data-line]");
      return row ? Number(row.getAttribute("data-line")) : null;
    };
    this.rows.onclick = (event) => {
      const line = lineOf(event);
      if (!line) return;
      // after this call, keys control the page
      this.view.focus({ preventScroll: true });
      this.onPick(line);
    };
    this.rows.onmouseover = (event) => this.onHover(lineOf(event));
    this.rows.onmouseleave = () => this.onHover(null);
  }

  /** Shows a program. Blocks that only the `old` program has are shown between the lines. */
  show(program: Program | null, marks: Marks, head: string, old: Program | null, hunks: Hunks["hunks"]): void {
    [this.program, this.marks, this.old] = [program, marks, old];
    this.places = new Rows(program?.lines ?? 0, old ? hunks : []);
    this.head.textContent = head;
    this.spacer.style.height = `${Math.min(TALLEST, this.height)}px`;
    this.view.setAttribute("aria-description", head);
    this.draw();
  }

  choose(line: number, lit: number[], scrolls: boolean): void {
    this.line = line;
    this.lit = new Set(lit);
    if (scrolls) {
      this.follows = true;
      this.reveal(line);
    }
    this.draw();
  }

  private tools(): HTMLElement {
    const button = (text: string, title: string, act: () => void) => {
      const made = element("button", { title }, text);
      made.onclick = act;
      return made;
    };
    const copy = button("copy", "Copy the program", async () => {
      await navigator.clipboard.writeText(this.program?.all() ?? "");
      copy.textContent = "copied";
      setTimeout(() => (copy.textContent = "copy"), 1500);
    });
    const save = button("save", "Save the program as a file", () => this.program && download(this.fileName, this.program.all()));
    return element("span", { class: "tools" }, button("find", "Find in the program (/)", () => this.find.open()), copy, save);
  }

  focus(): void {
    this.view.focus();
  }

  private get height(): number {
    return this.places.count * ROW + 12;
  }

  /** Pixels of the program per scrolled pixel. */
  private get stretch(): number {
    const room = this.view.clientHeight;
    const shown = Math.min(TALLEST, this.height);
    return shown > room ? (this.height - room) / (shown - room) : 1;
  }

  private reveal(line: number): void {
    const room = this.view.clientHeight;
    const top = this.view.scrollTop * this.stretch;
    const at = this.places.of(line) * ROW + 6;
    if (at < top + ROW || at > top + room - 2 * ROW) {
      const near = Math.abs(at - top - room / 2) < room * 1.5;
      const target = near ? (at < top + ROW ? at - 3 * ROW : at - room + 4 * ROW) : at - room / 2;
      this.view.scrollTop = Math.max(0, target / this.stretch);
    }
  }

  private redraw(): void {
    if (this.asked) return;
    this.asked = requestAnimationFrame(() => {
      this.asked = 0;
      this.draw();
    });
  }

  private draw(): void {
    const program = this.program;
    if (!program) {
      this.rows.replaceChildren();
      return;
    }
    const scrolled = this.view.scrollTop;
    const top = scrolled * this.stretch;
    const first = Math.max(0, Math.floor((top - 6) / ROW));
    const last = Math.min(this.places.count - 1, first + Math.ceil(this.view.clientHeight / ROW) + 1);
    this.rows.style.transform = `translateY(${scrolled + first * ROW + 6 - top}px)`;
    const rows: HTMLElement[] = [];
    for (let row = first; row <= last; row++) {
      const place = this.places.at(row);
      rows.push("old" in place ? this.gone(place.old) : this.row(program, place.line));
    }
    this.rows.replaceChildren(...rows);
    if (this.line) this.view.setAttribute("aria-activedescendant", `block-${this.line}`);
  }

  /** A block that only the old program has. */
  private gone(line: number): HTMLElement {
    return element("div", { class: "ln gone", role: "option", "aria-disabled": "true", "aria-selected": "false", title: `line ${line} of the old program is gone` }, element("i", {}, "−"), element("s", {}, this.old?.text(line) ?? ""));
  }

  private row(program: Program, line: number): HTMLElement {
    const chosen = line === this.line;
    const classes = ["ln"];
    if (program.isTraced && !program.form(line)) classes.push("gen");
    if (chosen) classes.push("on");
    else if (this.lit.has(line)) classes.push("lit");
    if (this.marks.bad.has(line)) classes.push("bad");
    if (this.marks.saved.has(line)) classes.push("new");
    if (this.marks.against.has(line)) classes.push("other");
    const row = element("div", {
      class: classes.join(" "), id: `block-${line}`, role: "option", "data-line": String(line),
      "aria-selected": String(chosen), "aria-setsize": String(program.lines), "aria-posinset": String(line),
    }, element("i", {}, String(line)), ...words(program.text(line)));
    return row;
  }
}

/** Splits a block into its parts; comments are dimmed. */
function words(text: string): (Node | string)[] {
  const parts = text.slice(0, 400).split(/(\([^)]*\)?)/);
  return parts.filter(Boolean).map((part) => (part.startsWith("(") ? element("span", { class: "rem" }, part) : part));
}
