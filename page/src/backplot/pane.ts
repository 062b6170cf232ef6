// The backplot: the path of a program, the old one under it, what is chosen, and a pointer to choose with.

import type { Program } from "../program.ts";
import { Path } from "../scene.ts";
import { element } from "../element.ts";
import { Camera, VIEWS } from "./camera.ts";
import { type Colours, colours, css, ofTool } from "./colours.ts";
import { GlPainter } from "./gl.ts";
import { count, drawable, fitting, type Level, levels, upTo } from "./levels.ts";
import type { Painter } from "./painter.ts";
import { overlaps, pick } from "./pick.ts";
import { PlainPainter } from "./plain.ts";

const REACH = 8;
/** Milliseconds after which a path that was turned is drawn in full. */
const REST = 150;

export class Backplot {
  readonly root: HTMLElement;
  private readonly canvas = element("canvas", { class: "path", role: "img", tabindex: "0" });
  private readonly over = element("canvas", { class: "over", "aria-hidden": "true" });
  private readonly views = element("div", { class: "views", role: "toolbar", "aria-label": "Views" });
  private readonly extents = element("span", {});
  private readonly legend = element("div", { class: "legend", "aria-hidden": "true" });
  private readonly camera = new Camera();
  private readonly painter: Painter;
  private colours: Colours;
  private program: Program | null = null;
  private levels: Level[] = [];
  private old: Level[] = [];
  private oldPath: Path | null = null;
  private line = 0;
  private lit: number[] = [];
  private bad: number[] = [];
  private drawnTo = Infinity;
  private asked = 0;
  private fits = true;
  /** It is being turned: a coarse picture now is better than a fine one late. */
  private moving = 0;
  /** Frames so far, and the time of the last: for measurements. */
  readonly frames = { count: 0, last: 0, pieces: 0 };
  onPick: (line: number) => void = () => {};
  onHover: (line: number | null) => void = () => {};

