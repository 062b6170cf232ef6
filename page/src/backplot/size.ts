// The fields for the size of the stock. Their first values are the box of the cuts, because no job contains the stock.

import { element } from "../element.ts";
import type { Path } from "../scene.ts";
import type { Block } from "./stock.ts";

const FIELDS = ["X from", "X to", "Y from", "Y to", "Z top"];

/** A block may be at most this many times as large as the path. */
const MOST = 100;

/** Reads a number with a point or a comma; NaN for any other text. */
function number(text: string): number {
  return /^\s*[-+]?(\d+([.,]\d*)?|[.,]\d+)\s*$/.test(text) ? Number(text.replace(",", ".")) : NaN;
}

export class Size {
  readonly root = element("div", { class: "size", role: "group", "aria-label": "Stock", hidden: "" });
  private readonly fields = FIELDS.map((name) => element("input", { type: "text", inputmode: "decimal", "aria-label": name }));
  private readonly hint = element("span", {});
  /** The user typed a size, so rapids are checked against the stock. */
  isGiven = false;
  onChange: () => void = () => {};

  constructor() {
    const labels = FIELDS.map((name, i) => element("label", {}, `${name} `, this.fields[i]));
    this.root.append("Stock", ...labels, this.hint);
    this.fields.forEach((field) => (field.onchange = () => {
      this.isGiven = true;
      this.tell();
      this.onChange();
    }));
  }

  /** Shows an estimate, until the user types a size. */
  show(path: Path, { least, greatest, top }: Block): void {
    this.root.hidden = false;
    this.tell();
    if (this.isGiven) return;
    const { middle } = path.head;
    const values = [least[0] + middle[0], greatest[0] + middle[0], least[1] + middle[1], greatest[1] + middle[1], top + middle[2]];
    values.forEach((value, i) => (this.fields[i].value = String(Math.round(value * 1000) / 1000 + 0)));
  }

  hide(): void {
    this.root.hidden = true;
  }

  /** The typed block; null if the numbers are not valid. */
  block(path: Path): Block | null {
    const [left, right, low, high, top] = this.fields.map((field) => number(field.value));
    const [x, y, z] = path.head.middle;
    const block: Block = { least: [left - x, low - y], greatest: [right - x, high - y], top: top - z };
    const most = path.size * MOST;
    const fits = [right - left, high - low].every((side) => side > 0 && side <= most) && Math.abs(top - z) <= most;
    return fits && [left, low].every((value) => Math.abs(value) <= most * MOST) ? block : null;
  }

  private tell(): void {
    this.hint.textContent = this.isGiven ? "" : "the box of the cuts: type the real size, and rapids through it are marked";
  }
}
