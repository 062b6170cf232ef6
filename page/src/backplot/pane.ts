// The backplot: shows the path of a program, the old path below it and the selected block. The pointer selects blocks.

import type { Program } from "../program.ts";
import { Path, type ToolSize } from "../scene.ts";
import { element } from "../element.ts";
import { Camera, type Vector, VIEWS } from "./camera.ts";
import { centresOf } from "./centres.ts";
import { type Colours, colours, ofTool } from "./colours.ts";
import { GlPainter } from "./gl.ts";
import { drawBar, drawGround, type Plate, plateOf } from "./ground.ts";
import { legendOf } from "./legend.ts";
import { count, drawable, fitting, type Level, levels, upTo } from "./levels.ts";
import { Measure } from "./measure.ts";
import { cleared, drawAxes, drawHoles, drawTip } from "./overlay.ts";
import type { Painter } from "./painter.ts";
import { overlaps, pick } from "./pick.ts";
import { PlainPainter } from "./plain.ts";
import { listen } from "./pointer.ts";
import type { Size } from "./size.ts";
import type { Solid } from "./solid.ts";
import type { Stock } from "./stock.ts";
import { drawTool, type Shape, shapesOf, upOf } from "./tool.ts";
import { type Meaning, MEANINGS, paint, type Shades } from "./shades.ts";

const REACH = 8;
/** Milliseconds after the last movement of the view before the full picture is drawn. */
const REST = 150;
/** Milliseconds in each frame for cutting the stock: while the timeline plays, and while the whole path is cut. */
const CUTTING = { playing: 20, whole: 80 };

export class Backplot {
  readonly root: HTMLElement;
  private readonly canvas = element("canvas", { class: "path", role: "img", tabindex: "0" });
  private readonly under = element("canvas", { class: "over", "aria-hidden": "true" });
  private readonly over = element("canvas", { class: "over", "aria-hidden": "true" });
  private readonly views = element("div", { class: "views", role: "toolbar", "aria-label": "Views" });
  private readonly extents = element("span", {});
  private readonly legend = element("div", { class: "legend", "aria-hidden": "true" });
  private readonly block = element("button", { "aria-pressed": "false", title: "Cut the stock along the path; rapids through it are marked (s)" }, "stock");
  private readonly ruler = element("button", { "aria-pressed": "false", title: "Measure between two points of the path (m)" }, "measure");
  /** Shows a measured distance, an instruction for the next click, or the reason why there is no stock. */
  private readonly told = element("div", { class: "told-here", role: "status", "aria-label": "Measure and stock" });
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
  /** Identifies the moves that are highlighted and the tool's position. */
  private emphasis = "";
  private plate: Plate | null = null;
  private meaning: Meaning = "tool";
  private shades: Shades | null = null;
  private readonly measure = new Measure();
  private shapes = new Map<number, Shape>();
  private sizes = "";
  /** Points of the tool's centre; computed when they are first needed. */
  private known: Float32Array | null = null;
  private readonly size: Size | null;
  /** The stock, if it is shown. */
  private stock: Stock | null = null;
  /** While the timeline plays: the last point that the tool has reached, and the tool's position. */
  private cursor: { point: number; at: Vector } | null = null;
  private asked = 0;
  private fits = true;
  /** Not 0 while the view moves. A coarse picture that is drawn fast is then better than a fine picture. */
  private moving = 0;
  /** Measurements: number of frames, time of the last frame, and number of pieces. */
  readonly frames = { count: 0, last: 0, pieces: 0 };
  onPick: (line: number) => void = () => {};
  onHover: (line: number | null) => void = () => {};
  /** Called with the program lines whose rapids go through the stock, as far as the stock is cut. */
  onCrash: (lines: number[]) => void = () => {};

