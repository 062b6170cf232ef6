// A program for display: its lines with their origins, its moves, and the modal state after each line.

import { formLine, Path, Scene } from "./scene.ts";

/** In the order of `Register` in src/picture/state.rs. */
export const REGISTERS = [
  "motion", "plane", "distance", "units", "work", "back", "compensation", "length", "feedMode", "tool", "h", "d", "speed",
  "spindle", "coolant", "feed", "cycle", "r", "depth", "dwell", "peck", "a", "b", "c", "u", "v",
] as const;
export type Register = (typeof REGISTERS)[number];

/** A value, and the line that set it; 0: at the start. */
export interface Held {
  value: number;
  line: number;
}

export interface Item {
  operation: number;
  subprogram: boolean;
  item: number;
  point: number;
  jobLine: number;
}

export class Program {
  readonly path: Path | null;
  /** Byte offset of each line, and of the end. */
  private readonly starts: Uint32Array;
  private readonly bytes: Uint8Array;
  private readonly lineForm: Int32Array;
  private readonly lineItem: Uint32Array;
  private readonly changes: { line: Uint32Array; value: Float64Array }[];
  /** The first move of each line, and the first move after the line; both are equal for a line without a move. For a line that
   * is run more than once, in a subprogram or a loop, this is the first run. */
  private readonly moveFrom: Uint32Array;
  private readonly moveTo: Uint32Array;
  /** Position of the tool after each line, as an index into the points. */
  private readonly stands: Uint32Array;
  private readonly decoder = new TextDecoder();

  /** `before`: the program that was shown until now. If it is the same program, its computed data is used again. */
  constructor(private readonly scene: Scene, of = "", before: Program | null = null) {
    this.lineForm = of ? new Int32Array() : scene.array("lineForm", Int32Array);
    this.lineItem = of ? new Uint32Array() : scene.array("lineItem", Uint32Array);
    if (before?.path && scene.hasProgramOf(before.scene, of)) {
      this.path = before.path;
      [this.bytes, this.starts, this.changes] = [before.bytes, before.starts, before.changes];
      [this.moveFrom, this.moveTo, this.stands] = [before.moveFrom, before.moveTo, before.stands];
      return;
    }
    this.bytes = scene.bytes(`${of}text`);
    this.starts = lineStarts(this.bytes);
    const head = of ? scene.head["old/picture"] : scene.head.picture;
    this.path = head ? new Path(scene, of, head) : null;
    this.changes = this.path ? changesOf(scene, of) : [];
    this.moveFrom = new Uint32Array(this.lines + 2);
    this.moveTo = new Uint32Array(this.lines + 2);
    this.stands = new Uint32Array(this.lines + 2);
    if (this.path) this.sortMoves(this.path);
  }

  private sortMoves({ moveLine, first }: Path): void {
    for (let move = 0; move < moveLine.length; move++) {
      const line = Math.min(moveLine[move], this.lines + 1);
      if (this.moveTo[line] === 0) this.moveFrom[line] = this.moveTo[line] = move;
      if (this.moveTo[line] === move) this.moveTo[line] = move + 1;
    }
    for (let line = 1; line < this.stands.length; line++) {
      this.stands[line] = this.moveTo[line] > this.moveFrom[line] ? first[this.moveTo[line]] : this.stands[line - 1];
    }
  }

  /** The number of lines; lines are counted from 1. */
  get lines(): number {
    return this.starts.length - 1;
  }

  text(line: number): string {
    if (line < 1 || line > this.lines) return "";
    const end = this.starts[line];
    return this.decoder.decode(this.bytes.subarray(this.starts[line - 1], end)).replace(/[\r\n]+$/, "");
  }

  /** The whole text. */
  all(): string {
    return this.decoder.decode(this.bytes);
  }

  /** Finds a text, in upper or lower case, after (1) or before (-1) the line `from`. At one end of the program, the search continues at the
   * other end. Returns the number of the line; 0: no line contains the text. */
  find(text: string, from: number, by: 1 | -1): number {
    // one character per byte, so that positions in the text are bytes
    this.upper ??= new TextDecoder("latin1").decode(this.bytes).toUpperCase();
    const wanted = new TextDecoder("latin1").decode(new TextEncoder().encode(text)).toUpperCase();
    if (!wanted) return 0;
    const line = Math.max(0, Math.min(from, this.lines));
    let at: number;
    if (by > 0) {
      at = this.upper.indexOf(wanted, this.starts[line] ?? 0);
      if (at < 0) at = this.upper.indexOf(wanted);
    } else {
      const end = this.starts[Math.max(0, line - 1)];
      at = end > 0 ? this.upper.lastIndexOf(wanted, end - 1) : -1;
      if (at < 0) at = this.upper.lastIndexOf(wanted);
    }
    return at < 0 ? 0 : this.lineOfByte(at);
  }

  private upper: string | null = null;

  private lineOfByte(byte: number): number {
    let [low, high] = [0, this.starts.length - 1];
    while (low + 1 < high) {
      const middle = (low + high) >> 1;
      if (this.starts[middle] <= byte) low = middle;
      else high = middle;
    }
    return low + 1;
  }

  /** Are the origins of the lines known? */
  get isTraced(): boolean {
    return this.lineForm.length > 0;
  }

  form(line: number): { file: number; line: number } | null {
    return line >= 1 && line <= this.lineForm.length ? formLine(this.lineForm[line - 1]) : null;
  }

