// The strip below the panes: the modal state after the selected block, and the block that set each value.

import { element } from "./element.ts";
import type { Held, Program, Register } from "./program.ts";
import { toolText } from "./scene.ts";

export class StateStrip {
  readonly root = element("div", { class: "state", role: "region", "aria-label": "State after the chosen block" });
  onPick: (line: number) => void = () => {};

  show(program: Program | null, line: number): void {
    this.root.replaceChildren();
    if (!program?.path || line < 1) return;
    const cells: [name: string, words: Word[]][] = [
      ["codes", codes(program, line)],
      ["tool", [tool(program, line), word(program, line, "h", "H"), word(program, line, "d", "D")]],
      ["spindle", [word(program, line, "speed", "S"), word(program, line, "spindle", "M")]],
      ["coolant", [word(program, line, "coolant", "M")]],
      ["feed", [word(program, line, "feed", "F")]],
      ["position", [...place(program, line), ...AXES.map((axis) => word(program, line, axis, axis.toUpperCase()))]],
      ["cycle", cycle(program, line)],
    ];
    for (const [name, words] of cells) {
      const known = words.filter((word): word is Known => !!word);
      if (known.length) this.root.append(this.cell(name, known, line));
    }
  }

  private cell(name: string, words: Known[], line: number): HTMLElement {
    const values = words.map(({ text, line: said }) => {
      const value = element("button", { title: said ? `said by line ${said}` : "as switched on" }, text);
      value.onclick = () => said && this.onPick(said);
      if (said === line) value.className = "now";
      return value;
    });
    const said = [...new Set(words.map((word) => word.line))].sort((a, b) => a - b).slice(-3);
    const by = said.map((at) => (at === line ? "this block" : at === 0 ? "switched on" : `line ${at}`)).join(" · ");
    return element("div", { role: "group", "aria-label": name }, element("span", {}, ...values), element("small", {}, `${name}: ${by}`));
  }
}

/** Axes besides X Y Z: rotary axes, and the upper guide of a wire. */
const AXES = ["a", "b", "c", "u", "v"] as const;

interface Known {
  text: string;
  line: number;
}
type Word = Known | null;

function word(program: Program, line: number, register: Register, letter: string): Word {
  const held = program.held(register, line);
  // the register of a tool with a name has no number
  return held && held.value < 1e9 ? shown(letter, held) : null;
}

/** The tool after a line, by its number or name. */
function tool(program: Program, line: number): Word {
  const held = program.held("tool", line);
  return held && program.path ? { text: toolText(program.path.head, held.value), line: held.line } : null;
}

function shown(letter: string, held: Held): Known {
  return { text: letter + number(held.value), line: held.line };
}

/** A number as in a program, with up to five decimals. */
export function number(value: number): string {
  return String(Math.round(value * 1e5) / 1e5 + 0).replace(/^(-?)0\./, "$1.");
}

function codes(program: Program, line: number): Word[] {
  const groups: Register[] = ["motion", "plane", "distance", "units", "feedMode", "compensation", "length", "work"];
  return groups.map((register) => {
    const held = program.held(register, line);
    // values that are off are not shown
    if (!held || (register === "compensation" && held.value === 40) || (register === "feedMode" && held.value === 94)) return null;
    // work offsets of a Haas above G59 are stored as 1540 plus their number
    const value = register === "work" && held.value > 1540 ? `154 P${held.value - 1540}` : number(held.value);
    return { text: `G${value}`, line: held.line };
  });
}

function place(program: Program, line: number): Word[] {
  return program.position(line).map((held, axis) => {
    const letter = "XYZ"[axis];
    if (!held) return { text: `${letter}?`, line };
    // points have 24 bits of precision, which is enough for a drawing
    return { text: letter + number(Math.round(held.value * 1e4) / 1e4), line: held.line };
  });
}

function cycle(program: Program, line: number): Word[] {
  const held = program.held("cycle", line);
  if (!held) return [];
  return [
    shown("G", held), word(program, line, "back", "G"), word(program, line, "r", "R"), word(program, line, "depth", "Z"),
    word(program, line, "dwell", "P"), word(program, line, "peck", "Q"),
  ];
}
