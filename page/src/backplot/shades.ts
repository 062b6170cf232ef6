// Computes a colour and a shade for each piece of a level. The shade shows the depth of a cut.

import type { Program } from "../program.ts";
import { TOOLS } from "./colours.ts";
import type { Level } from "./levels.ts";

export const MEANINGS = ["tool", "operation", "Z", "feed"] as const;
export type Meaning = (typeof MEANINGS)[number];

/** The meaning of the colours of a picture. */
export interface Shades {
  meaning: Meaning;
  /** The least and greatest value of a quantity; null if colours stand for numbers. */
  range: [number, number] | null;
}

/** Writes colours and shades into the levels of a program. Depth is shaded only on mills without rotary moves, where Z is the depth. */
export function paint(levels: Level[], program: Program, meaning: Meaning): Shades {
  const { head, ends } = program.path!;
  const whole = levels[levels.length - 1];
  const heights = heightsOf(whole);
  const isMill = head.letters === "XYZ" && !ends.length && head.view !== "lathe";
  const depth = isMill && meaning !== "Z" ? heights : null;
  for (const level of levels) {
    byHeight(level, 3, depth);
    if (meaning === "Z") byHeight(level, 2, heights);
    if (meaning === "tool") byTool(level);
  }
  if (meaning === "tool") return { meaning, range: null };
  const middle = head.middle[2];
  if (meaning === "Z") return { meaning, range: heights ? [heights[0] + middle, heights[1] + middle] : [0, 0] };
  const { moveLine, moveKind, moves } = program.path!;
  if (meaning === "operation") {
    byMove(levels, program, Uint8Array.from(moveLine, (line) => ((program.item(line)?.operation ?? 0) + TOOLS - 1) % TOOLS));
    return { meaning, range: null };
  }
  const feeds = Float64Array.from(moveLine, (line) => program.held("feed", line)?.value ?? 0);
  let [least, greatest] = [Infinity, -Infinity];
  for (let move = 0; move < moves; move++) {
    if (!isCut(moveKind[move] & 15)) continue;
    least = Math.min(least, feeds[move]);
    greatest = Math.max(greatest, feeds[move]);
  }
  byMove(levels, program, Uint8Array.from(feeds, (feed) => share(feed, least, greatest)));
  return { meaning, range: least <= greatest ? [least, greatest] : [0, 0] };
}

function isCut(kind: number): boolean {
  return kind === 1 || kind === 2;
}

/** A value as a number from 0 (least) to 255 (greatest). */
function share(value: number, least: number, greatest: number): number {
  return greatest > least ? Math.max(0, Math.min(255, Math.round(((value - least) / (greatest - least)) * 255))) : 255;
}

/** The heights of the lowest and the highest cut; null if nothing is cut. */
function heightsOf({ points, kinds }: Level): [number, number] | null {
  let [least, greatest] = [Infinity, -Infinity];
  for (let piece = 0; piece * 4 < kinds.length; piece++) {
    if (!isCut(kinds[piece * 4])) continue;
    const z = points[piece * 3 + 5];
    if (z < least) least = z;
    if (z > greatest) greatest = z;
  }
  return least <= greatest ? [least, greatest] : null;
}

/** Sets byte 2 or 3 of each piece to the height of its middle; without a range, to 255. */
function byHeight({ points, kinds }: Level, byte: 2 | 3, range: [number, number] | null): void {
  const [least, scale] = range && range[1] > range[0] ? [range[0], 255 / (range[1] - range[0])] : [0, 0];
  for (let piece = 0; piece * 4 < kinds.length; piece++) {
    const z = (points[piece * 3 + 2] + points[piece * 3 + 5]) / 2;
    kinds[piece * 4 + byte] = scale ? Math.max(0, Math.min(255, (z - least) * scale + 0.5)) : 255;
  }
}

function byTool({ kinds }: Level): void {
  for (let at = 0; at < kinds.length; at += 4) kinds[at + 2] = (kinds[at + 1] + TOOLS - 1) % TOOLS;
}

function byMove(levels: Level[], program: Program, colours: Uint8Array): void {
  const { first, moves, pieces: all } = program.path!;
  const moveOf = new Uint32Array(all);
  for (let move = 0; move < moves; move++) moveOf.fill(move, first[move], first[move + 1]);
  for (const { kinds, pieces } of levels) {
    for (let at = 0; at * 4 < kinds.length; at++) kinds[at * 4 + 2] = colours[moveOf[pieces ? pieces[at] : at]];
  }
}
