// Draws above the path: holes, the tool's tip, and the directions of the axes.

import type { Path } from "../scene.ts";
import type { Camera, Vector } from "./camera.ts";
import { type Colours, css, ofTool } from "./colours.ts";

/** Maximum number of holes that are drawn as circles. If there are more, only their moves are drawn. */
const MOST_HOLES = 5000;

/** Clears a canvas. Returns its context in pixels of the page. */
export function cleared(canvas: HTMLCanvasElement, camera: Camera, ratio: number): CanvasRenderingContext2D {
  const context = canvas.getContext("2d")!;
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  context.clearRect(0, 0, camera.width, camera.height);
  return context;
}

export function drawHoles(context: CanvasRenderingContext2D, camera: Camera, colours: Colours, path: Path, line: number): void {
  if (path.holeLine.length > MOST_HOLES) return;
  for (let hole = 0; hole < path.holeLine.length; hole++) {
    const [x, y] = camera.project(path.holes, hole * 6);
    const chosen = path.holeLine[hole] === line;
    context.beginPath();
    context.arc(x, y, chosen ? 4 : 2.4, 0, 7);
    context.fillStyle = css(chosen ? colours.lit : ofTool(colours, path.holeTool[hole]));
    context.fill();
  }
}

export function drawTip(context: CanvasRenderingContext2D, camera: Camera, colours: Colours, at: Vector): void {
  const [x, y] = camera.project(at);
  context.beginPath();
  context.arc(x, y, 5.5, 0, 7);
  context.fillStyle = css(colours.lit);
  context.strokeStyle = css(colours.paper);
  context.lineWidth = 2;
  context.fill();
  context.stroke();
}

/** Draws the directions of the axes, above the scale bar. */
export function drawAxes(context: CanvasRenderingContext2D, camera: Camera, colours: Colours): void {
  const [right, up] = camera.axes();
  const [x, y] = [34, camera.height - 62];
  context.font = "11px system-ui, sans-serif";
  context.textAlign = "center";
  context.textBaseline = "middle";
  context.lineWidth = 1.2;
  ["X", "Y", "Z"].forEach((name, axis) => {
    const [dx, dy] = [right[axis], -up[axis]];
    if (Math.hypot(dx, dy) < 0.1) return;
    context.strokeStyle = context.fillStyle = css(colours.axes[axis]);
    context.beginPath();
    context.moveTo(x, y);
    context.lineTo(x + dx * 20, y + dy * 20);
    context.stroke();
    context.fillText(name, x + dx * 28, y + dy * 28);
  });
}
