// The stock as a height field. The tools cut it along the path, and rapids through it are found.

import type { Path } from "../scene.ts";
import { inByte } from "./colours.ts";
import type { Plate } from "./ground.ts";
import { lowest } from "./sweep.ts";
import type { Shape } from "./tool.ts";

/** The size of the finest cell in millimetres, and the maximum number of cells along a side. */
const FINEST = 0.25;
const MOST_CELLS = 1000;
/** A rapid counts as a rapid through stock if it is farther below the surface than this distance in millimetres. The cells are not finer. */
const TOLERANCE = 0.2;
/** Number of pieces between two checks of the time. */
const BATCH = 64;

/** A block of material, relative to the middle of the picture. */
export interface Block {
  least: [number, number];
  greatest: [number, number];
  top: number;
}

export class Stock {
  /** Cells along X and along Y, and the size of a cell in the units of the picture. */
  readonly wide: number;
  readonly deep: number;
  readonly cell: number;
  /** Position of the middle of the first cell. */
  readonly x: number;
  readonly y: number;
  readonly top: number;
  readonly bottom: number;
  /** The height of each cell, and the tool that cut it last; 0: none. */
  readonly heights: Float32Array;
  readonly tools: Uint8Array;
  /** Lines whose rapids go through the stock. */
  readonly crashes = new Set<number>();
  /** Number of pieces that are cut. */
  private done = 0;
  private readonly tolerance: number;

  /** `centres`: the path of the tool's centre, with a point for each point of the path. */
  constructor(private readonly path: Path, private readonly centres: Float32Array, block: Block, lowest: number, private readonly shapes: Map<number, Shape>) {
    const unit = path.head.units === "inch" ? 1 / 25.4 : 1;
    const [width, depth] = [0, 1].map((axis) => block.greatest[axis] - block.least[axis]);
    this.cell = Math.max(FINEST * unit, Math.max(width, depth) / MOST_CELLS);
    this.tolerance = TOLERANCE * unit;
    this.wide = Math.max(1, Math.ceil(width / this.cell));
    this.deep = Math.max(1, Math.ceil(depth / this.cell));
    [this.x, this.y] = [block.least[0] + this.cell / 2, block.least[1] + this.cell / 2];
    this.top = block.top;
    this.bottom = lowest - Math.max(2 * this.cell, (this.top - lowest) * 0.15);
    this.heights = new Float32Array(this.wide * this.deep).fill(this.top);
    this.tools = new Uint8Array(this.wide * this.deep);
  }

  /** Cuts up to a piece, for at most this many milliseconds. Returns true when the piece is reached. For an earlier piece, cutting starts again with
   * the uncut block. */
  cutTo(piece: number, most: number): boolean {
    if (piece < this.done) {
      this.heights.fill(this.top);
      this.tools.fill(0);
      this.crashes.clear();
      this.done = 0;
    }
    const end = performance.now() + most;
    const { path } = this;
    let move = path.moveOfPiece(this.done);
    while (this.done < piece) {
      if (this.done % BATCH === 0 && performance.now() > end) return false;
      while (path.first[move + 1] <= this.done) move++;
      this.piece(this.done++, move);
    }
    return true;
  }

  private piece(piece: number, move: number): void {
    const { path } = this;
    const kind = path.moveKind[move] & 15;
    const tool = path.moveTool[move];
    const shape = this.shapes.get(tool);
    // a height that only the machine has counts as above everything
    if (kind === 3 || !shape || path.moveKind[move] & 128) return;
    const at = piece * 3;
    const points = this.centres;
    const from: [number, number, number] = [points[at], points[at + 1], points[at + 2]];
    const to: [number, number, number] = [points[at + 3], points[at + 4], points[at + 5]];
    if (Math.min(from[2], to[2]) >= this.top) return;
    if (kind === 0) {
      if (this.passes(from, to, shape)) this.crashes.add(path.moveLine[move]);
    } else this.cut(from, to, shape, tool);
  }

  /** The rows that a tool with this radius may touch along a piece. */
  private rows(from: number[], to: number[], radius: number): [number, number] {
    const row = (y: number) => Math.round((y - this.y) / this.cell);
    return [Math.max(0, row(Math.min(from[1], to[1]) - radius)), Math.min(this.deep - 1, row(Math.max(from[1], to[1]) + radius))];
  }

