// The playground: the same page, and postform inside it as WebAssembly. Files come by drag and drop and go nowhere.

import { Editor } from "./editor.ts";
import { element } from "./element.ts";
import type { Ask, At, Help, Host } from "./host.ts";
import { Page } from "./main.ts";
import { type Verdict, Scene } from "./scene.ts";
import { run } from "./wasi.ts";

interface File_ {
  name: string;
  bytes: Uint8Array;
}

/** postform as WebAssembly: a request goes in, a scene comes out. */
class Wasm implements Host {
  form: File_ = { name: "", bytes: new Uint8Array() };
  readonly others: File_[] = [];
  readonly jobs: File_[] = [];
  against: File_ | null = null;

  /** What the saved forms print for a job. */
  private before: { job: number; text: Uint8Array } | null = null;

  constructor(private readonly module: WebAssembly.Module) {}

  private async run(request: Uint8Array): Promise<ArrayBuffer> {
    return (await run(this.module, request)).buffer as ArrayBuffer;
  }

  async *scenes(ask: Ask): AsyncGenerator<ArrayBuffer> {
    if (!Object.keys(ask.texts).length) {
      const bytes = await this.scene(ask.job, {}, null);
      this.before = { job: ask.job, text: new Scene(bytes).bytes("text") };
      return yield bytes;
    }
    // what the saved form prints is known from before it was typed in
    if (this.before?.job !== ask.job) this.before = { job: ask.job, text: new Scene(await this.scene(ask.job, {}, null)).bytes("text") };
    yield await this.scene(ask.job, ask.texts, this.before.text);
  }

  private scene(job: number, typed: Record<string, string>, before: Uint8Array | null, at: At | null = null): Promise<ArrayBuffer> {
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
    };
    const parts = [...texts.flatMap((file) => [file.bytes, file.saved]), bytes];
    for (const part of [this.against?.bytes, before]) if (part) parts.push(part);
    return this.run(pack(JSON.stringify(head), parts));
  }

  async help(ask: Ask, at: At): Promise<Help | null> {
    return JSON.parse(new TextDecoder().decode(await this.scene(ask.job, ask.texts, null, at)));
  }

  async verdict(job: number): Promise<Verdict> {
    const { head } = new Scene(await this.scene(job, {}, null));
    return head.verdict ?? { kind: "none", text: head.stopped?.message ?? "", line: 0, help: "", allowed: [], findings: [] };
  }

  /** A dropped file, by what it is called: whether it changes what is shown. */
  take(file: File_): void {
    this.before = null;
    const end = file.name.toLowerCase().split(".").pop() ?? "";
    if (end === "pf") {
      if (this.form.name && this.form.name !== file.name) this.others.push(this.form);
      this.form = file;
    } else if (/^(nc|ngc|tap|eia|min|mpf)$/.test(end) && this.jobs.length) {
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

async function start(): Promise<void> {
  const load = async (name: string) => {
    const answer = await fetch(name);
    if (!answer.ok) throw new Error(`${name}: ${answer.status}`);
    return new Uint8Array(await answer.arrayBuffer());
  };
  const [wasm, form, job] = await Promise.all(["postform.wasm", "fanuc.pf", "bracket.json"].map(load));
  const host = new Wasm(await WebAssembly.compile(wasm as BufferSource));
  host.form = { name: "fanuc.pf", bytes: form };
  host.jobs.push({ name: "bracket.json", bytes: job });
  let page = new Page(host, new Editor(true));
  Object.assign(window, { page, host });
  await page.load();
  const drop = element("div", { class: "drop", hidden: "" }, "drop forms (.pf), jobs (.json, .jsonl, .cl, .apt), or a program to compare with (.nc)");
  document.body.append(drop);
  addEventListener("dragover", (event) => {
    event.preventDefault();
    drop.hidden = false;
  });
  addEventListener("dragleave", (event) => (drop.hidden = !!event.relatedTarget || true));
  addEventListener("drop", async (event) => {
    event.preventDefault();
    drop.hidden = true;
    for (const file of event.dataTransfer?.files ?? []) {
      host.take({ name: file.name, bytes: new Uint8Array(await file.arrayBuffer()) });
    }
    // the page begins again with the files that it has now
    document.body.replaceChildren(drop);
    page = new Page(host, new Editor(true));
    Object.assign(window, { page });
    await page.load();
  });
}

start().catch((error) => document.body.append(`The playground can't be loaded: ${error}. It needs a file server: python3 -m http.server`));
