// Draws a height field. Cells are drawn from the farthest to the nearest, so that near cells cover those behind them.

import type { Camera } from "./camera.ts";
import { type Colour, type Colours, mix, TOOLS } from "./colours.ts";
import type { Stock } from "./stock.ts";

/** Size of a drawn cell in pixels, at rest and while the view or stock changes. Finer cells are drawn together. */
const PIXELS = { still: 1.6, moving: 3.2 };
/** Number of brightness steps. */
const LIGHT = 32;

export function drawRelief(context: CanvasRenderingContext2D, camera: Camera, colours: Colours, ratio: number, stock: Stock, moving: boolean): void {
  const { canvas } = context;
  const image = context.createImageData(canvas.width, canvas.height);
  const pixels = new Uint32Array(image.data.buffer);
  const [right, up, eye] = camera.axes();
  const scale = camera.scale * ratio;
  const stride = Math.max(1, Math.ceil((moving ? PIXELS.moving : PIXELS.still) / (stock.cell * scale)));
  const { wide, deep, heights, tools, bottom } = stock;
  const size = stock.cell * stride;
  // half the size of a cell in pixels, across and up
  const half = Math.max(1, ((Math.abs(right[0]) + Math.abs(right[1])) * size * scale) / 2);
  const rise = Math.max(0.6, ((Math.abs(up[0]) + Math.abs(up[1])) * size * scale) / 2);
  const palette = brightness(colours);
  const [columns, rows] = [order(wide, stride, eye[0]), order(deep, stride, eye[1])];
  const [ahead, aside] = [eye[0] > 0 ? stride : -stride, eye[1] > 0 ? stride : -stride];
  const at = (column: number, row: number) => (column < 0 || row < 0 || column >= wide || row >= deep ? bottom : heights[row * wide + column]);
  for (const row of rows) {
    for (const column of columns) {
      const cell = row * wide + column;
      const height = heights[cell];
      const [x, y] = [stock.x + column * stock.cell - camera.target[0], stock.y + row * stock.cell - camera.target[1]];
      const px = canvas.width / 2 + (x * right[0] + y * right[1] + (height - camera.target[2]) * right[2]) * scale;
      const py = canvas.height / 2 - (x * up[0] + y * up[1] + (height - camera.target[2]) * up[2]) * scale;
      if (px < -half || px > canvas.width + half) continue;
      // the light comes from the front left, from above
      const [sx, sy] = [(at(column + stride, row) - at(column - stride, row)) / (2 * size), (at(column, row + stride) - at(column, row - stride)) / (2 * size)];
      const edge = column < stride || row < stride || column + stride >= wide || row + stride >= deep;
      const bright = edge ? 0.8 : Math.max(0.25, Math.min(1, (0.45 * sx + 0.4 * sy + 0.8) / Math.hypot(sx, sy, 1)));
      const tint = tools[cell];
      const colour = palette[tint * LIGHT + Math.round(bright * (LIGHT - 1))];
      // a wall goes down to the lower of the two cells in front of the wall
      const lower = Math.min(at(column + ahead, row), at(column, row + aside));
      const wall = Math.max(0, height - lower) * up[2] * scale;
      const [left, end] = [Math.max(0, Math.round(px - half)), Math.min(canvas.width, Math.round(px + half))];
      const [above, below] = [Math.max(0, Math.round(py - rise)), Math.min(canvas.height, Math.round(py + rise))];
      const foot = Math.min(canvas.height, Math.round(py + rise + wall));
      for (let line = above; line < below; line++) pixels.fill(colour, line * canvas.width + left, line * canvas.width + end);
      const dark = palette[tint * LIGHT + Math.round(0.35 * (LIGHT - 1))];
      for (let line = Math.max(0, below); line < foot; line++) pixels.fill(dark, line * canvas.width + left, line * canvas.width + end);
    }
  }
  context.putImageData(image, 0, 0);
}

/** Indices of cells along a side, beginning with the farthest from the viewer. */
function order(count: number, stride: number, eye: number): number[] {
  const cells = Array.from({ length: Math.ceil(count / stride) }, (_, i) => i * stride);
  return eye > 0 ? cells : cells.reverse();
}

/** Pixel colours of the uncut stock and of each tool's cuts, for each brightness. */
function brightness(colours: Colours): Uint32Array {
  const made = new Uint32Array((TOOLS + 1) * LIGHT);
  for (let tint = 0; tint <= TOOLS; tint++) {
    const base: Colour = tint ? mix(colours.stock, colours.tools[tint - 1], 0.38) : colours.stock;
    for (let light = 0; light < LIGHT; light++) {
      const part = (value: number) => Math.round(255 * Math.min(1, value * (0.35 + (0.75 * light) / (LIGHT - 1))));
      const [red, green, blue] = base.map(part);
      made[tint * LIGHT + light] = (255 << 24) | (blue << 16) | (green << 8) | red;
    }
  }
  return made;
}
