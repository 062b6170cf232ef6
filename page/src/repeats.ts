// Words of a form line that its block does not print because their values have not changed.

import { number } from "./state.ts";
import type { Program, Register } from "./program.ts";

const HELD: Record<string, Register> = { F: "feed", S: "speed", T: "tool", H: "h", D: "d", R: "r", P: "dwell", Q: "peck" };

export interface Repeat {
  word: string;
  why: string;
}

/** The words of the form line that are missing in the block, with their active values. */
export function repeats(formLine: string, block: string, program: Program, line: number): Repeat[] {
  const printed = new Set([...block.replace(/\([^)]*\)?/g, "").matchAll(/[A-Z]/g)].map((found) => found[0]));
  const gone: Repeat[] = [];
  const position = program.position(line);
  const seen = new Set<string>();
  for (const [word, letter, variable] of formLine.replace(/(^|\s)#.*$| {2}.*$|\t.*$/, "").matchAll(/([A-Z])(\[[^\]]*\]|[0-9.]+)/g)) {
    if (letter === "G" || letter === "M" ? hasCode(block, word, variable) : printed.has(letter)) continue;
    if (seen.has(word)) continue;
    seen.add(word);
    const axis = "XYZ".indexOf(letter);
    const inCycle = program.held("cycle", line);
    const held = axis === 2 && inCycle ? program.held("depth", line) : axis >= 0 ? position[axis] : HELD[letter] ? program.held(HELD[letter], line) : null;
    const text = variable.startsWith("[") ? (held ? letter + number(held.value) : word) : word;
    const said = held && held.line > 0 && held.line < line ? `line ${held.line} said it, and it is still in force` : "it is still in force, or there is nothing to print";
    gone.push({ word: text, why: said });
  }
  return gone;
}

/** A literal code must be equal. A code from a variable may be any code, so the code is missing only if the block contains no
 * code with this letter. */
function hasCode(block: string, word: string, variable: string): boolean {
  if (variable.startsWith("[")) return block.includes(word[0]);
  return new RegExp(`${word[0]}0*${variable.replace(".", "\\.")}(?![0-9.])`).test(block);
}
