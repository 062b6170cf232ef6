// The playground: the same page, and postform inside it as WebAssembly. Files come by drag and drop and go nowhere.

import { Editor } from "./editor.ts";
import { element } from "./element.ts";
import type { Ask, Host } from "./host.ts";
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

  constructor(private readonly module: WebAssembly.Module) {}

  async scene(ask: Ask): Promise<ArrayBuffer> {
    const texts = [this.form, ...this.others].map((file) => {
      const typed = ask.texts[file.name];
      return { name: file.name, bytes: typed === undefined ? file.bytes : new TextEncoder().encode(typed), saved: file.bytes };
    });
    const job = this.jobs[ask.job];
    const head = {
      forms: texts.map((file) => ({ name: file.name, length: file.bytes.length, saved: file.saved.length })),
      job: { name: job.name, length: job.bytes.length },
      against: this.against && { name: this.against.name, length: this.against.bytes.length },
      jobs: this.jobs.map((job) => job.name),
      proves: ask.proves,
    };
    const parts = [...texts.flatMap((file) => [file.bytes, file.saved]), job.bytes, ...(this.against ? [this.against.bytes] : [])];
    const out = await run(this.module, pack(JSON.stringify(head), parts));
    return out.buffer as ArrayBuffer;
  }

  async verdict(job: number): Promise<Verdict> {
    const { head } = new Scene(await this.scene({ job, texts: {}, proves: true }));
    return head.verdict ?? { kind: "none", text: head.stopped?.message ?? "", line: 0, help: "", allowed: [], findings: [] };
  }

  /** A dropped file, by what it is called: whether it changes what is shown. */
  take(file: File_): void {
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
    // the page begins anew with the files that it has now
    document.body.replaceChildren(drop);
    page = new Page(host, new Editor(true));
    Object.assign(window, { page });
    await page.load();
  });
}

start().catch((error) => document.body.append(`The playground can't be loaded: ${error}. It needs a file server: python3 -m http.server`));
