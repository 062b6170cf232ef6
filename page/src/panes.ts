// Panes side by side, with handles between them. Dragging a handle sets the widths; a pane that becomes too narrow is hidden.

import { element } from "./element.ts";

/** Minimum width of a pane in pixels; a narrower pane is hidden. */
const LEAST = 90;
/** Pixels by which a key moves a handle. */
const STEP = 24;
/** Milliseconds between the two presses of a double click. */
const DOUBLE = 400;
const KEPT = "postform-panes";

/** Puts handles between the panes of a row. */
export function withHandles(row: HTMLElement, panes: HTMLElement[]): void {
  const key = `${KEPT}-${panes.length}`;
  /** The share of the width for each pane; null: the widths of the style sheet. */
  let shares: number[] | null = kept(key, panes.length);
  const apply = () => {
    row.style.gridTemplateColumns = shares ? shares.map((share) => (share > 0 ? `minmax(0, ${share}fr)` : "0px")).join(" 5px ") : "";
    shares?.forEach((share, i) => panes[i].classList.toggle("closed", share === 0));
  };
  const set = (made: number[] | null) => {
    shares = made;
    if (!made) panes.forEach((pane) => pane.classList.remove("closed"));
    apply();
    try {
      if (made) localStorage.setItem(key, JSON.stringify(made));
      else localStorage.removeItem(key);
    } catch {
      // a page that was opened as a file can't store anything
    }
  };
  panes.forEach((pane, i) => {
    row.append(pane);
    if (i + 1 === panes.length) return;
    const handle = element("div", { class: "handle", role: "separator", tabindex: "0", "aria-orientation": "vertical", "aria-valuenow": "50", "aria-label": `Width of ${pane.getAttribute("aria-label")}`, title: "Drag: width of the panes; double click: as it was" });
    const move = (by: number) => {
      const widths = panes.map((pane) => pane.getBoundingClientRect().width);
      const both = widths[i] + widths[i + 1];
      let left = Math.max(0, Math.min(both, widths[i] + by));
      if (left < LEAST) left = by < 0 ? 0 : widths[i] === 0 ? LEAST : left;
      if (both - left < LEAST) left = by > 0 ? both : widths[i + 1] === 0 ? both - LEAST : left;
      [widths[i], widths[i + 1]] = [left, both - left];
      set(widths.map(Math.round));
    };
    // in some browsers, a captured pointer gives no double click event
    let pressed = -Infinity;
    handle.onpointerdown = (event) => {
      event.preventDefault();
      const isSecond = event.timeStamp - pressed < DOUBLE;
      pressed = isSecond ? -Infinity : event.timeStamp;
      if (isSecond) return set(null);
      handle.setPointerCapture(event.pointerId);
    };
    handle.onpointermove = (event) => {
      if (!handle.hasPointerCapture(event.pointerId)) return;
      const box = handle.getBoundingClientRect();
      move(event.clientX - (box.left + box.width / 2));
    };
    handle.onkeydown = (event) => {
      const by = { ArrowLeft: -STEP, ArrowRight: STEP }[event.key];
      if (!by) return;
      event.preventDefault();
      event.stopPropagation();
      move(by);
    };
    row.append(handle);
  });
  apply();
}

function kept(key: string, count: number): number[] | null {
  try {
    const found = JSON.parse(localStorage.getItem(key) ?? "null");
    return Array.isArray(found) && found.length === count && found.every((share) => Number.isFinite(share) && share >= 0) ? found : null;
  } catch {
    return null;
  }
}
