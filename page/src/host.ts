// The host that renders programs: the server of the page, or the page itself.

import { lengthOf, type Place, type Verdict } from "./scene.ts";

export interface Ask {
  /** The job, from 0. */
  job: number;
  /** Unsaved texts of forms, by their names. */
  texts: Record<string, string>;
  /** The identifier of the program that the page already shows, so that this program is not sent again. */
  shown?: string | null;
  /** The hashes of the sections that the page has. */
  has?: Record<string, string>;
  /** Properties of the form and their values. */
  properties?: [string, string][];
}

/** A location in a form and the kind of request; line and column from 0. */
export interface At {
  file: string;
  line: number;
  column: number;
  ask: "complete" | "hover" | "explain" | "format";
}

/** The description of an element, as Markdown, or the possible completions. */
export interface Help {
  at?: Place;
  text?: string;
  list?: { label: string; kind: string; detail: string; at: Place; text: string; snippet: string | null; info: string | null }[];
}

/** The tab of an opened job, and whether the job replaced a job of the same name. */
export interface Added {
  tab: number;
  replaced: boolean;
}

export interface Host {
  /** Sends a scene. For a long program, later scenes contain the results that take longer than its picture: the verdict, and the changes. */
  scenes(ask: Ask): AsyncIterable<ArrayBuffer>;
  /** The help for a location in a form; null: there is none. */
  help(ask: Ask, at: At): Promise<Help | null>;
  /** The verdict of a job with the saved forms. */
  verdict(job: number, properties: [string, string][]): Promise<Verdict>;
  /** Writes a form. Returns null, or the reason why the form was not written. */
  save?(name: string, text: string, was: string): Promise<string | null>;
  /** Opens another job. */
  add?(name: string, bytes: Uint8Array): Promise<Added>;
  /** Closes a job of this name. */
  close?(job: number, name: string): Promise<void>;
  /** Whether typed text is kept even if it is not saved. */
  readonly keeps?: boolean;
  /** Sets a function that is called when a file was changed elsewhere. */
  onChange?(changed: (connected: boolean) => void): void;
}

/** The form's file no longer exists. */
export class Gone extends Error {}

/** The host of `postform watch`. */
export class Server implements Host {
  private readonly base = location.pathname.replace(/[^/]*$/, "");

  async *scenes(ask: Ask): AsyncIterable<ArrayBuffer> {
    const answer = await this.post("scene", ask);
    yield* split(answer.body!.getReader());
  }

  async help(ask: Ask, at: At): Promise<Help | null> {
    return (await this.post("help", { ...ask, at })).json();
  }

  async verdict(job: number, properties: [string, string][]): Promise<Verdict> {
    return (await this.post("verdict", { job, texts: {}, properties })).json();
  }

  async save(name: string, text: string, was: string): Promise<string | null> {
    const answer = await fetch(this.base + "save", this.request({ name, text, was }));
    return answer.ok ? null : (await answer.text()) || answer.statusText;
  }

  async add(name: string, bytes: Uint8Array): Promise<Added> {
    const head = new TextEncoder().encode(`${JSON.stringify(name)}\n`);
    const body = new Blob([head, bytes as BlobPart]);
    return (await this.answer("add", { method: "POST", headers: { "Content-Type": "application/octet-stream" }, body })).json();
  }

  async close(job: number, name: string): Promise<void> {
    await this.post("close", { job, name });
  }

  onChange(changed: (connected: boolean) => void): void {
    let events: EventSource | null = null;
    let opened = false;
    const open = () => {
      events = new EventSource(this.base + "events");
      events.addEventListener("changed", () => changed(true));
      events.onerror = () => changed(false);
      events.onopen = () => {
        // there may have been changes while the page was hidden or postform was not running
        if (opened) changed(true);
        opened = true;
      };
    };
    // a browser allows six connections to a server for all its tabs, so a hidden tab uses none
    document.addEventListener("visibilitychange", () => {
      if (document.hidden) {
        events?.close();
        events = null;
      } else if (!events) open();
    });
    if (!document.hidden) open();
  }

  private post(path: string, body: unknown): Promise<Response> {
    return this.answer(path, this.request(body));
  }

  private async answer(path: string, request: RequestInit): Promise<Response> {
    const answer = await fetch(this.base + path, request);
    if (answer.ok) return answer;
    const why = (await answer.text()) || answer.statusText;
    throw answer.status === 410 ? new Gone(why) : new Error(why);
  }

  private request(body: unknown): RequestInit {
    return { method: "POST", headers: { "Content-Type": "application/json" }, body: JSON.stringify(body) };
  }
}

/** Splits a stream into its scenes. If the caller stops, the rest of the stream is not read. */
async function* split(reader: ReadableStreamDefaultReader<Uint8Array>): AsyncGenerator<ArrayBuffer> {
  let bytes = new Uint8Array();
  let filled = 0;
  try {
    for (;;) {
      const length = lengthOf(bytes.subarray(0, filled));
      if (length !== null && filled >= length) {
        // a buffer that contains only this scene is not copied
        yield length === bytes.length ? bytes.buffer : bytes.slice(0, length).buffer;
        bytes = bytes.slice(length, filled);
        filled = bytes.length;
        continue;
      }
      const { done, value } = await reader.read();
      if (done) {
        if (filled) throw new Error("the answer is cut off");
        return;
      }
      if (filled + value.length > bytes.length) {
        const whole = length ?? (filled ? null : lengthOf(value));
        const more = new Uint8Array(Math.max(whole ?? 0, filled + value.length));
        more.set(bytes.subarray(0, filled));
        bytes = more;
      }
      bytes.set(value, filled);
      filled += value.length;
    }
  } finally {
    // if the page was closed, the connection has already ended
    reader.cancel().catch(() => {});
  }
}
