// Draws the tool: a cylinder with the job's diameter, with a point if it drills.

import type { Program } from "../program.ts";
import type { Camera, Vector } from "./camera.ts";
import { type Colour, type Colours, css } from "./colours.ts";

/** A tool in the units of the picture. */
export interface Shape {
  radius: number;
  corner: number;
  /** The tool makes holes, so it is drawn with a point. */
  drills: boolean;
}

/** Length of a drawn tool, in diameters. */
const LENGTH = 4;
/** Height of a drill's point, in radii: an angle of 118 degrees. */
const POINT = 0.6;

/** The tools of a program by their numbers in `moveTool`, without tools of unknown diameter. */
export function shapesOf(program: Program, sizes: { number: number; diameter: number | null; corner: number | null }[]): Map<number, Shape> {
  const { head, holeTool } = program.path!;
  const scale = head.units === "inch" ? 1 / 25.4 : 1;
  const found = new Map<number, Shape>();
  head.tools.forEach((number, at) => {
    const size = sizes.find((size) => size.number === number);
    if (!at || !size?.diameter) return;
    const radius = (size.diameter * scale) / 2;
    found.set(at, { radius, corner: Math.min(radius, (size.corner ?? 0) * scale), drills: holeTool.includes(at) });
  });
  return found;
}

/** The direction of the tool on the part after a line: up, turned by the rotary axes. Null if the tool is not upright, as on lathes and wires. */
export function upOf(program: Program, line: number): Vector | null {
  const { head } = program.path!;
  if (head.letters !== "XYZ" || head.view === "lathe") return null;
  const [a, b, c] = (["a", "b", "c"] as const).map((axis) => ((program.held(axis, line)?.value ?? 0) * Math.PI) / 180);
  // the same rotation as in src/picture/frame.rs
  let [x, y, z] = [0, -Math.sin(a), Math.cos(a)];
  [z, x] = [z * Math.cos(b) - x * Math.sin(b), z * Math.sin(b) + x * Math.cos(b)];
  [x, y] = [x * Math.cos(c) - y * Math.sin(c), x * Math.sin(c) + y * Math.cos(c)];
  return [x, y, z];
}

export function drawTool(context: CanvasRenderingContext2D, camera: Camera, colours: Colours, colour: Colour, at: Vector, up: Vector, shape: Shape): void {
  const { radius, drills } = shape;
  const along = (by: number): Vector => at.map((value, axis) => value + up[axis] * by) as Vector;
  // two directions across the tool
  const aside: Vector = Math.abs(up[0]) < 0.9 ? [1, 0, 0] : [0, 1, 0];
  const first = unit(cross(up, aside));
  const second = cross(up, first);
  const ring = (height: number): [number, number][] => Array.from({ length: 33 }, (_, i) => {
    const angle = (i / 32) * 2 * Math.PI;
    const center = along(height);
    return camera.project(center.map((value, axis) => value + radius * (Math.cos(angle) * first[axis] + Math.sin(angle) * second[axis])));
  });
  const bottom = ring(drills ? radius * POINT : 0);
  const top = ring(radius * 2 * LENGTH);
  const outline = hull([...bottom, ...top, ...(drills ? [camera.project(at)] : [])]);
  context.beginPath();
  outline.forEach(([x, y], i) => (i ? context.lineTo(x, y) : context.moveTo(x, y)));
  context.closePath();
  context.fillStyle = css(colour, 0.22);
  context.strokeStyle = css(colour, 0.8);
  context.lineWidth = 1;
  context.fill();
  context.stroke();
  context.beginPath();
  top.forEach(([x, y], i) => (i ? context.lineTo(x, y) : context.moveTo(x, y)));
  context.fillStyle = css(colours.paper, 0.35);
  context.fill();
  context.stroke();
}

function cross(a: Vector, b: Vector): Vector {
  return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
}

function unit(a: Vector): Vector {
  const length = Math.hypot(...a) || 1;
  return a.map((value) => value / length) as Vector;
}

/** The convex outline of points. */
function hull(points: [number, number][]): [number, number][] {
  const sorted = [...points].sort((a, b) => a[0] - b[0] || a[1] - b[1]);
  const turns = (o: [number, number], a: [number, number], b: [number, number]) => (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0]);
  const side = (of: [number, number][]) => {
    const chain: [number, number][] = [];
    for (const point of of) {
      while (chain.length > 1 && turns(chain[chain.length - 2], chain[chain.length - 1], point) <= 0) chain.pop();
      chain.push(point);
    }
    return chain.slice(0, -1);
  };
  return [...side(sorted), ...side(sorted.reverse())];
}
