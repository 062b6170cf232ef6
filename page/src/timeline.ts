// The timeline: plays a program in the machine's time, with a mark at each tool change.

import type { Vector } from "./backplot/camera.ts";
import { element } from "./element.ts";
import type { Program } from "./program.ts";
import { type Path, toolText } from "./scene.ts";

/** Duration in seconds for playing a whole program. */
const WHOLE = 30;
/** Seconds of the program per second; 0: the whole program in WHOLE seconds. */
const SPEEDS: [name: string, times: number][] = [[`all in ${WHOLE} s`, 0], ["1 ×", 1], ["10 ×", 10], ["100 ×", 100]];
/** Maximum number of tool change marks; if there are more, none is shown. */
const MOST_MARKS = 200;
/** Number of steps of the slider. */
const STEPS = 10_000;

/** The tool's position at a time. */
export interface Cursor {
  /** The current move, and its line. */
  move: number;
  line: number;
  /** The last point of the path that the tool has reached. */
  point: number;
  at: Vector;
}

export class Timeline {
  readonly root: HTMLElement;
  private readonly button = element("button", { class: "play", title: "Play, stop (space)" }, "▶");
  private readonly speed = element("select", { "aria-label": "Speed" }, ...SPEEDS.map(([name], i) => element("option", { value: String(i) }, name)));
  private readonly slider = element("input", { type: "range", min: "0", max: String(STEPS), value: "0", "aria-label": "Time" });
  private readonly marks = element("div", { class: "marks", "aria-hidden": "true" });
  private readonly clock = element("span", { class: "clock" });
  private program: Program | null = null;
  /** The times of the shown moves. */
  private times: Float32Array | null = null;
  /** Seconds from the beginning. */
  private time = 0;
  private frame = 0;
  /** Called with the tool's position while the timeline plays or the slider moves. */
  onTime: (cursor: Cursor) => void = () => {};
  /** Called when the whole path is shown again. */
  onEnd: () => void = () => {};

  constructor() {
    this.root = element("div", { class: "timeline", role: "group", "aria-label": "Timeline" }, this.button, this.speed, element("div", { class: "track" }, this.slider, this.marks), this.clock);
    this.button.onclick = () => this.toggle();
    this.slider.oninput = () => {
      this.pause();
      this.go((Number(this.slider.value) / STEPS) * this.total);
    };
  }

  private get path(): Path | null {
    return this.program?.path ?? null;
  }

  /** Seconds of the whole program. */
  get total(): number {
    const times = this.path?.moveTime;
    return times?.length ? times[times.length - 1] : 0;
  }

  get isPlaying(): boolean {
    return this.frame !== 0;
  }

  show(program: Program | null): void {
    const times = program?.path?.moveTime ?? null;
    if (program?.path === this.path && times === this.times) {
      this.program = program;
      return;
    }
    this.pause();
    // if only the times of the moves changed, the tool stays at its move
    const whole = this.times?.at(-1) ?? 0;
    const share = program?.path === this.path && whole > 0 ? this.time / whole : 0;
    this.program = program;
    this.times = times;
    this.time = share * this.total;
    this.clock.title = program?.path?.isTimed ? "times of the machine file" : "an estimate: without accelerations, with an assumed rapid rate";
    this.root.hidden = this.total <= 0;
    this.marks.replaceChildren(...this.changes().map(([tool, time]) => {
      const mark = element("i", { title: `${tool} at ${clock(time)}` });
      mark.style.left = `${(time / this.total) * 100}%`;
      return mark;
    }));
    this.tell();
  }

  /** The tools, and the times of their tool changes. */
  private changes(): [string, number][] {
    const path = this.path;
    if (!path) return [];
    const found: [string, number][] = [];
    for (let move = 1; move < path.moves && found.length <= MOST_MARKS; move++) {
      if (path.moveTool[move] !== path.moveTool[move - 1]) found.push([toolText(path.head, path.head.tools[path.moveTool[move]]), path.moveTime[move - 1]]);
    }
    return found.length > MOST_MARKS ? [] : found;
  }

  toggle(): void {
    if (this.isPlaying) return this.pause();
    if (!this.total) return;
    if (this.time >= this.total) this.time = 0;
    let before = performance.now();
    const step = (now: number) => {
      const times = SPEEDS[Number(this.speed.value)][1] || this.total / WHOLE;
      this.go(this.time + ((now - before) / 1000) * times);
      before = now;
      if (this.time >= this.total) return this.end();
      this.frame = requestAnimationFrame(step);
    };
    this.button.textContent = "❚❚";
    this.frame = requestAnimationFrame(step);
  }

  pause(): void {
    cancelAnimationFrame(this.frame);
    this.frame = 0;
    this.button.textContent = "▶";
  }

  /** Stops playing, and shows the whole path again. */
  end(): void {
    this.pause();
    this.onEnd();
  }

  /** Called when a block was selected, so that playing starts at the end of this block. */
  chose(line: number): void {
    this.pause();
    const move = this.path?.moves ? this.program!.moveOf(this.program!.pointAfter(line)) : -1;
    this.time = move < 0 ? 0 : this.path!.moveTime[move];
    this.tell();
  }

  private go(time: number): void {
    this.time = Math.max(0, Math.min(this.total, time));
    this.tell();
    const cursor = this.cursor();
    if (cursor) this.onTime(cursor);
  }

  private tell(): void {
    this.slider.value = String(this.total ? Math.round((this.time / this.total) * STEPS) : 0);
    this.clock.textContent = `${clock(this.time)} / ${clock(this.total)}`;
    this.slider.setAttribute("aria-valuetext", this.clock.textContent);
  }

  /** The current position of the tool. */
  private cursor(): Cursor | null {
    const path = this.path;
    if (!path?.moves) return null;
    const { moveTime, moveLine, first, points } = path;
    let [low, high] = [0, moveTime.length - 1];
    while (low < high) {
      const middle = (low + high) >> 1;
      if (moveTime[middle] < this.time) low = middle + 1;
      else high = middle;
    }
    const begin = low > 0 ? moveTime[low - 1] : 0;
    const share = moveTime[low] > begin ? Math.max(0, Math.min(1, (this.time - begin) / (moveTime[low] - begin))) : 1;
    const [from, to] = [first[low], first[low + 1]];
    const length = (piece: number) => Math.hypot(...[0, 1, 2].map((axis) => points[piece * 3 + 3 + axis] - points[piece * 3 + axis]));
    let rest = 0;
    for (let piece = from; piece < to; piece++) rest += length(piece);
    rest *= share;
    let piece = from;
    while (piece + 1 < to && length(piece) < rest) rest -= length(piece++);
    const part = length(piece) > 0 ? Math.min(1, rest / length(piece)) : 1;
    const at = [0, 1, 2].map((axis) => points[piece * 3 + axis] + part * (points[piece * 3 + 3 + axis] - points[piece * 3 + axis])) as Vector;
    return { move: low, line: moveLine[low], point: share >= 1 ? to : piece, at };
  }
}

/** `1:02:03` or `2:03`. */
function clock(seconds: number): string {
  const all = Math.floor(seconds + 0.5);
  const two = (value: number) => String(value).padStart(2, "0");
  const [hours, minutes] = [Math.floor(all / 3600), Math.floor(all / 60) % 60];
  return hours ? `${hours}:${two(minutes)}:${two(all % 60)}` : `${minutes}:${two(all % 60)}`;
}
