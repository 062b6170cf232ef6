// Finds the piece under the pointer.

import type { Camera } from "./camera.ts";
import { AGAIN, count, inSight, type Level } from "./levels.ts";

/** The piece nearest to a pixel, within `reach` pixels. Cuts are preferred to rapids. -1: there is none. */
export function pick(level: Level, camera: Camera, x: number, y: number, reach: number): number {
  const [right, up] = camera.axes();
  const { points, kinds } = level;
  const { target, scale } = camera;
  const [cx, cy] = [camera.width / 2 - x, camera.height / 2 - y];
  const px = (at: number) =>
    cx + ((points[at] - target[0]) * right[0] + (points[at + 1] - target[1]) * right[1] + (points[at + 2] - target[2]) * right[2]) * scale;
  const py = (at: number) =>
    cy - ((points[at] - target[0]) * up[0] + (points[at + 1] - target[1]) * up[1] + (points[at + 2] - target[2]) * up[2]) * scale;
  const sees = (box: Float32Array, at: number) => overlaps(box, at, camera, x - reach, y - reach, x + reach, y + reach);
  let best = -1;
  let least = reach * reach;
  for (const [from, to] of count(level) ? inSight(level, sees) : []) {
    let [ax, ay] = [px(from * 3), py(from * 3)];
    for (let piece = from; piece < to; piece++) {
      const at = (piece + 1) * 3;
      const [bx, by] = [px(at), py(at)];
      const kind = kinds[piece * 4];
      if (kind !== 3) {
        const [dx, dy] = [bx - ax, by - ay];
        const length = dx * dx + dy * dy;
        const share = length > 0 ? Math.max(0, Math.min(1, -(ax * dx + ay * dy) / length)) : 0;
        const [nx, ny] = [ax + share * dx, ay + share * dy];
        // a rapid is selected only if it is a few pixels nearer than any cut
        const distance = nx * nx + ny * ny + (kind === 0 || kind === AGAIN ? 9 : 0);
        if (distance < least) [least, best] = [distance, piece];
      }
      [ax, ay] = [bx, by];
    }
  }
  return best < 0 ? -1 : level.pieces ? level.pieces[best] : best;
}

/** May a box be visible in a rectangle of pixels? */
export function overlaps(
  box: Float32Array, at: number, camera: Camera, left: number, top: number, right: number, bottom: number,
): boolean {
  const [across, up] = camera.axes();
  let [least, greatest, low, high] = [0, 0, 0, 0];
  for (let axis = 0; axis < 3; axis++) {
    const [from, to] = [box[at + axis] - camera.target[axis], box[at + 3 + axis] - camera.target[axis]];
    least += Math.min(from * across[axis], to * across[axis]);
    greatest += Math.max(from * across[axis], to * across[axis]);
    low += Math.min(from * up[axis], to * up[axis]);
    high += Math.max(from * up[axis], to * up[axis]);
  }
  const [cx, cy] = [camera.width / 2, camera.height / 2];
  return cx + least * camera.scale <= right && cx + greatest * camera.scale >= left &&
    cy - high * camera.scale <= bottom && cy - low * camera.scale >= top;
}
