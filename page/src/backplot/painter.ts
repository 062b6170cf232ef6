// Draws lines: with WebGL2 if there is a GPU, else on a plain canvas.

import type { Camera } from "./camera.ts";
import type { Colour, Colours } from "./colours.ts";
import type { Level } from "./levels.ts";

/** Some pieces of a level, and their style. */
export interface Stroke {
  level: Level;
  from: number;
  to: number;
  width: number;
  alpha: number;
  /** Overrides the colours of tools and rapids. */
  colour?: Colour;
  /** Rapids are dashed. */
  dashed: boolean;
}

/** What colours mean in a picture, and how long dashes are. */
export interface Style {
  /** Byte 2 of the pieces is a value of the ramp, not the number of a colour. */
  ramp: boolean;
  /** Length of a dash of rapids in pixels. */
  dash: number;
}

/** Rapids beside cuts: thinner and fainter. */
export const RAPID = { width: 0.7, alpha: 0.75 };

export interface Painter {
  readonly name: string;
  /** Where the ground is drawn, under the lines; null: on a canvas of its own. */
  readonly ground: CanvasRenderingContext2D | null;
  /** Maximum number of lines: for a still picture, and while the view moves. */
  readonly most: { still: number; moving: number };
  begin(camera: Camera, colours: Colours, ratio: number, style: Style): void;
  stroke(stroke: Stroke): void;
  /** Frees levels that are no longer drawn. */
  forget(levels: Level[]): void;
}
