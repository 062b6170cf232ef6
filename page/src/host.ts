// Who renders: the program that serves the page, or the page itself.

import type { Verdict } from "./scene.ts";

export interface Ask {
  /** Which job, from 0. */
  job: number;
  /** Texts of forms that are not saved, by their names. */
  texts: Record<string, string>;
  /** Is the program proven, too? */
  proves: boolean;
}

export interface Host {
  scene(ask: Ask): Promise<ArrayBuffer>;
  /** The verdict of a job with the forms as they are saved. */
  verdict(job: number): Promise<Verdict>;
  /** Writes a form. Null: it is written; else why not. */
  save?(name: string, text: string, was: string): Promise<string | null>;
  /** Something was changed elsewhere. */
  onChange?(changed: (connected: boolean) => void): void;
}

/** `postform watch`. */
export class Server implements Host {
  private readonly base = location.pathname.replace(/[^/]*$/, "");

  async scene(ask: Ask): Promise<ArrayBuffer> {
    return (await this.post("scene", ask)).arrayBuffer();
  }

  async verdict(job: number): Promise<Verdict> {
    return (await this.post("verdict", { job, texts: {}, proves: true })).json();
  }

  async save(name: string, text: string, was: string): Promise<string | null> {
    const answer = await fetch(this.base + "save", this.request({ name, text, was }));
    return answer.ok ? null : (await answer.text()) || answer.statusText;
  }

  onChange(changed: (connected: boolean) => void): void {
    const events = new EventSource(this.base + "events");
    events.addEventListener("changed", () => changed(true));
    events.onerror = () => changed(false);
    let opened = false;
    events.onopen = () => {
      if (opened) changed(true);
      opened = true;
    };
  }

  private async post(path: string, body: unknown): Promise<Response> {
    const answer = await fetch(this.base + path, this.request(body));
    if (!answer.ok) throw new Error((await answer.text()) || answer.statusText);
    return answer;
  }

  private request(body: unknown): RequestInit {
    return { method: "POST", headers: { "Content-Type": "application/json" }, body: JSON.stringify(body) };
  }
}