  constructor() {
    const gl = GlPainter.on(this.canvas);
    this.painter = gl ?? new PlainPainter(this.canvas.getContext("2d")!);
    this.colours = colours();
    const heading = element("h2", {}, "Path", this.extents);
    const fit = element("button", { title: "Show all of it (0)" }, "all");
    fit.onclick = () => this.fit();
    const nearer = element("button", { title: "Show the chosen block from near (z)" }, "block");
    nearer.onclick = () => this.zoomToBlock();
    for (const view of VIEWS) {
      const button = element("button", { "data-view": view.name, "aria-pressed": "false" }, view.name);
      button.onclick = () => this.look(view.name);
      this.views.append(button);
    }
    this.views.append(element("span", { class: "gap" }), fit, nearer);
    const stage = element("div", { class: "stage" }, this.canvas, this.over, this.legend);
    this.root = element("section", { class: "backplot", "aria-label": "Path" }, heading, this.views, stage);
    new ResizeObserver(() => this.resize()).observe(stage);
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.recolour());
    this.point();
  }

  get drawsBy(): string {
    return this.painter.name;
  }

  recolour(): void {
    this.colours = colours();
    this.redraw();
  }

  /** Another program; `old`: what is drawn under it. */
  show(program: Program | null, old: Program | null, differences: number[]): void {
    const before = this.program?.path;
    const path = program?.path;
    const marked = String(differences) === String(this.bad);
    this.program = program;
    this.bad = differences;
    if (path && path === before && (old?.path ?? null) === this.oldPath) return marked ? undefined : this.redraw();
    this.painter.forget([...this.levels, ...this.old]);
    if (path !== before) this.levels = path ? levels(path) : [];
    this.old = old?.path ? levels(shifted(old.path, program)) : [];
    this.oldPath = old?.path ?? null;
    if (path) {
      // the first picture of a long path is a coarse one, too
      if (path.pieces > this.painter.most.moving) this.moves();
      const [least, greatest] = path.head.extents;
      this.extents.textContent = ["X", "Y", "Z"].map((axis, i) => `${axis} ${short(least[i])}…${short(greatest[i])}`).join(" ") + ` ${path.head.units}`;
      this.canvas.setAttribute("aria-label", this.described());
      const view = before ? null : VIEWS.find((view) => view.name === path.head.view);
      if (view) this.camera.look(view);
      const moved = before && this.apart(before.head.middle, path.head.middle);
      if (moved) moved.forEach((by, axis) => (this.camera.target[axis] -= by));
      if (!before || this.fits) this.fit();
      this.tell();
    } else {
      this.extents.textContent = "";
      this.canvas.setAttribute("aria-label", "No path: there is no program");
      this.legend.replaceChildren();
    }
    this.redraw();
  }

  private apart(before: number[], now: number[]): number[] | null {
    const by = now.map((value, axis) => value - before[axis]);
    return by.some((value) => value !== 0) ? by : null;
  }

  private described(): string {
    const path = this.program!.path!;
    const { head } = path;
    const [least, greatest] = head.extents;
    const sides = ["X", "Y", "Z"].map((axis, i) => `${axis} ${short(least[i])} to ${short(greatest[i])}`).join(", ");
    return `Backplot: ${path.moves} moves, ${path.holeLine.length} holes, ${head.tools.length - 1} tools, ${sides} ${head.units}. Arrow keys turn it.`;
  }

  /** What the colours mean. */
  private tell(): void {
    const path = this.program!.path!;
    const used = new Set<number>();
    for (let move = 0; move < path.moves; move++) if ((path.moveKind[move] & 15) !== 0) used.add(path.moveTool[move]);
    const entries = [...used].sort((a, b) => a - b).slice(0, 12).map((tool) => {
      const entry = element("span", {}, tool === 0 ? "no tool" : `T${path.head.tools[tool]}`);
      entry.style.setProperty("--c", css(ofTool(this.colours, tool)));
      return entry;
    });
    this.legend.replaceChildren(element("span", { class: "rapid" }, "rapid"), ...entries);
    if (this.old.length) this.legend.append(element("span", { class: "was" }, "before"));
  }

  /** The chosen line, and others that belong to it. */
  choose(line: number, lit: number[]): void {
    [this.line, this.lit] = [line, lit];
    this.redraw();
  }

  /** Only the way up to a line is drawn in full; Infinity: all of it. */
  drawTo(line: number): void {
    this.drawnTo = line;
    this.redraw();
  }

  look(name: string): void {
    const view = VIEWS.find((view) => view.name === name);
    if (!view) return;
    this.camera.look(view);
    this.fit();
  }

  fit(): void {
    const path = this.program?.path;
    this.fits = true;
    // of a long path the coarse one
    if (path) this.camera.fit(this.levels[0].points);
    this.redraw();
  }

  zoomToBlock(): void {
    const path = this.program?.path;
    if (!path || !this.program) return;
    const [from, to] = this.program.moves(this.line);
    const first = to > from ? path.first[from] : this.program.pointAfter(this.line);
    const last = to > from ? path.first[to] : first;
    // a short block is shown with what is around it
    const points = path.points.subarray(first * 3, last * 3 + 3);
    const beside = [-1, 1].flatMap((side) => [0, 1, 2].map((axis) => points[axis] + (side * path.size) / 40));
    this.camera.fit([...points, ...beside]);
    this.fits = false;
    this.redraw();
  }

  private moves(): void {
    clearTimeout(this.moving);
    this.moving = window.setTimeout(() => {
      this.moving = 0;
      this.redraw();
    }, REST);
  }

  /** Another way of looking at it, in the next frame. */
  private turned(): void {
    this.fits = false;
    this.moves();
    this.redraw();
  }

  /** Draws in the next frame; the buttons say at once from where the path is looked at. */
  redraw(): void {
    for (const button of this.views.querySelectorAll("[data-view]")) {
      button.setAttribute("aria-pressed", String(button.getAttribute("data-view") === this.camera.view));
    }
    if (this.asked) return;
    this.asked = requestAnimationFrame(() => {
      this.asked = 0;
      this.draw();
    });
  }

  private resize(): void {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    const ratio = Math.min(2, devicePixelRatio || 1);
    for (const canvas of [this.canvas, this.over]) {
      [canvas.width, canvas.height] = [Math.max(1, Math.round(width * ratio)), Math.max(1, Math.round(height * ratio))];
    }
    [this.camera.width, this.camera.height] = [width, height];
    if (this.fits) this.fit();
    // at once: a canvas that changes its size is empty
    this.draw();
  }

  private draw(): void {
    const began = performance.now();
    const ratio = this.canvas.width / Math.max(1, this.camera.width);
    this.painter.begin(this.camera, this.colours, ratio);
    this.frames.pieces = 0;
    const { width, height, scale } = this.camera;
    const most = this.moving ? this.painter.most.moving : this.painter.most.still;
    const sees = (box: Float32Array, at: number) => overlaps(box, at, this.camera, 0, 0, width, height);
    if (this.old.length) {
      const [level, runs] = drawable(this.old, scale, sees, most);
      for (const [from, to] of runs) {
        this.painter.stroke({ level, from, to, width: 3, alpha: 0.5, colour: this.colours.old, dashed: true });
      }
    }
    const path = this.program?.path;
    if (path && this.levels.length) {
      const [level, runs] = drawable(this.levels, scale, sees, most);
      const until = this.drawnTo === Infinity ? count(level) : upTo(level, this.program!.pointAfter(this.drawnTo));
      for (const [from, to] of runs) {
        this.frames.pieces += to - from;
        const now = Math.max(from, Math.min(to, until));
        const line = { level, dashed: true, width: 1.5 };
        this.painter.stroke({ ...line, from, to: now, alpha: 0.9 });
        this.painter.stroke({ ...line, from: now, to, alpha: 0.16 });
      }
      const whole = this.levels[this.levels.length - 1];
      const light = (line: number, width: number, alpha: number, colour = this.colours.lit) => {
        const [from, to] = this.program!.moves(line);
        if (to > from) {
          this.painter.stroke({ level: whole, from: path.first[from], to: path.first[to], width, alpha, colour, dashed: false });
        }
      };
      this.lit.slice(0, 2000).forEach((line) => light(line, 2.5, 0.4));
      this.bad.forEach((line) => light(line, 4, 1, this.colours.bad));
      light(this.line, 4.5, 1);
    }
    this.drawOver(ratio);
    this.frames.count++;
    this.frames.last = performance.now() - began;
  }

  /** Holes, the tool, and which way the axes go. */
  private drawOver(ratio: number): void {
    const context = this.over.getContext("2d")!;
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    context.clearRect(0, 0, this.camera.width, this.camera.height);
    const path = this.program?.path;
    if (path && this.program) {
      this.drawHoles(context);
      const point = this.program.pointAfter(this.line);
      if (this.line > 0 && point > 0) {
        const [x, y] = this.camera.project(path.points, point * 3);
        context.beginPath();
        context.arc(x, y, 5.5, 0, 7);
        context.fillStyle = css(this.colours.lit);
        context.strokeStyle = css(this.colours.paper);
        context.lineWidth = 2;
        context.fill();
        context.stroke();
      }
      this.drawZero(context);
    }
    this.drawAxes(context);
  }

  private drawHoles(context: CanvasRenderingContext2D): void {
    const path = this.program!.path!;
    if (path.holeLine.length > 5000) return;
    for (let hole = 0; hole < path.holeLine.length; hole++) {
      const [x, y] = this.camera.project(path.holes, hole * 6);
      context.beginPath();
      context.arc(x, y, path.holeLine[hole] === this.line ? 4 : 2.4, 0, 7);
      context.fillStyle = css(path.holeLine[hole] === this.line ? this.colours.lit : ofTool(this.colours, path.holeTool[hole]));
      context.fill();
    }
  }

  /** Program zero. */
  private drawZero(context: CanvasRenderingContext2D): void {
    const [x, y] = this.camera.project(this.program!.path!.head.middle.map((value) => -value));
    context.strokeStyle = css(this.colours.dim, 0.9);
    context.lineWidth = 1;
    context.beginPath();
    context.arc(x, y, 4, 0, 7);
    context.moveTo(x - 8, y);
    context.lineTo(x + 8, y);
    context.moveTo(x, y - 8);
    context.lineTo(x, y + 8);
    context.stroke();
  }

  private drawAxes(context: CanvasRenderingContext2D): void {
    const [right, up] = this.camera.axes();
    const [x, y] = [34, this.camera.height - 34];
    context.font = "11px system-ui, sans-serif";
    context.textAlign = "center";
    context.textBaseline = "middle";
    context.lineWidth = 1.2;
    context.strokeStyle = context.fillStyle = css(this.colours.dim);
    ["X", "Y", "Z"].forEach((name, axis) => {
      const [dx, dy] = [right[axis], -up[axis]];
      if (Math.hypot(dx, dy) < 0.1) return;
      context.beginPath();
      context.moveTo(x, y);
      context.lineTo(x + dx * 20, y + dy * 20);
      context.stroke();
      context.fillText(name, x + dx * 28, y + dy * 28);
    });
  }

  /** The line whose move is at a pixel of the pane; null where there is none. */
  lineAt(x: number, y: number): number | null {
    const path = this.program?.path;
    if (!path) return null;
    const piece = pick(fitting(this.levels, this.camera.scale), this.camera, x, y, REACH);
    return piece < 0 ? null : path.moveLine[this.program!.moveOfPiece(piece)];
  }

  /** The pixel in the pane where a line ends, for tests. */
  pixelOf(line: number): [number, number] | null {
    const path = this.program?.path;
    if (!path) return null;
    const [from, to] = this.program!.moves(line);
    if (to <= from) return null;
    const [a, b] = [path.first[from], path.first[to]].map((point) => this.camera.project(path.points, point * 3));
    return [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2];
  }

  private point(): void {
    let from: [number, number] | null = null;
    let moved = 0;
    let hovered = 0;
    this.canvas.onpointerdown = (event) => {
      from = [event.offsetX, event.offsetY];
      moved = 0;
      this.canvas.setPointerCapture(event.pointerId);
    };
    this.canvas.onpointermove = (event) => {
      if (from) {
        const [dx, dy] = [event.offsetX - from[0], event.offsetY - from[1]];
        moved += Math.abs(dx) + Math.abs(dy);
        if (moved < 4) return;
        if (event.shiftKey || event.buttons !== 1) this.camera.pan(dx, dy);
        else this.camera.orbit(dx, dy);
        from = [event.offsetX, event.offsetY];
        this.turned();
        return;
      }
      cancelAnimationFrame(hovered);
      const [x, y] = [event.offsetX, event.offsetY];
      hovered = requestAnimationFrame(() => {
        const line = this.lineAt(x, y);
        this.canvas.style.cursor = line ? "pointer" : "";
        this.onHover(line);
      });
    };
    this.canvas.onpointerleave = () => this.onHover(null);
    this.canvas.onpointerup = (event) => {
      const was = from;
      from = null;
      if (!was || moved >= 4 || event.button !== 0) return;
      const line = this.lineAt(event.offsetX, event.offsetY);
      if (line) this.onPick(line);
    };
    this.canvas.oncontextmenu = (event) => event.preventDefault();
    this.canvas.addEventListener("wheel", (event) => {
      event.preventDefault();
      this.camera.zoom(Math.exp(-event.deltaY * (event.deltaMode ? 0.05 : 0.0016)), event.offsetX, event.offsetY);
      this.turned();
    }, { passive: false });
    this.canvas.onkeydown = (event) => {
      const turn = { ArrowLeft: [-20, 0], ArrowRight: [20, 0], ArrowUp: [0, -20], ArrowDown: [0, 20] }[event.key];
      const zoom = { "+": 1.25, "=": 1.25, "-": 0.8 }[event.key];
      if (!turn && !zoom) return;
      event.preventDefault();
      event.stopPropagation();
      if (turn && event.shiftKey) this.camera.pan(turn[0], turn[1]);
      else if (turn) this.camera.orbit(turn[0], turn[1]);
      if (zoom) this.camera.zoom(zoom, this.camera.width / 2, this.camera.height / 2);
      this.turned();
    };
  }
}

/** The old path, counted from the middle of the new one. */
function shifted(path: Path, program: Program | null): Path {
  const by = path.head.middle.map((value, axis) => value - (program?.path?.head.middle[axis] ?? value));
  return Object.assign(Object.create(Path.prototype) as Path, path, { points: path.points.map((value, at) => value + by[at % 3]) });
}

function short(value: number): string {
  return String(Math.round(value * 1000) / 1000 + 0);
}
