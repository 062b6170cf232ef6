// Opens jobs in tabs, and closes them.

import { element } from "./element.ts";
import type { Host } from "./host.ts";
import { type Page, plain } from "./main.ts";
import { base } from "./names.ts";
import { JOBS, openButton } from "./opening.ts";

export class JobTabs {
  private readonly closing = element("button", { title: "Close this job" }, "×");

  /** Adds buttons after the tabs of a page. */
  constructor(private readonly page: Page, private readonly host: Required<Pick<Host, "add" | "close">>) {
    const { header } = page;
    header.root.append(element("span", { class: "acts-of-jobs" }, openButton("+", "Open another job", JOBS, (files) => void this.open(files)), this.closing));
    header.onTabs = (names, job) => {
      this.closing.hidden = names.length < 2;
      this.closing.onclick = () => void this.close(job, names[job]);
    };
  }

  /** Opens jobs in separate tabs, and shows the last one. */
  async open(files: File[]): Promise<void> {
    const { page } = this;
    const close: [string, () => void] = ["close", () => page.say("")];
    let shown = page.shownJob;
    const replaced: string[] = [];
    let wrong = "";
    for (const file of files) {
      try {
        const added = await this.host.add(file.name, new Uint8Array(await file.arrayBuffer()));
        shown = added.tab;
        if (added.replaced) replaced.push(file.name);
      } catch (error) {
        wrong = `${file.name} was not opened: ${plain(error)}`;
        break;
      }
    }
    if (wrong) page.say(wrong, close);
    else if (replaced.length) page.say(`${replaced.join(", ")}: an opened job of the same name was replaced.`, close);
    page.onTyped();
    await page.showJob(shown);
  }

  private async close(job: number, name: string): Promise<void> {
    const { page } = this;
    const last = page.header.jobs - 2;
    try {
      await this.host.close(job, name);
    } catch (error) {
      return page.say(`${base(name)} was not closed: ${plain(error)}`);
    }
    page.onTyped();
    await page.showJob(Math.max(0, Math.min(job, last)));
  }
}
