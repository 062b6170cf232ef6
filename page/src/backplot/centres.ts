// The path of the tool's centre while the control compensates the radius (G41, G42). The radius register is assumed to contain the tool's radius,
// because no program contains it.

import type { Program } from "../program.ts";
import type { Shape } from "./tool.ts";

/** Sharper corners than this (1 + cosine of the angle of the turn) are not extended to a point: the control moves around them. */
const SHARP = 0.25;

/** The points of the path, moved to the tool's centre beside the programmed line. If nothing is compensated, the same array is returned. */
export function centresOf(program: Program, shapes: Map<number, Shape>): Float32Array {
  const { points, first, moveKind, moveLine, moveTool, moves } = program.path!;
  let made: Float32Array | null = null;
  /** The direction to the left of a piece in the plane; null if the piece does not move in the plane. */
  const left = (piece: number): [number, number] | null => {
    const [dx, dy] = [points[piece * 3 + 3] - points[piece * 3], points[piece * 3 + 4] - points[piece * 3 + 1]];
    const length = Math.hypot(dx, dy);
    return length > 0 ? [-dy / length, dx / length] : null;
  };
  const cuts = (move: number) => (moveKind[move] & 15) === 1 || (moveKind[move] & 15) === 2;
  const side = (move: number): number => {
    const code = cuts(move) ? program.held("compensation", moveLine[move])?.value : 40;
    return code === 41 ? 1 : code === 42 ? -1 : 0;
  };
  for (let move = 0; move < moves; move++) {
    const radius = (shapes.get(moveTool[move])?.radius ?? 0) * side(move);
    if (!radius) continue;
    made ??= points.slice();
    const goesOn = move + 1 < moves && side(move + 1) !== 0;
    for (let piece = first[move]; piece < first[move + 1]; piece++) {
      const isLast = piece + 1 === first[move + 1];
      const [before, after] = [left(piece), !isLast || goesOn ? left(piece + 1) : null];
      const [a, b] = [before ?? after, after ?? before];
      if (!a || !b) continue;
      const along = 1 + a[0] * b[0] + a[1] * b[1];
      const by = along > SHARP ? [(a[0] + b[0]) / along, (a[1] + b[1]) / along] : b;
      made[piece * 3 + 3] = points[piece * 3 + 3] + radius * by[0];
      made[piece * 3 + 4] = points[piece * 3 + 4] + radius * by[1];
    }
  }
  return made ?? points;
}
