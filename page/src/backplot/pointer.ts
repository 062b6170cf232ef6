// Pointer and keys of the path: turning, moving, zooming, pointing and clicking.

import type { Camera } from "./camera.ts";

/** Maximum movement of a click in pixels. */
const STILL = 4;

export interface Acts {
  /** Called when the view has changed. */
  turned(): void;
  /** Called when the pointer is at a pixel, at most once per frame. */
  hover(x: number, y: number): void;
  leave(): void;
  click(x: number, y: number): void;
}

export function listen(canvas: HTMLCanvasElement, camera: Camera, acts: Acts): void {
  let from: [number, number] | null = null;
  let moved = 0;
  let hovered = 0;
  canvas.onpointerdown = (event) => {
    from = [event.offsetX, event.offsetY];
    moved = 0;
    canvas.setPointerCapture(event.pointerId);
  };
  canvas.onpointermove = (event) => {
    if (from) {
      const [dx, dy] = [event.offsetX - from[0], event.offsetY - from[1]];
      moved += Math.abs(dx) + Math.abs(dy);
      if (moved < STILL) return;
      if (event.shiftKey || event.buttons !== 1) camera.pan(dx, dy);
      else camera.orbit(dx, dy);
      from = [event.offsetX, event.offsetY];
      acts.turned();
      return;
    }
    cancelAnimationFrame(hovered);
    const [x, y] = [event.offsetX, event.offsetY];
    hovered = requestAnimationFrame(() => acts.hover(x, y));
  };
  canvas.onpointerleave = () => acts.leave();
  canvas.onpointerup = (event) => {
    const was = from;
    from = null;
    if (was && moved < STILL && event.button === 0) acts.click(event.offsetX, event.offsetY);
  };
  canvas.oncontextmenu = (event) => event.preventDefault();
  canvas.addEventListener("wheel", (event) => {
    event.preventDefault();
    camera.zoom(Math.exp(-event.deltaY * (event.deltaMode ? 0.05 : 0.0016)), event.offsetX, event.offsetY);
    acts.turned();
  }, { passive: false });
  canvas.onkeydown = (event) => {
    const turn = { ArrowLeft: [-20, 0], ArrowRight: [20, 0], ArrowUp: [0, -20], ArrowDown: [0, 20] }[event.key];
    const zoom = { "+": 1.25, "=": 1.25, "-": 0.8 }[event.key];
    if (!turn && !zoom) return;
    event.preventDefault();
    event.stopPropagation();
    if (turn && event.shiftKey) camera.pan(turn[0], turn[1]);
    else if (turn) camera.orbit(turn[0], turn[1]);
    if (zoom) camera.zoom(zoom, camera.width / 2, camera.height / 2);
    acts.turned();
  };
}
