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
  /** Colour of the stroke in place of the colours of tools and rapids. */
  colour?: Colour;
  /** Rapids are drawn as dashed lines. */
  dashed: boolean;
}

/** The meaning of colours in a picture, and the length of dashes. */
export interface Style {
  /** Byte 2 of a piece is a value of the colour ramp, not the number of a colour. */
  ramp: boolean;
  /** Length of a dash in pixels, for rapids. */
  dash: number;
}

/** Rapids are thinner and fainter than cuts. */
export const RAPID = { width: 0.7, alpha: 0.75 };

export interface Painter {
  readonly name: string;
  /** The context for the ground, below the lines. Null: the ground has a separate canvas. */
  readonly ground: CanvasRenderingContext2D | null;
  /** Maximum number of lines in a still picture, and while the view moves. */
  readonly most: { still: number; moving: number };
  begin(camera: Camera, colours: Colours, ratio: number, style: Style): void;
  stroke(stroke: Stroke): void;
  /** Frees levels that are no longer drawn. */
  forget(levels: Level[]): void;
}