  /** Without `solid`, no stock can be shown. */
  constructor(private readonly solid: Solid | null) {
    this.size = solid && new solid.Size();
    this.block.hidden = !solid;
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
    const options = MEANINGS.map((meaning) => element("option", { value: meaning }, meaning));
    const meaning = element("select", { "aria-label": "Colours show", title: "What the colours of cuts show" }, ...options);
    meaning.onchange = () => this.colourBy(meaning.value as Meaning);
    this.ruler.onclick = () => this.toggleMeasure();
    this.block.onclick = () => this.toggleStock();
    if (this.size) {
      this.size.onChange = () => {
        this.showStock();
        this.redraw();
      };
    }
    this.views.append(element("span", { class: "gap" }), meaning, this.block, this.ruler, fit, nearer);
    this.under.hidden = !!this.painter.ground;
    const stage = element("div", { class: "stage" }, this.under, this.canvas, this.over, this.legend, this.told);
    this.root = element("section", { class: "backplot", "aria-label": "Path" }, heading, this.views, ...(this.size ? [this.size.root] : []), stage);
    new ResizeObserver(() => this.resize()).observe(stage);
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.recolour());
    listen(this.canvas, this.camera, {
      turned: () => this.turned(),
      hover: (x, y) => {
        const line = this.lineAt(x, y);
        this.canvas.style.cursor = line ? "pointer" : "";
        this.onHover(line);
      },
      leave: () => this.onHover(null),
      click: (x, y) => {
        if (this.measure.isOn) return this.takePoint(x, y);
        const line = this.lineAt(x, y);
        if (line) this.onPick(line);
      },
    });
  }

  get drawsBy(): string {
    return this.painter.name;
  }

  recolour(): void {
    this.colours = colours();
    if (this.shades) this.tell();
    this.redraw();
  }

  /** Shows another program; `old` is the path that is drawn below it. */
  show(program: Program | null, old: Program | null, differences: number[], sizes: ToolSize[] = []): void {
    if (program?.path && JSON.stringify(sizes) !== this.sizes) {
      this.sizes = JSON.stringify(sizes);
      this.shapes = shapesOf(program, sizes);
      this.known = null;
      if (this.stock) this.showStock();
      this.redraw();
    }
    const before = this.program?.path;
    const path = program?.path;
    const marked = String(differences) === String(this.bad);
    this.program = program;
    this.bad = differences;
    if (path && before && (old?.path ?? null) === this.oldPath && path.looksLike(before)) return this.keep(path === before, marked);
    this.painter.forget([...this.levels, ...this.old]);
    this.old = old?.path ? levels(shifted(old.path, program)) : [];
    this.oldPath = old?.path ?? null;
    if (path !== before) {
      // most changes of a form do not move the tool
      if (!path || !before?.drawsLike(path)) this.levels = path ? levels(path) : [];
      this.plate = path ? plateOf(path) : null;
      this.shapes = program?.path ? shapesOf(program, sizes) : new Map();
      this.known = null;
      if (this.stock) this.showStock();
      this.cursor = null;
      this.measure.forget();
      if (path) this.colourBy(this.meaning);
    }
    if (path) {
      // the first picture of a long path is also coarse
      if (path.pieces > this.painter.most.moving) this.moves();
      const [least, greatest] = path.head.extents;
      const sides = [...path.head.letters].map((axis, i) => `${axis} ${short(least[i])}…${short(greatest[i])}`);
      this.extents.textContent = `${sides.join(" ")} ${path.head.units}`;
      this.extents.title = [...path.head.letters].map((axis, i) => `${axis}: ${short(greatest[i] - least[i])} ${path.head.units}`).join("\n");
      this.canvas.setAttribute("aria-label", this.described());
      const view = before ? null : VIEWS.find((view) => view.name === path.head.view);
      if (view) this.camera.look(view);
      const moved = before && this.apart(before.head.middle, path.head.middle);
      if (moved) moved.forEach((by, axis) => (this.camera.target[axis] -= by));
      if (!before || this.fits) this.fit();
    } else {
      this.extents.textContent = "";
      this.canvas.setAttribute("aria-label", "No path: there is no program");
      this.legend.replaceChildren();
    }
    this.redraw();
  }

  /** Keeps the drawn path for a program with the same moves. Only colours that depend on the words of the program may change. */
  private keep(isSame: boolean, marked: boolean): void {
    if (!isSame) {
      this.known = null;
      if (this.stock) this.showStock();
      if (this.meaning === "operation" || this.meaning === "feed") return this.colourBy(this.meaning);
    }
    if (!marked) this.redraw();
    else this.emphasise();
  }

  /** Redraws if other moves are highlighted than before. The moves of the selected block, of blocks from the same form line, and of
   * differences are highlighted. */
  private emphasise(): void {
    const { program } = this;
    const moves = program ? [this.line, ...this.lit, ...this.bad].map((line) => program.moves(line)) : [];
    const emphasis = `${moves.join(" ")} at ${program?.pointAfter(this.line)}`;
    if (emphasis === this.emphasis) return;
    this.emphasis = emphasis;
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

  /** Shows the legend of the colours. */
  private tell(): void {
    this.legend.replaceChildren(...legendOf(this.program!, this.shades!, this.colours, this.old.length > 0));
  }

  /** Sets the meaning of the colours of cuts. */
  private colourBy(meaning: Meaning): void {
    this.meaning = meaning;
    if (!this.program?.path) return;
    this.painter.forget(this.levels);
    this.shades = paint(this.levels, this.program, meaning);
    this.tell();
    this.redraw();
  }

  toggleStock(): void {
    if (this.stock) {
      this.stock = null;
      this.size?.hide();
      this.say("");
      this.onCrash([]);
    } else this.showStock();
    this.block.setAttribute("aria-pressed", String(!!this.stock));
    this.redraw();
  }

  /** Shows the stock of a mill's program whose tools have diameters. Otherwise shows why there is no stock. */
  private showStock(): void {
    const path = this.program?.path;
    const { solid, size } = this;
    if (!solid || !size) return;
    if (path && this.plate && this.shapes.size) {
      size.show(path, solid.blockOf(path, this.plate));
      const block = size.block(path);
      this.say("");
      this.stock = block && new solid.Stock(path, this.centres, block, this.plate.least[2], this.shapes);
      if (!block) this.say("no stock: give five numbers, the greater X and Y last, at most a hundred times as far apart as the cuts");
    } else {
      this.stock = null;
      this.size?.hide();
      this.say(`no stock: ${this.plate ? "the job gives no diameter of a tool" : "it is shown for mills of three axes"}`);
    }
    this.block.setAttribute("aria-pressed", String(!!this.stock));
  }

  /** Cuts the stock up to the tool's position, in steps, so that the page stays responsive. */
  private cutStock(): void {
    const path = this.program?.path;
    if (!this.stock || !path) return;
    const isThere = this.stock.cutTo(this.cursor?.point ?? path.pieces, this.cursor ? CUTTING.playing : CUTTING.whole);
    if (!isThere) this.moves();
    if (!isThere) this.redraw();
    else this.onCrash(this.size?.isGiven ? [...this.stock.crashes] : []);
  }

  private say(text: string): void {
    this.told.textContent = text;
  }

  endMeasure(): void {
    if (this.measure.isOn) this.toggleMeasure();
  }

  /** Turns measuring on or off. While measuring is on, clicks select points. */
  toggleMeasure(): void {
    this.measure.toggle();
    this.ruler.setAttribute("aria-pressed", String(this.measure.isOn));
    this.say(this.measure.words(this.program?.path?.head.units ?? ""));
    this.redraw();
  }

  /** Selects a line of the program. `lit` are further lines to highlight. */
  choose(line: number, lit: number[]): void {
    [this.line, this.lit] = [line, lit];
    this.emphasise();
  }

  /** For the timeline: draws the tool after a point of the path, and the rest of the path faintly. Null: draws the whole path normally. */
  drawTo(cursor: { point: number; at: Vector } | null): void {
    if (!cursor && !this.cursor) return;
    this.cursor = cursor;
    if (cursor) this.moves();
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
    // the coarse level is enough for a long path
    if (path) this.camera.fit(this.levels[0].points);
    this.redraw();
  }

  zoomToBlock(): void {
    const path = this.program?.path;
    if (!path || !this.program) return;
    const [from, to] = this.program.moves(this.line);
    const first = to > from ? path.first[from] : this.program.pointAfter(this.line);
    const last = to > from ? path.first[to] : first;
    // a short block is shown with its surroundings
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

  /** Called when the view has changed. The new view is drawn in the next frame. */
  private turned(): void {
    this.fits = false;
    this.moves();
    this.redraw();
  }

  /** Draws in the next frame. The view buttons are updated immediately. */
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
    for (const canvas of [this.under, this.canvas, this.over]) {
      [canvas.width, canvas.height] = [Math.max(1, Math.round(width * ratio)), Math.max(1, Math.round(height * ratio))];
    }
    [this.camera.width, this.camera.height] = [width, height];
    if (this.fits) this.fit();
    // the picture is drawn immediately, because a canvas is cleared when its size changes
    this.draw();
  }

  private draw(): void {
    const began = performance.now();
    const ratio = this.canvas.width / Math.max(1, this.camera.width);
    this.cutStock();
    const dash = Math.max(2, Math.min(14, ((this.program?.path?.size ?? 1) / 90) * this.camera.scale));
    this.painter.begin(this.camera, this.colours, ratio, { ramp: !!this.shades?.range, dash });
    this.drawUnder(ratio);
    this.frames.pieces = 0;
    const { width, height, scale } = this.camera;
    const most = this.moving ? this.painter.most.moving : this.painter.most.still;
    const sees = (box: Float32Array, at: number) => overlaps(box, at, this.camera, 0, 0, width, height);
    if (this.old.length) {
      const [level, runs] = drawable(this.old, scale, sees, most);
      for (const [from, to] of runs) {
        this.painter.stroke({ level, from, to, width: 3, alpha: 0.5, colour: this.colours.old, dashed: false });
      }
    }
    const path = this.program?.path;
    if (path && this.levels.length) {
      const [level, runs] = drawable(this.levels, scale, sees, most);
      const until = this.cursor ? upTo(level, this.cursor.point) : count(level);
      // while the stock changes, lines are not drawn, because they take too much time
      for (const [from, to] of this.stock && this.moving ? [] : runs) {
        this.frames.pieces += to - from;
        const now = Math.max(from, Math.min(to, until));
        const line = { level, dashed: true, width: 1.5 };
        this.painter.stroke({ ...line, from, to: now, alpha: this.stock ? 0.3 : 0.9 });
        this.painter.stroke({ ...line, from: now, to, alpha: this.stock ? 0.1 : 0.16 });
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

  /** Draws below the path: plate, grid and zero. */
  private drawUnder(ratio: number): void {
    // on a plain canvas, the ground is drawn on the same canvas, because each canvas costs time in every frame
    const context = this.painter.ground ?? cleared(this.under, this.camera, ratio);
    const path = this.program?.path;
    if (!path) return;
    if (this.stock) this.solid!.drawRelief(context, this.camera, this.colours, ratio, this.stock, this.moving > 0);
    drawGround(context, this.camera, this.colours, path, this.stock ? null : this.plate);
  }

  /** Draws above the path: holes, the tool, the directions of the axes, the scale, a measured distance. */
  private drawOver(ratio: number): void {
    const context = cleared(this.over, this.camera, ratio);
    const path = this.program?.path;
    if (path && this.program) {
      drawHoles(context, this.camera, this.colours, path, this.line);
      this.drawTip(context);
      drawBar(context, this.camera, this.colours, path.head.units);
      this.measure.draw(context, this.camera, this.colours);
    }
    drawAxes(context, this.camera, this.colours);
  }

  /** The path of the tool's centre, with a point for each point of the path. */
  private get centres(): Float32Array {
    return (this.known ??= centresOf(this.program!, this.shapes));
  }

  /** Draws the tool after the selected block, or at the position of the timeline. */
  private drawTip(context: CanvasRenderingContext2D): void {
    const program = this.program!;
    const path = program.path!;
    const point = program.pointAfter(this.line);
    if (!this.cursor && !(this.line > 0 && point > 0)) return;
    const end = this.cursor ? Math.min(this.cursor.point + 1, path.pieces) : point;
    const on = this.cursor?.at ?? ([...path.points.subarray(point * 3, point * 3 + 3)] as Vector);
    // the tool is beside the line while the control compensates the radius
    const isBeside = [41, 42].includes(program.held("compensation", this.line)?.value ?? 40);
    const at = isBeside ? (on.map((value, axis) => value + this.centres[end * 3 + axis] - path.points[end * 3 + axis]) as Vector) : on;
    const tool = path.moveTool[program.moveOf(end)] ?? 0;
    const [shape, up] = [this.shapes.get(tool), upOf(program, this.line)];
    if (shape && up) drawTool(context, this.camera, this.colours, ofTool(this.colours, tool), at, up, shape);
    drawTip(context, this.camera, this.colours, on);
  }

  /** The line of the move at a pixel of the pane; null if there is none. */
  lineAt(x: number, y: number): number | null {
    const piece = this.pieceAt(x, y);
    return piece < 0 ? null : this.program!.path!.moveLine[this.program!.moveOfPiece(piece)];
  }

  private pieceAt(x: number, y: number): number {
    return this.program?.path ? pick(fitting(this.levels, this.camera.scale), this.camera, x, y, REACH) : -1;
  }

  private takePoint(x: number, y: number): void {
    const path = this.program?.path;
    const piece = this.pieceAt(x, y);
    if (!path || piece < 0) return;
    this.measure.take(path, piece, this.camera, x, y);
    this.say(this.measure.words(path.head.units));
    this.redraw();
  }

  /** For tests: the pieces of the finest level, with their colours. */
  get kinds(): Uint8Array {
    return this.levels[this.levels.length - 1]?.kinds ?? new Uint8Array();
  }

  /** For tests: the pixel in the pane at which a line ends. */
  pixelOf(line: number): [number, number] | null {
    const path = this.program?.path;
    if (!path) return null;
    const [from, to] = this.program!.moves(line);
    if (to <= from) return null;
    const [a, b] = [path.first[from], path.first[to]].map((point) => this.camera.project(path.points, point * 3));
    return [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2];
  }
}

/** The old path, relative to the middle of the new path. */
function shifted(path: Path, program: Program | null): Path {
  const by = path.head.middle.map((value, axis) => value - (program?.path?.head.middle[axis] ?? value));
  return Object.assign(Object.create(Path.prototype) as Path, path, { points: path.points.map((value, at) => value + by[at % 3]) });
}

function short(value: number): string {
  return String(Math.round(value * 1000) / 1000 + 0);
}
