// The search field of the program.

import { element } from "./element.ts";

export class Find {
  readonly root = element("div", { class: "find", role: "search", hidden: "" });
  private readonly field = element("input", { type: "text", "aria-label": "Find in the program", placeholder: "find, as G83 or X1.5", spellcheck: "false" });
  private readonly told = element("span", { "aria-live": "polite" });
  /** Goes to the next (1) or previous (-1) line that contains a text. 0: stays if the current line contains it. Returns whether a line was found. */
  onFind: (text: string, by: 1 | -1 | 0) => boolean = () => false;
  onClose: () => void = () => {};

  constructor() {
    const step = (name: string, title: string, by: 1 | -1) => {
      const button = element("button", { title }, name);
      button.onclick = () => this.go(by);
      return button;
    };
    const close = element("button", { title: "Close (Esc)", "aria-label": "Close" }, "×");
    close.onclick = () => this.close();
    this.root.append(this.field, step("↓", "Next (Enter)", 1), step("↑", "Before (Shift Enter)", -1), this.told, close);
    this.field.onkeydown = (event) => {
      if (event.key === "Enter") this.go(event.shiftKey ? -1 : 1);
      else if (event.key === "Escape") this.close();
      else return;
      event.preventDefault();
    };
    // while a text is typed, the search starts at the current line
    this.field.oninput = () => this.go(0);
  }

  open(): void {
    this.root.hidden = false;
    this.field.focus();
    this.field.select();
  }

  private close(): void {
    this.root.hidden = true;
    this.onClose();
  }

  private go(by: 1 | -1 | 0): void {
    const found = this.field.value === "" || this.onFind(this.field.value, by);
    this.told.textContent = found ? "" : "not in the program";
  }
}
