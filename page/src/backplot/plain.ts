// Lines on a plain canvas, where a browser has no WebGL2 or no GPU: 100,000 lines take a twentieth of what WebGL2 by software takes.

import type { Camera } from "./camera.ts";
import { type Colour, type Colours, css, ofTool } from "./colours.ts";
import type { Painter, Stroke } from "./painter.ts";

export class PlainPainter implements Painter {
  readonly name = "canvas";
  readonly most = { still: 250_000, moving: 25_000 };
  private camera!: Camera;
  private colours!: Colours;

  constructor(private readonly context: CanvasRenderingContext2D) {}

  begin(camera: Camera, colours: Colours, ratio: number): void {
    [this.camera, this.colours] = [camera, colours];
    const { canvas } = this.context;
    this.context.setTransform(ratio, 0, 0, ratio, 0, 0);
    this.context.clearRect(0, 0, canvas.width, canvas.height);
    this.context.lineJoin = "round";
    this.context.lineCap = "round";
  }

  stroke({ level, from, to, width, alpha, colour, dashed }: Stroke): void {
    const { context, camera } = this;
    const { points, kinds } = level;
    const [right, up] = camera.axes();
    const [cx, cy] = [camera.width / 2, camera.height / 2];
    const { target, scale } = camera;
    context.lineWidth = width;
    let open = -1;
    for (let piece = from; piece <= to; piece++) {
      const look = piece < to && kinds[piece * 4] !== 3 ? kinds[piece * 4] === 0 ? 0 : 1 + kinds[piece * 4 + 1] : -1;
      if (look !== open) {
        if (open >= 0) context.stroke();
        if (look >= 0) {
          const own: Colour = look === 0 ? this.colours.rapid : ofTool(this.colours, look - 1);
          context.strokeStyle = css(colour ?? own, alpha);
          context.setLineDash(look === 0 && dashed ? [4, 3] : []);
          context.beginPath();
          this.point(points, piece, true, right, up, target, scale, cx, cy);
        }
        open = look;
      }
      if (look >= 0) this.point(points, piece + 1, false, right, up, target, scale, cx, cy);
    }
  }

  private point(
    points: Float32Array, at: number, first: boolean, right: number[], up: number[], target: number[], scale: number, cx: number, cy: number,
  ): void {
    const [x, y, z] = [points[at * 3] - target[0], points[at * 3 + 1] - target[1], points[at * 3 + 2] - target[2]];
    const px = cx + (x * right[0] + y * right[1] + z * right[2]) * scale;
    const py = cy - (x * up[0] + y * up[1] + z * up[2]) * scale;
    if (first) this.context.moveTo(px, py);
    else this.context.lineTo(px, py);
  }

  forget(): void {}
}
