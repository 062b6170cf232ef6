// The distance between two points of the path.

import type { Path } from "../scene.ts";
import type { Camera, Vector } from "./camera.ts";
import { type Colours, css } from "./colours.ts";

export class Measure {
  private points: Vector[] = [];
  /** Whether measuring is on. Then a click selects a point instead of a block. */
  isOn = false;

  /** Turns measuring on or off, and forgets the points. */
  toggle(): void {
    this.isOn = !this.isOn;
    this.points = [];
  }

  forget(): void {
    this.points = [];
  }

  /** Selects the end of a piece that is nearer to a pixel. */
  take(path: Path, piece: number, camera: Camera, x: number, y: number): void {
    const ends = [piece, piece + 1].map((point) => [...path.points.subarray(point * 3, point * 3 + 3)] as Vector);
    const away = (point: Vector) => {
      const [px, py] = camera.project(point);
      return Math.hypot(px - x, py - y);
    };
    if (this.points.length === 2) this.points = [];
    this.points.push(away(ends[0]) < away(ends[1]) ? ends[0] : ends[1]);
  }

  /** The distance and its parts along the axes, as text. Empty until two points are selected. */
  words(units: string): string {
    if (this.points.length < 2) return this.isOn ? `measure: click ${this.points.length ? "the second" : "the first"} point of the path` : "";
    const [a, b] = this.points;
    const by = a.map((value, axis) => b[axis] - value);
    const shown = (value: number) => String(Math.round(value * 1e4) / 1e4 + 0);
    return `distance ${shown(Math.hypot(...by))} ${units} · X ${shown(by[0])} Y ${shown(by[1])} Z ${shown(by[2])}`;
  }

  draw(context: CanvasRenderingContext2D, camera: Camera, colours: Colours): void {
    const pixels = this.points.map((point) => camera.project(point));
    context.strokeStyle = context.fillStyle = css(colours.ink);
    context.lineWidth = 1.2;
    for (const [x, y] of pixels) {
      context.beginPath();
      context.arc(x, y, 3.5, 0, 7);
      context.fill();
    }
    if (pixels.length < 2) return;
    context.beginPath();
    context.moveTo(...pixels[0]);
    context.lineTo(...pixels[1]);
    context.stroke();
  }
}
