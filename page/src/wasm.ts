// postform as WebAssembly, with the open files.

import type { Added, Ask, At, Help, Host } from "./host.ts";
import { isProgram } from "./opening.ts";
import { type Verdict, Scene } from "./scene.ts";

export interface File_ {
  name: string;
  bytes: Uint8Array;
}

/** A host that sends each request to a separate thread. */
export class Wasm implements Host {
  form: File_ = { name: "", bytes: new Uint8Array() };
  others: File_[] = [];
  readonly jobs: File_[] = [];
  against: File_ | null = null;
  readonly keeps = true;

  private readonly worker = new Worker("worker.js");
  private readonly waiting = new Map<number, { done: (bytes: ArrayBuffer) => void; failed: (error: Error) => void }>();
  private asked = 0;
  /** The program of the saved forms for a job. */
  private before: { job: number; set: string; text: Uint8Array } | null = null;

  constructor(module: WebAssembly.Module, private readonly saved: (name: string, bytes: Uint8Array) => void) {
    this.worker.postMessage({ id: 0, module });
    this.worker.onmessage = ({ data }: MessageEvent<{ id: number; answer?: Uint8Array; error?: string }>) => {
      const waiting = this.waiting.get(data.id);
      this.waiting.delete(data.id);
      if (data.answer) waiting?.done(data.answer.buffer as ArrayBuffer);
      else waiting?.failed(new Error(data.error));
    };
    this.worker.onerror = (event) => {
      for (const { failed } of this.waiting.values()) failed(new Error(event.message || "worker.js can't be loaded"));
      this.waiting.clear();
    };
  }

  private run(request: Uint8Array): Promise<ArrayBuffer> {
    return new Promise((done, failed) => {
      this.waiting.set(++this.asked, { done, failed });
      this.worker.postMessage({ id: this.asked, request }, [request.buffer as ArrayBuffer]);
    });
  }

  async *scenes(ask: Ask): AsyncGenerator<ArrayBuffer> {
    const set = JSON.stringify(ask.properties ?? []);
    if (!Object.keys(ask.texts).length) {
      const bytes = await this.scene(ask.job, {}, null, null, ask.properties);
      this.before = { job: ask.job, set, text: new Scene(bytes).bytes("text") };
      return yield bytes;
    }
    // the program of the saved form is needed for comparison
    if (this.before?.job !== ask.job || this.before.set !== set) {
      this.before = { job: ask.job, set, text: new Scene(await this.scene(ask.job, {}, null, null, ask.properties)).bytes("text") };
    }
    yield await this.scene(ask.job, ask.texts, this.before.text, null, ask.properties);
  }

  private scene(job: number, typed: Record<string, string>, before: Uint8Array | null, at: At | null = null, properties: [string, string][] = []): Promise<ArrayBuffer> {
    const texts = [this.form, ...this.others].map((file) => {
      const text = typed[file.name];
      return { name: file.name, bytes: text === undefined ? file.bytes : new TextEncoder().encode(text), saved: file.bytes };
    });
    const { name, bytes } = this.jobs[job];
    const head = {
      forms: texts.map((file) => ({ name: file.name, length: file.bytes.length, saved: file.saved.length })),
      job: { name, length: bytes.length },
      against: this.against && { name: this.against.name, length: this.against.bytes.length },
      before: before && { name: "", length: before.length },
      jobs: this.jobs.map((job) => job.name),
      at,
      properties,
    };
    const parts = [...texts.flatMap((file) => [file.bytes, file.saved]), bytes];
    for (const part of [this.against?.bytes, before]) if (part) parts.push(part);
    return this.run(pack(JSON.stringify(head), parts));
  }

  async help(ask: Ask, at: At): Promise<Help | null> {
    return JSON.parse(new TextDecoder().decode(await this.scene(ask.job, ask.texts, null, at)));
  }

  async verdict(job: number, properties: [string, string][]): Promise<Verdict> {
    const { head } = new Scene(await this.scene(job, {}, null, null, properties));
    return head.verdict ?? { kind: "none", text: head.stopped?.message ?? "", line: 0, help: "", allowed: [], findings: [] };
  }

  /** Saves a form as a download. */
  async save(name: string, text: string): Promise<string | null> {
    const file = [this.form, ...this.others].find((file) => file.name === name);
    if (!file) return "there is no such file";
    file.bytes = new TextEncoder().encode(text);
    this.before = null;
    this.saved(name, file.bytes);
    return null;
  }

  async add(name: string, bytes: Uint8Array): Promise<Added> {
    const at = this.jobs.findIndex((job) => job.name === name);
    const tab = at < 0 ? this.jobs.length : at;
    this.jobs[tab] = { name, bytes };
    this.before = null;
    return { tab, replaced: at >= 0 };
  }

  async close(job: number, name: string): Promise<void> {
    if (this.jobs[job]?.name !== name) return;
    this.jobs.splice(job, 1);
    this.before = null;
  }

  /** Removes all files. */
  clear(): void {
    this.form = { name: "", bytes: new Uint8Array() };
    this.others = [];
    this.jobs.length = 0;
    this.against = this.before = null;
  }

  /** Adds a file by its name: a form, an old program, or a job. */
  take(file: File_): void {
    this.before = null;
    if (/\.pf$/i.test(file.name)) {
      this.others = [...this.others, this.form].filter((other) => other.name && other.name !== file.name);
      this.form = file;
    } else if (isProgram(file.name) && this.jobs.length) {
      this.against = file;
    } else {
      this.jobs.splice(0, this.jobs.length, ...this.jobs.filter((job) => job.name !== file.name), file);
    }
  }
}

function pack(head: string, parts: Uint8Array[]): Uint8Array {
  const first = new TextEncoder().encode(head);
  const all = new Uint8Array(4 + first.length + parts.reduce((sum, part) => sum + part.length, 0));
  new DataView(all.buffer).setUint32(0, first.length, true);
  let at = 4;
  for (const part of [first, ...parts]) {
    all.set(part, at);
    at += part.length;
  }
  return all;
}
