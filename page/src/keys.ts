// The keys of the page outside the form.

import { VIEWS } from "./backplot/camera.ts";
import { element } from "./element.ts";
import type { Page } from "./main.ts";

type Key = [keys: string, what: string, act: (page: Page, back: boolean) => void];

const KEYS: Key[] = [
  ["n p ↓ ↑", "next block, block before", (page, back) => page.step(back ? -1 : 1)],
  ["t T", "next tool, tool before", (page, back) => page.nextTool(back ? -1 : 1)],
  ["i I", "next item of the job, item before", (page, back) => page.nextItem(back ? -1 : 1)],
  ["f F", "next finding of the form, finding before", (page, back) => page.nextFinding(back ? -1 : 1)],
  ["d D", "next difference or change, the one before", (page, back) => page.nextDifference(back ? -1 : 1)],
  ["space", "play, stop", (page) => page.play()],
  ["s", "the stock, cut by the tools", (page) => page.backplot.toggleStock()],
  ["m Esc", "measure between two points, end it", (page) => page.backplot.toggleMeasure()],
  ["/", "find in the program", (page) => page.listing.find.open()],
  ["z", "the chosen block from near", (page) => page.backplot.zoomToBlock()],
  ["0", "all of it", (page) => page.backplot.fit()],
  ["1 2 3 4 5", "from above, the front, the side, the corner, as a lathe", () => {}],
  ["Home End", "first block, last block", () => {}],
  ["Esc Esc", "from the form to the program", () => {}],
  ["Ctrl S", "save the form", () => {}],
  ["Shift Alt F", "in the form: its canonical layout", () => {}],
];

export function keys(page: Page): void {
  const rows = KEYS.map(([names, what]) => element("tr", {}, element("td", {}, ...names.split(" ").flatMap((key) => [element("kbd", {}, key), " "])), element("td", {}, what)));
  const close = element("button", { autofocus: "" }, "close");
  const help = element("dialog", { "aria-label": "Keys" }, element("table", {}, ...rows), close);
  close.onclick = () => help.close();
  document.body.append(help);
  page.keysButton.onclick = () => help.showModal();
  // a clicked button loses the focus, so that space and letters still control the page
  document.addEventListener("click", (event) => {
    const button = (event.target as HTMLElement).closest("button");
    if (event.detail > 0 && button && button === document.activeElement && !button.closest("dialog, .cm-editor")) page.listing.focus();
  });
  document.addEventListener("keydown", (event) => {
    if (event.key === "s" && (event.ctrlKey || event.metaKey)) {
      // if the form has the focus, the key function of the form saves the form
      if (!event.defaultPrevented) void page.save();
      return event.preventDefault();
    }
    const target = event.target as HTMLElement;
    if (event.ctrlKey || event.metaKey || event.altKey || help.open || target.closest(".cm-editor, input, textarea, select")) return;
    if (target.closest("button") && (event.key === " " || event.key === "Enter")) return;
    const view = VIEWS["12345".indexOf(event.key)];
    const acts: Record<string, () => void> = {
      ArrowDown: () => page.step(1),
      ArrowUp: () => page.step(-1),
      PageDown: () => page.step(20),
      PageUp: () => page.step(-20),
      Home: () => page.choose(1, "key"),
      End: () => page.choose(Infinity, "key"),
      n: () => page.step(1),
      p: () => page.step(-1),
      "?": () => help.showModal(),
      Escape: () => page.backplot.endMeasure(),
    };
    const row = KEYS.find(([names]) => names.split(" ").includes(event.key === " " ? "space" : event.key));
    const act = acts[event.key] ?? (view ? () => page.backplot.look(view.name) : row && (() => row[2](page, event.key !== event.key.toLowerCase())));
    if (!act) return;
    event.preventDefault();
    act();
  });
}
