// The path in several levels of detail. In the coarse levels, a million moves become some ten thousand lines.

import type { Path } from "../scene.ts";
import { inByte } from "./colours.ts";

/** Number of pieces that are tested together for visibility. */
const CHUNK = 4096;
/** Error of the finest simplified level, relative to the size of the path; each coarser level has a multiple of it. */
const FINEST = 1 / 8000;
const COARSER = 3;
/** Greatest error of a level, relative to the size of the path. A larger error would be visible. */
const COARSEST = 1 / 30;
/** A path with fewer pieces has only one level. */
const FEW = 20000;

export interface Level {
  /** Greatest distance between a removed point and the drawn line. */
  error: number;
  /** Points; piece i is the line from point i to point i + 1. */
  points: Float32Array;
  /** For each piece: kind, tool, colour, shade. `shades.ts` computes colour and shade. */
  kinds: Uint8Array;
  /** For each piece of the level, the last piece of the path that it contains. */
  pieces: Uint32Array | null;
  /** Least and greatest X Y Z of each chunk of pieces. */
  boxes: Float32Array;
}

/** A jump between two parts of the path; it is not drawn. */
export const JUMP = 3;
/** A rapid that repeats an earlier one. It is drawn only if its block is selected. */
export const AGAIN = 4;
/** Maximum number of rapids that are compared with each other. */
const MOST_RAPIDS = 50_000;

export function count(level: Level): number {
  return level.kinds.length / 4;
}

/** The levels of a path, beginning with the coarsest. */
export function levels(path: Path): Level[] {
  const kinds = new Uint8Array(path.pieces * 4);
  for (let move = 0; move < path.moves; move++) {
    for (let piece = path.first[move]; piece < path.first[move + 1]; piece++) {
      kinds[piece * 4] = path.moveKind[move] & 15;
      kinds[piece * 4 + 1] = inByte(path.moveTool[move]);
    }
  }
  drawOnce(path, kinds);
  const whole: Level = { error: 0, points: path.points, kinds, pieces: null, boxes: boxes(path.points) };
  const all = [whole];
  for (let error = FINEST; count(all[0]) > FEW && error < COARSEST; error *= COARSER) {
    const next = coarser(all[0], error * path.size);
    // each level is made from the one before, so their errors add up
    next.error += all[0].error;
    // a level that removes very little is not worth its memory
    if (count(next) < 0.8 * count(all[0])) all.unshift(next);
  }
  return all;
}

/** Marks repeated rapids, in either direction. */
function drawOnce({ points }: Path, kinds: Uint8Array): void {
  const seen = new Set<string>();
  for (let piece = 0; piece * 4 < kinds.length && seen.size < MOST_RAPIDS; piece++) {
    if (kinds[piece * 4] !== 0) continue;
    const at = piece * 3;
    const from = `${points[at]},${points[at + 1]},${points[at + 2]}`;
    const to = `${points[at + 3]},${points[at + 4]},${points[at + 5]}`;
    const line = from < to ? `${from} ${to}` : `${to} ${from}`;
    if (seen.has(line)) kinds[piece * 4] = AGAIN;
    else seen.add(line);
  }
}

/** Makes a coarser level: removes points nearer than `error` to the last kept point. Points at which the kind or the tool changes are kept. */
function coarser(level: Level, error: number): Level {
  const { points, kinds } = level;
  const total = count(level);
  const ofWhole = (piece: number) => level.pieces?.[piece] ?? piece;
  const kept = new Uint32Array(total);
  let [number, x, y, z] = [0, points[0], points[1], points[2]];
  for (let piece = 0; piece < total; piece++) {
    const at = (piece + 1) * 3;
    const next = (piece + 1) * 4;
    const goesOn = piece + 1 < total && kinds[piece * 4] === kinds[next] && kinds[piece * 4 + 1] === kinds[next + 1];
    const [dx, dy, dz] = [points[at] - x, points[at + 1] - y, points[at + 2] - z];
    if (goesOn && dx * dx + dy * dy + dz * dz < error * error) continue;
    kept[number++] = piece;
    [x, y, z] = [points[at], points[at + 1], points[at + 2]];
  }
  const pieces = kept.slice(0, number);
  const fewer = new Float32Array((number + 1) * 3);
  const fewerKinds = new Uint8Array(number * 4);
  fewer.set(points.subarray(0, 3));
  // the numbers are copied one at a time, because creating a subarray takes longer than copying three numbers
  for (let i = 0; i < number; i++) {
    const piece = pieces[i];
    for (let axis = 0; axis < 3; axis++) fewer[i * 3 + 3 + axis] = points[piece * 3 + 3 + axis];
    for (let part = 0; part < 4; part++) fewerKinds[i * 4 + part] = kinds[piece * 4 + part];
    pieces[i] = ofWhole(piece);
  }
  return { error, points: fewer, kinds: fewerKinds, pieces, boxes: boxes(fewer) };
}

function boxes(points: Float32Array): Float32Array {
  const pieces = points.length / 3 - 1;
  const all = new Float32Array(Math.max(1, Math.ceil(pieces / CHUNK)) * 6);
  for (let box = 0; box * 6 < all.length; box++) {
    for (let axis = 0; axis < 3; axis++) {
      let [least, greatest] = [Infinity, -Infinity];
      for (let point = box * CHUNK; point <= Math.min(pieces, (box + 1) * CHUNK); point++) {
        const value = points[point * 3 + axis];
        if (value < least) least = value;
        if (value > greatest) greatest = value;
      }
      all[box * 6 + axis] = least;
      all[box * 6 + 3 + axis] = greatest;
    }
  }
  return all;
}

/** The coarsest level with an error below one pixel. */
export function fitting(levels: Level[], scale: number): Level {
  return levels.find((level) => level.error * scale < 0.8) ?? levels[levels.length - 1];
}

export type Sees = (box: Float32Array, at: number) => boolean;

/** The level to draw and its runs of visible pieces, at most `most` of them. If there are more, a coarser level is used. */
export function drawable(levels: Level[], scale: number, sees: Sees, most: number): [Level, [number, number][]] {
  for (let at = levels.indexOf(fitting(levels, scale)); ; at--) {
    const runs = inSight(levels[at], sees);
    if (at === 0 || runs.reduce((sum, [from, to]) => sum + to - from, 0) <= most) return [levels[at], runs];
  }
}

/** The number of pieces of a level before this piece of the path. */
export function upTo(level: Level, piece: number): number {
  if (!level.pieces) return Math.min(piece, count(level));
  let [low, high] = [0, level.pieces.length];
  while (low < high) {
    const middle = (low + high) >> 1;
    if (level.pieces[middle] < piece) low = middle + 1;
    else high = middle;
  }
  return low;
}

/** Runs of pieces that may be visible: the first piece, and the piece after the last one. */
export function inSight(level: Level, sees: Sees): [number, number][] {
  const runs: [number, number][] = [];
  const total = count(level);
  for (let box = 0; box * CHUNK < total; box++) {
    if (!sees(level.boxes, box * 6)) continue;
    const end = Math.min(total, (box + 1) * CHUNK);
    const last = runs[runs.length - 1];
    if (last && last[1] === box * CHUNK) last[1] = end;
    else runs.push([box * CHUNK, end]);
  }
  return runs;
}
