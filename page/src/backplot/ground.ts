// Draws below the path: the plate of the part with a grid, the axes of program zero, and a scale bar.

import type { Path } from "../scene.ts";
import type { Camera, Vector } from "./camera.ts";
import { type Colours, css } from "./colours.ts";

/** Minimum distance between two lines of the grid, in pixels. */
const GRID = 26;
/** Maximum length of the scale bar, in pixels. */
const BAR = 120;
/** Maximum number of lines: more lines would look like a grey area. */
const MOST_LINES = 400;

/** The box around the cuts, relative to the middle of the picture. */
export interface Plate {
  least: Vector;
  greatest: Vector;
}

/** The plate under the cuts of a program for a mill. Null if the program cuts nothing or is for another kind of machine. */
export function plateOf(path: Path): Plate | null {
  if (path.head.letters !== "XYZ" || path.ends.length || path.head.view === "lathe") return null;
  const least: Vector = [Infinity, Infinity, Infinity];
  const greatest: Vector = [-Infinity, -Infinity, -Infinity];
  const take = (points: Float32Array, at: number) => {
    for (let axis = 0; axis < 3; axis++) {
      const value = points[at + axis];
      if (value < least[axis]) least[axis] = value;
      if (value > greatest[axis]) greatest[axis] = value;
    }
  };
  for (let move = 0; move < path.moves; move++) {
    const kind = path.moveKind[move] & 15;
    if (kind !== 1 && kind !== 2) continue;
    for (let point = path.first[move]; point <= path.first[move + 1]; point++) take(path.points, point * 3);
  }
  for (let at = 0; at < path.holes.length; at += 3) take(path.holes, at);
  return least[0] <= greatest[0] ? { least, greatest } : null;
}

/** The least length that is 1, 2 or 5 times a power of ten and not less than the given length. */
export function round(length: number): number {
  const power = 10 ** Math.floor(Math.log10(length));
  return [1, 2, 5, 10].map((times) => times * power).find((value) => value >= length * (1 - 1e-9))!;
}

export function drawGround(context: CanvasRenderingContext2D, camera: Camera, colours: Colours, path: Path, plate: Plate | null): void {
  const middle = path.head.middle as Vector;
  if (plate) drawPlate(context, camera, colours, plate, middle);
  drawZero(context, camera, colours, middle, path.head.view === "lathe");
}

function drawPlate(context: CanvasRenderingContext2D, camera: Camera, colours: Colours, { least, greatest }: Plate, middle: Vector): void {
  const z = least[2];
  const at = (x: number, y: number) => camera.project([x, y, z]);
  const corners: [number, number][] = [[least[0], least[1]], [greatest[0], least[1]], [greatest[0], greatest[1]], [least[0], greatest[1]]];
  context.beginPath();
  corners.forEach(([x, y], i) => (i ? context.lineTo(...at(x, y)) : context.moveTo(...at(x, y))));
  context.closePath();
  context.fillStyle = css(colours.part);
  context.fill();
  // grid lines are at round coordinates of the program
  const step = round(GRID / camera.scale);
  const lines = (axis: 0 | 1) => {
    const first = Math.ceil((least[axis] + middle[axis]) / step);
    const last = Math.floor((greatest[axis] + middle[axis]) / step);
    if (last - first > MOST_LINES) return;
    for (let line = first; line <= last; line++) {
      const value = line * step - middle[axis];
      const ends = axis === 0 ? [at(value, least[1]), at(value, greatest[1])] : [at(least[0], value), at(greatest[0], value)];
      context.moveTo(...ends[0]);
      context.lineTo(...ends[1]);
    }
  };
  context.beginPath();
  lines(0);
  lines(1);
  context.strokeStyle = css(colours.grid);
  context.lineWidth = 1;
  context.stroke();
}

/** Draws program zero with its axes; for a lathe, the centre line. */
function drawZero(context: CanvasRenderingContext2D, camera: Camera, colours: Colours, middle: Vector, isLathe: boolean): void {
  const zero = middle.map((value) => -value) as Vector;
  const [x, y] = camera.project(zero);
  context.lineWidth = 1;
  if (isLathe) {
    const far = (by: number) => camera.project([zero[0], zero[1], zero[2] + by / camera.scale]);
    context.setLineDash([12, 4, 2, 4]);
    context.strokeStyle = css(colours.dim, 0.7);
    context.beginPath();
    context.moveTo(...far(-4000));
    context.lineTo(...far(4000));
    context.stroke();
    context.setLineDash([]);
  }
  context.font = "10px system-ui, sans-serif";
  context.textAlign = "center";
  context.textBaseline = "middle";
  ["X", "Y", "Z"].forEach((name, axis) => {
    const tip = [...zero] as Vector;
    tip[axis] += 30 / camera.scale;
    const [tx, ty] = camera.project(tip);
    const [dx, dy] = [tx - x, ty - y];
    if (Math.hypot(dx, dy) < 6) return;
    context.strokeStyle = context.fillStyle = css(colours.axes[axis]);
    context.lineWidth = 1.6;
    context.beginPath();
    context.moveTo(x, y);
    context.lineTo(tx, ty);
    context.stroke();
    context.fillText(name, x + dx * 1.28, y + dy * 1.28);
  });
  context.strokeStyle = css(colours.ink, 0.7);
  context.lineWidth = 1;
  context.beginPath();
  context.arc(x, y, 4, 0, 7);
  context.stroke();
}

/** Draws a bar of a round length with its label. */
export function drawBar(context: CanvasRenderingContext2D, camera: Camera, colours: Colours, units: string): void {
  let length = round(BAR / camera.scale / 2);
  if (length * 2 * camera.scale <= BAR) length *= 2;
  const wide = length * camera.scale;
  const [x, y] = [14, camera.height - 14];
  context.strokeStyle = context.fillStyle = css(colours.dim);
  context.lineWidth = 1.2;
  context.beginPath();
  context.moveTo(x, y - 5);
  context.lineTo(x, y);
  context.lineTo(x + wide, y);
  context.lineTo(x + wide, y - 5);
  context.stroke();
  context.font = "11px system-ui, sans-serif";
  context.textAlign = "left";
  context.textBaseline = "alphabetic";
  context.fillText(`${Number(length.toPrecision(1))} ${units}`, x + wide + 6, y);
}
