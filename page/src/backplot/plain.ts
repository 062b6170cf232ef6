// Draws lines on a plain canvas, for browsers without WebGL2 or without a GPU. It draws 100,000 lines twenty times as fast as WebGL2 in software.

import type { Camera } from "./camera.ts";
import { type Colour, type Colours, css, faded, ofValue } from "./colours.ts";
import { AGAIN, JUMP } from "./levels.ts";
import { type Painter, RAPID, type Stroke, type Style } from "./painter.ts";

/** Number of steps in which shades are drawn, and number of steps for values. */
const STEPS = 12;

export class PlainPainter implements Painter {
  readonly name = "canvas";
  readonly ground: CanvasRenderingContext2D;
  readonly most = { still: 250_000, moving: 25_000 };
  private camera!: Camera;
  private colours!: Colours;
  private style!: Style;

  constructor(private readonly context: CanvasRenderingContext2D) {
    this.ground = context;
  }

  begin(camera: Camera, colours: Colours, ratio: number, style: Style): void {
    [this.camera, this.colours, this.style] = [camera, colours, style];
    const { canvas } = this.context;
    this.context.setTransform(ratio, 0, 0, ratio, 0, 0);
    this.context.clearRect(0, 0, canvas.width, canvas.height);
    this.context.lineJoin = "round";
    this.context.lineCap = "round";
  }

  /** Draws pieces grouped by colour: first the rapids, then the cuts from the deepest to the highest, so that higher cuts cover deeper ones. */
  stroke({ level, from, to, width, alpha, colour, dashed }: Stroke): void {
    const { context, camera, style } = this;
    const { points, kinds } = level;
    const [right, up] = camera.axes();
    const [cx, cy] = [camera.width / 2, camera.height / 2];
    const { target, scale } = camera;
    const px = (at: number) => cx + ((points[at] - target[0]) * right[0] + (points[at + 1] - target[1]) * right[1] + (points[at + 2] - target[2]) * right[2]) * scale;
    const py = (at: number) => cy - ((points[at] - target[0]) * up[0] + (points[at + 1] - target[1]) * up[1] + (points[at + 2] - target[2]) * up[2]) * scale;
    const paths = new Map<number, { path: Path2D; end: number }>();
    const add = (key: number, piece: number) => {
      let open = paths.get(key);
      if (!open) paths.set(key, (open = { path: new Path2D(), end: -1 }));
      if (open.end !== piece) open.path.moveTo(px(piece * 3), py(piece * 3));
      open.path.lineTo(px(piece * 3 + 3), py(piece * 3 + 3));
      open.end = piece + 1;
    };
    const step = (value: number) => Math.round((value / 255) * (STEPS - 1));
    for (let piece = from; piece < to; piece++) {
      const kind = kinds[piece * 4];
      if (kind === JUMP || (kind === AGAIN && !colour)) continue;
      if (colour) add(0, piece);
      else if (kind === 0) add(-1, piece);
      else add(step(kinds[piece * 4 + 3]) * 256 + (style.ramp ? step(kinds[piece * 4 + 2]) : kinds[piece * 4 + 2]), piece);
    }
    for (const [key, { path }] of [...paths].sort(([a], [b]) => a - b)) {
      const isRapid = key < 0;
      const value = key & 255;
      const own = (): Colour => {
        const base = style.ramp ? ofValue(this.colours, (value / (STEPS - 1)) * 255) : this.colours.tools[value];
        return faded(this.colours, base, ((key >> 8) / (STEPS - 1)) * 255);
      };
      context.lineWidth = isRapid ? width * RAPID.width : width;
      context.strokeStyle = css(colour ?? (isRapid ? this.colours.rapid : own()), isRapid ? alpha * RAPID.alpha : alpha);
      context.setLineDash(isRapid && dashed ? [style.dash, style.dash * 0.75] : []);
      context.stroke(path);
    }
    context.setLineDash([]);
  }

  forget(): void {}
}
