// What the colours of cuts mean, and how deep each cut is: a colour and a shade for each move.

import type { Program } from "../program.ts";
import { TOOLS } from "./colours.ts";
import type { Level } from "./levels.ts";

export const MEANINGS = ["tool", "operation", "Z", "feed"] as const;
export type Meaning = (typeof MEANINGS)[number];

/** The colours of a picture. */
export interface Shades {
  meaning: Meaning;
  /** The least value and the greatest of a quantity; null where colours are numbers. */
  range: [number, number] | null;
  /** Of each move: the number of its colour, or its value from 0 to 255. */
  colour: Uint8Array;
  /** Of each piece of the path: 255 for the highest cut, 0 for the deepest. */
  shade: Uint8Array;
}

/** The height at a point. */
type Height = (point: number) => number;

/** Colours and shades of a program. Heights are shaded only where Z is the depth: on mills, and as long as no axis turns the part. */
export function shadesOf(program: Program, meaning: Meaning): Shades {
  const path = program.path!;
  const { moveKind, moveLine, moveTool, first, points } = path;
  const cuts = (move: number) => (moveKind[move] & 15) === 1 || (moveKind[move] & 15) === 2;
  const height: Height = (point) => points[point * 3 + 2];
  const heights = rangeOf(path.moves, cuts, (move) => height(first[move + 1]));
  const isMill = path.head.letters === "XYZ" && !path.ends.length && path.head.view !== "lathe";
  const shade = new Uint8Array(path.pieces).fill(255);
  if (isMill && heights && heights[1] > heights[0] && meaning !== "Z") {
    const [least, greatest] = heights;
    for (let piece = 0; piece < path.pieces; piece++) shade[piece] = share((height(piece) + height(piece + 1)) / 2, least, greatest);
  }
  const colour = new Uint8Array(path.moves);
  if (meaning === "tool") {
    colour.forEach((_, move) => (colour[move] = (moveTool[move] + TOOLS - 1) % TOOLS));
    return { meaning, range: null, colour, shade };
  }
  if (meaning === "operation") {
    colour.forEach((_, move) => (colour[move] = ((program.item(moveLine[move])?.operation ?? 0) + TOOLS - 1) % TOOLS));
    return { meaning, range: null, colour, shade };
  }
  const middle = path.head.middle[2];
  const value = meaning === "Z" ? (move: number) => height(first[move + 1]) + middle : (move: number) => program.held("feed", moveLine[move])?.value ?? 0;
  const range = rangeOf(path.moves, cuts, value) ?? [0, 0];
  colour.forEach((_, move) => (colour[move] = share(value(move), ...range)));
  return { meaning, range, colour, shade };
}

function rangeOf(moves: number, counts: (move: number) => boolean, value: (move: number) => number): [number, number] | null {
  let [least, greatest] = [Infinity, -Infinity];
  for (let move = 0; move < moves; move++) {
    if (!counts(move)) continue;
    const at = value(move);
    if (at < least) least = at;
    if (at > greatest) greatest = at;
  }
  return least <= greatest ? [least, greatest] : null;
}

function share(value: number, least: number, greatest: number): number {
  return greatest > least ? Math.max(0, Math.min(255, Math.round(((value - least) / (greatest - least)) * 255))) : 255;
}

/** Writes colours and shades into the levels of a path. */
export function paint(levels: Level[], program: Program, { colour, shade }: Shades): void {
  const path = program.path!;
  const moveOf = new Uint32Array(path.pieces);
  for (let move = 0; move < path.moves; move++) moveOf.fill(move, path.first[move], path.first[move + 1]);
  for (const { kinds, pieces } of levels) {
    for (let at = 0; at * 4 < kinds.length; at++) {
      const piece = pieces ? pieces[at] : at;
      kinds[at * 4 + 2] = colour[moveOf[piece]];
      kinds[at * 4 + 3] = shade[piece];
    }
  }
}
