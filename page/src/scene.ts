// The data of the page, as packed by src/scene of the library.

import type { KitPost } from "./kit.ts";
import type { Property } from "./properties.ts";

/** File, first and last line and column, all from 0. */
export type Place = [file: number, line: number, column: number, endLine: number, endColumn: number];

export interface Finding {
  code: string;
  severity: "error" | "warning" | "note";
  message: string;
  help: string | null;
  labels: { at: Place; text: string }[];
  place: string | null;
  fix: { title: string; safe: boolean; edits: { at: Place; text: string }[] } | null;
}

export interface Difference {
  code: string;
  message: string;
  help: string;
  line: number;
  times: number;
  item: string | null;
  form: Place | null;
}

export interface Verdict {
  kind: "proven" | "unproven" | "different" | "none";
  text: string;
  line: number;
  help: string;
  allowed: string[];
  findings: Difference[];
}

/** Whether the program fits its machine. */
export interface Fit {
  kind: "ok" | "warn" | "bad";
  text: string;
  /** The time, the allowed ranges of unknown offsets and lengths, and everything that is not checked. */
  more: string[];
  findings: (Difference & { severity: "error" | "warning" })[];
}

interface Said {
  line: number | null;
  code: string;
  message: string;
  help: string | null;
}

export interface PictureHead {
  units: "mm" | "inch";
  /** Letters of the axes of a position: XYZ, or XY for a wire. */
  letters: string;
  tools: number[];
  /** Names of tools whose numbers are unknown. The tool 1e9 + n has the name with the index n. */
  toolNames?: string[];
  middle: number[];
  extents: [number[], number[]];
  ceiling: number;
  blocks: number;
  minutes: number;
  time: string;
  view: string;
  warnings: Said[];
  refused: Said | null;
}

/** A tool as text: its number, or its name if the number is unknown. */
export function toolText({ toolNames }: PictureHead, tool: number): string {
  return toolNames?.[tool - 1e9] ?? `T${tool}`;
}

export interface Hunks {
  name?: string;
  stopped?: boolean;
  blocks: number;
  /** For each hunk: first and last line in the old program, then in the new one, from 0. */
  hunks: [number, number, number, number][];
}

export interface ToolSize {
  number: number;
  diameter: number | null;
  corner: number | null;
}

export interface Head {
  job: { name: string };
  form?: {
    files: string[];
    findings: Finding[];
    errors: number;
    warnings: number;
    notes: number;
    suppressed: number;
    /** The form lines of the letter formats, by letter. */
    formats: Record<string, Place>;
    properties: Property[];
    /** The posts that are offered for a form without text. */
    kit: KitPost[] | null;
  };
  texts?: string[];
  jobs?: string[];
  stopped?: { by: "form" | "job" | "input"; message: string; findings: Finding[] };
  notes?: Finding[];
  /** The identifier of the program. */
  program?: string;
  /** Whether the page already shows this program. */
  same?: boolean;
  /** Tools of the job, with diameters in millimetres. */
  toolSizes?: ToolSize[];
  verdict?: Verdict;
  fit?: Fit;
  picture?: PictureHead;
  "old/picture"?: PictureHead;
  against?: Hunks;
  saved?: Hunks;
  sections: Record<string, [number, number]>;
  /** The hashes of all sections, and the names of those that were not sent because the page has them. */
  hashes?: Record<string, string>;
  kept?: string[];
}

/** A program's path. */
export class Path {
  readonly points: Float32Array;
  readonly first: Uint32Array;
  readonly moveLine: Uint32Array;
  readonly moveKind: Uint8Array;
  readonly moveTool: Uint8Array | Uint16Array;
  /** Seconds from the beginning of the program to the end of each move, with an assumed rapid rate and no accelerations. */
  readonly ownTime: Float32Array;
  /** The times that are shown: those of the machine file, if there is one. */
  moveTime: Float32Array;
  /** Whether the times come from the machine file. Such times include accelerations, tool changes and the machine's rapid rates. */
  isTimed = false;
  /** For a program with rotary moves: X Y Z at the end of each move. Empty: the points are the positions. */
  readonly ends: Float64Array;
  readonly holes: Float32Array;
  readonly holeLine: Uint32Array;
  readonly holeTool: Uint8Array | Uint16Array;

  constructor(scene: Scene, of: string, readonly head: PictureHead) {
    this.points = scene.array(`${of}points`, Float32Array);
    this.first = scene.array(`${of}first`, Uint32Array);
    this.moveLine = scene.array(`${of}moveLine`, Uint32Array);
    this.moveKind = scene.array(`${of}moveKind`, Uint8Array);
    const ofTools: Numbers<Uint8Array | Uint16Array> = head.tools.length <= 256 ? Uint8Array : Uint16Array;
    this.moveTool = scene.array(`${of}moveTool`, ofTools);
    this.moveTime = this.ownTime = scene.array(`${of}moveTime`, Float32Array);
    this.ends = scene.array(`${of}ends`, Float64Array);
    this.holes = scene.array(`${of}holes`, Float32Array);
    this.holeLine = scene.array(`${of}holeLine`, Uint32Array);
    this.holeTool = scene.array(`${of}holeTool`, ofTools);
  }

  get moves(): number {
    return this.moveLine.length;
  }

