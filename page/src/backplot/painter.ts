// What draws lines: by WebGL2 where there is a GPU, else on a plain canvas.

import type { Camera } from "./camera.ts";
import type { Colour, Colours } from "./colours.ts";
import type { Level } from "./levels.ts";

/** Some pieces of a level, and how they look. */
export interface Stroke {
  level: Level;
  from: number;
  to: number;
  width: number;
  alpha: number;
  /** Instead of the colours of tools and rapids. */
  colour?: Colour;
  /** Rapids are dashed. */
  dashed: boolean;
}

export interface Painter {
  readonly name: string;
  /** How many lines it draws while nobody waits, and how many while the path is turned. */
  readonly most: { still: number; moving: number };
  begin(camera: Camera, colours: Colours, ratio: number): void;
  stroke(stroke: Stroke): void;
  /** Levels that are drawn no more. */
  forget(levels: Level[]): void;
}