  /** The lines that a form line printed. */
  printedBy(file: number, line: number): number[] {
    const packed = (file << 20) | line;
    const found: number[] = [];
    for (let at = 0; at < this.lineForm.length; at++) if (this.lineForm[at] === packed) found.push(at + 1);
    return found;
  }

  item(line: number): Item | null {
    const at = (line - 1) * 4;
    if (line < 1 || at + 3 >= this.lineItem.length || this.lineItem[at] === 0) return null;
    const [operation, item, point, jobLine] = this.lineItem.subarray(at, at + 4);
    return { operation: operation & 0x7fffffff, subprogram: operation >= 0x80000000, item, point, jobLine };
  }

  /** Are two lines from one item of the job? */
  sameItem(a: number, b: number): boolean {
    const [i, j] = [(a - 1) * 4, (b - 1) * 4];
    return this.lineItem[i] === this.lineItem[j] && this.lineItem[i + 1] === this.lineItem[j + 1];
  }

  /** The moves of a line: its first move, and the first move after the line. */
  moves(line: number): [number, number] {
    return line >= 1 && line <= this.lines ? [this.moveFrom[line], this.moveTo[line]] : [0, 0];
  }

  /** Position of the tool after a line, as an index into the points; 0 before the first move. */
  pointAfter(line: number): number {
    return this.stands[Math.max(0, Math.min(line, this.stands.length - 1))];
  }

  /** The value of a register after a line. */
  held(register: Register, line: number): Held | null {
    const changes = this.changes[REGISTERS.indexOf(register)];
    if (!changes) return null;
    let [low, high] = [0, changes.line.length];
    while (low < high) {
      const middle = (low + high) >> 1;
      if (changes.line[middle] <= line) low = middle + 1;
      else high = middle;
    }
    if (low === 0 || Number.isNaN(changes.value[low - 1])) return null;
    return { value: changes.value[low - 1], line: changes.line[low - 1] };
  }

  /** X Y Z after a line, or X Y of a wire, and the line that set each; null if unknown. */
  position(line: number): (Held | null)[] {
    const path = this.path;
    if (!path) return [null, null, null];
    // for rotary moves, the points are positions on the part
    const { ends } = path;
    const value = (move: number, axis: number) => ends.length ? ends[move * 3 + axis] : path.points[path.first[move + 1] * 3 + axis];
    const middle = ends.length ? [0, 0, 0] : path.head.middle;
    const point = this.pointAfter(line);
    const last = this.moveOf(point);
    return [...path.head.letters].map((_, axis) => {
      if (last < 0 || path.moveKind[last] & (32 << axis)) return null;
      const at = value(last, axis);
      let move = last;
      for (let looked = 0; move > 0 && looked < 10000; looked++, move--) {
        if (value(move - 1, axis) !== at || path.moveKind[move - 1] & (32 << axis)) break;
      }
      return { value: at + middle[axis], line: path.moveLine[move] };
    });
  }

  /** The move that ends at a point or passes through it; -1 for the first point. */
  moveOf(point: number): number {
    if (!this.path || point === 0) return -1;
    return this.moveOfPiece(point - 1);
  }

  moveOfPiece(piece: number): number {
    return this.path!.moveOfPiece(piece);
  }
}

/** `operations[2].path[3].cycle.points[1]`. */
export function itemPath(item: Item): string {
  let path = item.subprogram ? `subprograms[${item.operation - 1}]` : `operations[${item.operation - 1}]`;
  if (item.item > 0) path += `.path[${item.item - 1}]`;
  if (item.point > 0) path += `.cycle.points[${item.point - 1}]`;
  return path;
}

/** The offset of each line, and of the end. A loop over the bytes is faster than a call of `indexOf` for each line. */
function lineStarts(bytes: Uint8Array): Uint32Array {
  let ends = 0;
  for (let at = 0; at < bytes.length; at++) if (bytes[at] === 10) ends++;
  const open = bytes.length > 0 && bytes[bytes.length - 1] !== 10;
  const starts = new Uint32Array(1 + ends + (open ? 1 : 0));
  let line = 1;
  for (let at = 0; at < bytes.length; at++) if (bytes[at] === 10) starts[line++] = at + 1;
  if (open) starts[line] = bytes.length;
  return starts;
}

/** The changes of the modal state, separated by register. */
function changesOf(scene: Scene, of: string) {
  const line = scene.array(`${of}changeLine`, Uint32Array);
  const register = scene.array(`${of}changeRegister`, Uint8Array);
  const value = scene.array(`${of}changeValue`, Float64Array);
  const counts = new Uint32Array(REGISTERS.length);
  for (const of of register) counts[of]++;
  const all = REGISTERS.map((_, at) => ({ line: new Uint32Array(counts[at]), value: new Float64Array(counts[at]) }));
  counts.fill(0);
  for (let at = 0; at < register.length; at++) {
    const to = all[register[at]];
    const place = counts[register[at]]++;
    to.line[place] = line[at];
    to.value[place] = value[at];
  }
  return all.map(inOrder);
}

/** Sorts changes by line, because subprograms and loops go back in the program. If a line runs more than once, its last run is used. */
function inOrder(changes: { line: Uint32Array; value: Float64Array }) {
  const { line, value } = changes;
  if (line.every((at, i) => i === 0 || line[i - 1] <= at)) return changes;
  const order = [...line.keys()].sort((a, b) => line[a] - line[b] || a - b);
  return { line: Uint32Array.from(order, (i) => line[i]), value: Float64Array.from(order, (i) => value[i]) };
}
