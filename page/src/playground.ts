// The playground: the same page with postform as WebAssembly. Files stay in the browser.

import { get, set } from "idb-keyval";
import { download } from "./download.ts";
import { FormSide } from "./form.ts";
import { element } from "./element.ts";
import { JobTabs } from "./jobs.ts";
import { Page } from "./main.ts";
import { JOBS, openButton, takeDrops } from "./opening.ts";
import { filesOfLink, linkOf } from "./share.ts";
import { type File_, Wasm } from "./wasm.ts";

/** The form and the job of each example, by its name. */
const EXAMPLES: Record<string, [form: string, job: string]> = {
  "mill: Fanuc": ["fanuc.pf", "bracket.json"],
  "mill: Heidenhain": ["heidenhain.pf", "bracket.json"],
  "lathe: Fanuc": ["fanuc-lathe.pf", "lathe-part.json"],
  "four axes: Haas": ["haas-4axis.pf", "four-axis.json"],
  "wire EDM": ["wire-edm.pf", "wire.json"],
  "FreeCAD document": ["linuxcnc.pf", "bracket.FCStd"],
};
/** The key under which the browser stores opened and typed texts. */
const KEPT = "postform";
const DOCS = "https://docs.rs/postform";
/** Milliseconds after a keystroke before typed text is stored. */
const PAUSE = 300;
/** Maximum length of a link; some programs cut longer links off. */
const LONG = 32_000;

interface Kept {
  forms: File_[];
  jobs: File_[];
  against: File_ | null;
  typed: Record<string, string>;
}

async function load(name: string): Promise<Uint8Array> {
  const answer = await fetch(name);
  if (!answer.ok) throw new Error(`${name}: ${answer.status}`);
  return new Uint8Array(await answer.arrayBuffer());
}

class Playground {
  private readonly page: Page;
  private readonly said = element("span", { role: "status" });
  private waits = 0;

  constructor(private readonly host: Wasm) {
    this.page = new Page(host, new FormSide());
    new JobTabs(this.page, host);
    this.page.onTyped = () => this.keepSoon();
    document.body.prepend(this.front());
    takeDrops("drop forms (.pf), jobs (.json, .jsonl, .cl, .apt, .FCStd), or a program to compare with (.nc)", (files) => void this.open(files));
  }

  async begin(): Promise<void> {
    let typed: Record<string, string> = {};
    const shared = await filesOfLink(location.hash).catch((error) => this.say(`The link can't be read: ${error.message}`));
    const kept = shared ? undefined : await get<Kept>(KEPT).catch(() => undefined);
    if (shared) {
      for (const { name, text } of shared.files) this.host.take({ name, bytes: new TextEncoder().encode(text) });
      history.replaceState(null, "", location.pathname + location.search);
    }
    if (kept?.forms.length && kept.jobs.length) {
      [this.host.form, ...this.host.others] = kept.forms;
      this.host.jobs.push(...kept.jobs);
      [this.host.against, typed] = [kept.against, kept.typed];
    }
    if (!this.host.form.name || !this.host.jobs.length) await this.example(Object.keys(EXAMPLES)[0]);
    await this.page.reopen(typed);
    Object.assign(window, { page: this.page, host: this.host });
  }

  /** Replaces all files by those of an example. */
  private async example(name: string): Promise<void> {
    const files = await Promise.all(EXAMPLES[name].map(async (name) => ({ name, bytes: await load(name) })));
    this.host.clear();
    files.forEach((file) => this.host.take(file));
  }

  /** The introduction of the page: a description of the page, and the possible actions of the user. */
  private front(): HTMLElement {
    const examples = element("select", { "aria-label": "Example" }, element("option", { value: "" }, "examples…"), ...Object.keys(EXAMPLES).map((name) => element("option", {}, name)));
    examples.onchange = async () => {
      const name = examples.value;
      examples.value = "";
      if (!name || !this.page.mayLeave()) return;
      await this.example(name);
      await this.restart();
    };
    const button = (text: string, title: string, act: () => void) => {
      const made = element("button", { title }, text);
      made.onclick = act;
      return made;
    };
    return element("div", { class: "front" },
      element("p", {}, element("b", {}, "postform"), " compiles POSTFORM files: templates from which post processors print the programs of CNC machines. Type in the form: after each key the program is printed and proven against its job. Nothing leaves this browser."),
      element("div", { class: "acts" }, examples,
        openButton("open files", "Forms (.pf), jobs (.json, .cl, .FCStd ..), or a program to compare with (.nc)", `.pf,${JOBS}`, (files) => void this.open(files)),
        button("download form", "Save the form as it is shown", () => this.page.downloadForm()),
        button("share link", "Copy a link with the form and the job in it; no server gets them", () => void this.share()),
        element("a", { href: DOCS, target: "_blank", rel: "noreferrer" }, "docs"), this.said));
  }

  private say(text: string): null {
    this.said.textContent = text;
    return null;
  }

  private async share(): Promise<void> {
    const decoder = new TextDecoder();
    const job = this.host.jobs[this.page.shownJob];
    if (job.bytes.includes(0)) return void this.say("the job is no text: it can't be put into a link");
    const forms = [this.host.form, ...this.host.others].map((file) => ({ name: file.name, text: this.page.texts[file.name] ?? decoder.decode(file.bytes) }));
    // the form is last, because the last opened form is shown
    const link = await linkOf({ files: [...forms.slice(1), forms[0], { name: job.name, text: decoder.decode(job.bytes) }] });
    await navigator.clipboard.writeText(link).catch(() => prompt("The link:", link));
    this.say(link.length > LONG ? `copied; the link has ${Math.round(link.length / 1000)} KB, and some programs cut it off` : "the link is copied");
  }

  private async open(files: Iterable<File>): Promise<void> {
    for (const file of files) {
      delete this.page.texts[file.name];
      this.host.take({ name: file.name, bytes: new Uint8Array(await file.arrayBuffer()) });
    }
    await this.restart();
  }

  private async restart(): Promise<void> {
    await this.page.reopen(this.page.texts);
    this.keepSoon();
  }

  private keepSoon(): void {
    clearTimeout(this.waits);
    this.waits = window.setTimeout(() => {
      const { form, others, jobs, against } = this.host;
      const kept: Kept = { forms: [form, ...others], jobs, against, typed: { ...this.page.texts } };
      set(KEPT, kept).catch(() => this.say("the browser keeps nothing here: download the form before you close the page"));
    }, PAUSE);
  }
}

async function start(): Promise<void> {
  if (typeof WebAssembly === "undefined") throw new Error("this browser has no WebAssembly");
  const module = await WebAssembly.compile((await load("postform.wasm")) as BufferSource);
  await new Playground(new Wasm(module, (name, bytes) => download(name, bytes as BlobPart))).begin();
}

start().catch((error) => {
  const why = error instanceof Error ? error.message : String(error);
  document.body.replaceChildren(element("div", { class: "sorry" },
    element("h1", {}, "postform"),
    element("p", {}, `The playground can't be shown: ${why}.`),
    element("p", {}, "It needs a browser with WebAssembly, and a file server that sends postform.wasm: ", element("code", {}, "python3 -m http.server -d docs/playground"), "."),
    element("p", {}, "The command line does the same without a browser: ", element("a", { href: DOCS }, "documentation"), ".")));
});