  /** The columns of the last row for which `columns` was called. */
  private left = 0;
  private right = -1;

  /** Finds the columns of a row that a tool may touch along a piece. Only the part of the piece near the row is considered. */
  private columns(row: number, from: number[], to: number[], radius: number): void {
    const dx = to[0] - from[0];
    const dy = to[1] - from[1];
    let first = 0;
    let last = 1;
    if (dy !== 0) {
      const middle = this.y + row * this.cell - from[1];
      const a = (middle - radius) / dy;
      const b = (middle + radius) / dy;
      first = Math.max(0, Math.min(a, b));
      last = Math.min(1, Math.max(a, b));
    }
    const a = from[0] + dx * first - this.x;
    const b = from[0] + dx * last - this.x;
    this.left = Math.max(0, Math.round((Math.min(a, b) - radius) / this.cell));
    this.right = first > last ? -1 : Math.min(this.wide - 1, Math.round((Math.max(a, b) + radius) / this.cell));
  }

  private cut(from: number[], to: number[], { radius, corner }: Shape, tool: number): void {
    const [low, high] = this.rows(from, to, radius);
    const [dx, dy, dz] = [to[0] - from[0], to[1] - from[1], to[2] - from[2]];
    const floor = Math.min(from[2], to[2]);
    for (let row = low; row <= high; row++) {
      const py = this.y + row * this.cell - from[1];
      this.columns(row, from, to, radius);
      const { left, right } = this;
      for (let column = left; column <= right; column++) {
        const px = this.x + column * this.cell - from[0];
        const cell = row * this.wide + column;
        if (this.heights[cell] <= floor) continue;
        const height = lowest(radius, corner, px, py, from[2], dx, dy, dz);
        if (height < this.heights[cell]) {
          this.heights[cell] = Math.max(height, this.bottom);
          this.tools[cell] = inByte(tool);
        }
      }
    }
  }

  /** Does a rapid go through the stock? Cells at the edge of the tool are not checked, because their surface may be up to one cell farther away. */
  private passes(from: number[], to: number[], shape: Shape): boolean {
    if (shape.radius <= this.cell) return false;
    // the cell under the axis is always checked
    const radius = Math.max(shape.radius - this.cell, this.cell * Math.SQRT1_2);
    const corner = Math.min(shape.corner, radius);
    const [low, high] = this.rows(from, to, radius);
    const [dx, dy, dz] = [to[0] - from[0], to[1] - from[1], to[2] - from[2]];
    const floor = Math.min(from[2], to[2]) + this.tolerance;
    for (let row = low; row <= high; row++) {
      const py = this.y + row * this.cell - from[1];
      this.columns(row, from, to, radius);
      const { left, right } = this;
      for (let column = left; column <= right; column++) {
        const height = this.heights[row * this.wide + column];
        if (height <= floor) continue;
        const px = this.x + column * this.cell - from[0];
        if (lowest(radius, corner, px, py, from[2], dx, dy, dz) < height - this.tolerance) return true;
      }
    }
    return false;
  }
}

/** An estimate of the stock if no size is given: the box of the cuts. */
export function blockOf(path: Path, { least, greatest }: Plate): Block {
  return { least: [least[0], least[1]], greatest: [greatest[0], greatest[1]], top: topOf(path, { least, greatest }) };
}

/** An estimate of the top of the stock: Z 0 if no sideways cut is above Z 0, else the height of the highest sideways cut. */
function topOf(path: Path, plate: Plate): number {
  let highest = -Infinity;
  for (let move = 0; move < path.moves; move++) {
    const kind = path.moveKind[move] & 15;
    if (kind !== 1 && kind !== 2) continue;
    for (let piece = path.first[move]; piece < path.first[move + 1]; piece++) {
      const at = piece * 3;
      const sideways = path.points[at] !== path.points[at + 3] || path.points[at + 1] !== path.points[at + 4];
      if (sideways) highest = Math.max(highest, path.points[at + 2], path.points[at + 5]);
    }
  }
  const zero = -path.head.middle[2];
  if (highest <= zero + 1e-6 && plate.least[2] < zero) return zero;
  return highest > -Infinity ? highest : plate.greatest[2];
}
