// The path in levels of detail: from far away a million moves are a few ten thousand lines.

import type { Path } from "../scene.ts";

/** Pieces that are looked at together when it is asked what is in sight. */
const CHUNK = 4096;
/** Errors of the levels, of the size of the path; the last level is all of it. */
const ERRORS = [1 / 1500, 1 / 8000];
/** A path of fewer pieces is drawn whole. */
const FEW = 20000;

export interface Level {
  /** Largest distance of what is left out from what is drawn. */
  error: number;
  /** Points; piece i goes from point i to point i + 1. */
  points: Float32Array;
  /** Kind, tool, 0, 0 of each piece. */
  kinds: Uint8Array;
  /** The piece of the path that each piece ends with. */
  pieces: Uint32Array | null;
  /** Least and greatest X Y Z of every so many pieces. */
  boxes: Float32Array;
}

export function count(level: Level): number {
  return level.kinds.length / 4;
}

/** The levels of a path, the coarsest first. */
export function levels(path: Path): Level[] {
  const kinds = new Uint8Array(path.pieces * 4);
  for (let move = 0; move < path.moves; move++) {
    for (let piece = path.first[move]; piece < path.first[move + 1]; piece++) {
      kinds[piece * 4] = path.moveKind[move] & 15;
      kinds[piece * 4 + 1] = path.moveTool[move];
    }
  }
  const whole: Level = { error: 0, points: path.points, kinds, pieces: null, boxes: boxes(path.points) };
  if (path.pieces < FEW) return [whole];
  return [...ERRORS.map((error) => coarser(whole, error * path.size)), whole];
}

/** Leaves out points that are nearer to the last that was kept than `error`; where the kind or the tool changes, it is kept. */
function coarser(level: Level, error: number): Level {
  const { points, kinds } = level;
  const total = count(level);
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
  for (let i = 0; i < number; i++) {
    const piece = pieces[i];
    fewer.set(points.subarray((piece + 1) * 3, (piece + 2) * 3), (i + 1) * 3);
    fewerKinds.set(kinds.subarray(piece * 4, piece * 4 + 4), i * 4);
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

/** The coarsest level whose error is less than a pixel. */
export function fitting(levels: Level[], scale: number): Level {
  return levels.find((level) => level.error * scale < 0.8) ?? levels[levels.length - 1];
}

/** How many pieces of a level come up to a piece of the path. */
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

/** Runs of pieces that may be in sight: first, and behind the last. */
export function inSight(level: Level, sees: (box: Float32Array, at: number) => boolean): [number, number][] {
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
