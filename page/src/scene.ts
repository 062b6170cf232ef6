// What the page shows, as src/scene of the library packs it.

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

interface Said {
  line: number | null;
  code: string;
  message: string;
  help: string | null;
}

export interface PictureHead {
  units: "mm" | "inch";
  tools: number[];
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

export interface Hunks {
  name?: string;
  stopped?: boolean;
  blocks: number;
  /** First and last line of the old program, and of the new one, from 0. */
  hunks: [number, number, number, number][];
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
  };
  texts?: string[];
  jobs?: string[];
  stopped?: { by: "form" | "job" | "input"; message: string; findings: Finding[] };
  notes?: Finding[];
  verdict?: Verdict;
  picture?: PictureHead;
  "old/picture"?: PictureHead;
  against?: Hunks;
  saved?: Hunks;
  sections: Record<string, [number, number]>;
}

/** A program's path. */
export class Path {
  readonly points: Float32Array;
  readonly first: Uint32Array;
  readonly moveLine: Uint32Array;
  readonly moveKind: Uint8Array;
  readonly moveTool: Uint8Array;
  readonly holes: Float32Array;
  readonly holeLine: Uint32Array;
  readonly holeTool: Uint8Array;

  constructor(scene: Scene, of: string, readonly head: PictureHead) {
    this.points = scene.array(`${of}points`, Float32Array);
    this.first = scene.array(`${of}first`, Uint32Array);
    this.moveLine = scene.array(`${of}moveLine`, Uint32Array);
    this.moveKind = scene.array(`${of}moveKind`, Uint8Array);
    this.moveTool = scene.array(`${of}moveTool`, Uint8Array);
    this.holes = scene.array(`${of}holes`, Float32Array);
    this.holeLine = scene.array(`${of}holeLine`, Uint32Array);
    this.holeTool = scene.array(`${of}holeTool`, Uint8Array);
  }

  get moves(): number {
    return this.moveLine.length;
  }

  get pieces(): number {
    return this.points.length / 3 - 1;
  }

  /** The longest side of the box around everything that is known. */
  get size(): number {
    const [least, greatest] = this.head.extents;
    return Math.max(1e-6, ...least.map((value, axis) => greatest[axis] - value));
  }
}

type Numbers<T> = { new (buffer: ArrayBuffer, offset: number, length: number): T; BYTES_PER_ELEMENT: number };

const LINE_BITS = 20;

/** All of it. */
export class Scene {
  readonly head: Head;
  private readonly start: number;

  constructor(private readonly buffer: ArrayBuffer) {
    const view = new DataView(buffer);
    if (buffer.byteLength < 8 || view.getUint32(0) !== 0x50465331) throw new Error("this is no scene of postform");
    const length = view.getUint32(4, true);
    this.start = 8 + length;
    this.head = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, 8, length)));
  }

  has(name: string): boolean {
    return name in this.head.sections;
  }

  array<T>(name: string, of: Numbers<T>): T {
    const [offset, length] = this.head.sections[name] ?? [0, 0];
    return new of(this.buffer, this.start + offset, length / of.BYTES_PER_ELEMENT);
  }

  bytes(name: string): Uint8Array {
    return this.array(name, Uint8Array);
  }
}

/** The form line that printed a block: file and line from 0; null where none did. */
export function formLine(packed: number): { file: number; line: number } | null {
  return packed < 0 ? null : { file: packed >> LINE_BITS, line: packed & ((1 << LINE_BITS) - 1) };
}