  /** Do both paths have the same pieces, with the same kinds and tools? */
  drawsLike(other: Path): boolean {
    return (
      alike(this.first, other.first) &&
      alike(this.moveKind, other.moveKind) &&
      alike(this.moveTool, other.moveTool) &&
      alike(this.points, other.points)
    );
  }

  /** Do both paths give the same picture at the same position? */
  looksLike(other: Path): boolean {
    if (this === other) return true;
    const of = ({ units, letters, tools, middle, extents, view }: PictureHead) => JSON.stringify([units, letters, tools, middle, extents, view]);
    return of(this.head) === of(other.head) && this.drawsLike(other) && alike(this.holes, other.holes) && alike(this.holeTool, other.holeTool);
  }

  get pieces(): number {
    return this.points.length / 3 - 1;
  }

  /** The move of a piece. */
  moveOfPiece(piece: number): number {
    const { first } = this;
    let [low, high] = [0, first.length - 1];
    while (low + 1 < high) {
      const middle = (low + high) >> 1;
      if (first[middle] <= piece) low = middle;
      else high = middle;
    }
    return low;
  }

  /** The longest side of the box around all known positions. */
  get size(): number {
    const [least, greatest] = this.head.extents;
    return Math.max(1e-6, ...least.map((value, axis) => greatest[axis] - value));
  }
}

type Numbers<T> = { new (buffer: ArrayBuffer, offset: number, length: number): T; BYTES_PER_ELEMENT: number };

const LINE_BITS = 20;

/** Number of bytes before the head of a scene. */
const PREFIX = 16;

/** The length in bytes of a scene that begins with these bytes; null: more bytes are needed to decide. */
export function lengthOf(bytes: Uint8Array): number | null {
  if (bytes.length < PREFIX) return null;
  const view = new DataView(bytes.buffer, bytes.byteOffset);
  if (view.getUint32(0) !== 0x50465332) throw new Error("this is no scene of postform");
  return PREFIX + view.getUint32(4, true) + Number(view.getBigUint64(8, true));
}

/** A complete scene. */
export class Scene {
  readonly head: Head;
  /** The sections. Sections of an earlier scene have their own buffers, so that the rest of the earlier scene can be freed. */
  private readonly found = new Map<string, Uint8Array>();

  /** `before`: the scene whose sections were not sent again. */
  constructor(buffer: ArrayBuffer, before: Scene | null = null) {
    if (lengthOf(new Uint8Array(buffer)) !== buffer.byteLength) throw new Error("the scene is cut off");
    const length = new DataView(buffer).getUint32(4, true);
    this.head = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, PREFIX, length)));
    const start = PREFIX + length;
    for (const [name, [offset, length]] of Object.entries(this.head.sections)) this.found.set(name, new Uint8Array(buffer, start + offset, length));
    for (const name of this.head.kept ?? []) {
      const bytes = before?.found.get(name);
      if (!bytes) throw new Error(`the scene lacks ${name}`);
      this.found.set(name, bytes.byteLength < bytes.buffer.byteLength ? bytes.slice() : bytes);
    }
  }

  has(name: string): boolean {
    return this.found.has(name);
  }

  array<T>(name: string, of: Numbers<T>): T {
    const { buffer, byteOffset, byteLength } = this.found.get(name) ?? new Uint8Array();
    return new of(buffer as ArrayBuffer, byteOffset, byteLength / of.BYTES_PER_ELEMENT);
  }

  bytes(name: string): Uint8Array {
    return this.array(name, Uint8Array);
  }

  /** Do two scenes have the same program with the same motions? The origins of the lines are not compared. Equal sections then share their bytes. */
  hasProgramOf(other: Scene, of: string): boolean {
    return PROGRAM.every((name) => {
      const [own, known] = [this, other].map((scene) => scene.found.get(of + name));
      if (!own || !known) return own === known;
      if (!equal(own, known)) return false;
      this.found.set(of + name, known);
      return true;
    });
  }
}

const PROGRAM = [
  "text", "points", "first", "moveLine", "moveKind", "moveTool", "moveTime", "ends", "holes", "holeLine", "holeTool", "changeLine", "changeRegister", "changeValue",
];

function equal(a: Uint8Array, b: Uint8Array): boolean {
  if (a.length !== b.length) return false;
  if (a.buffer === b.buffer && a.byteOffset === b.byteOffset) return true;
  // sections begin at multiples of eight bytes of their buffers
  const words = a.length >> 2;
  const [p, q] = [a, b].map((bytes) => new Uint32Array(bytes.buffer, bytes.byteOffset, words));
  for (let at = 0; at < words; at++) if (p[at] !== q[at]) return false;
  for (let at = words << 2; at < a.length; at++) if (a[at] !== b[at]) return false;
  return true;
}

/** The form line that printed a block: file and line from 0; null if there is none. */
export function formLine(packed: number): { file: number; line: number } | null {
  return packed < 0 ? null : { file: packed >> LINE_BITS, line: packed & ((1 << LINE_BITS) - 1) };
}

function alike(a: Uint8Array | Uint16Array | Uint32Array | Float32Array, b: typeof a): boolean {
  if (a.length !== b.length) return false;
  if (a.buffer === b.buffer && a.byteOffset === b.byteOffset) return true;
  // an unknown position is NaN
  for (let i = 0; i < a.length; i++) if (a[i] !== b[i] && (a[i] === a[i] || b[i] === b[i])) return false;
  return true;
}
