// Opens files with a button, or files that are dropped onto the page.

import { element } from "./element.ts";

/** The file name extensions of jobs. */
export const JOBS =
  ".json,.jsonl,.ndjson,.cl,.apt,.aptsource,.ncl,.cls,.cldata,.as,.nc,.ngc,.tap,.cnc,.eia,.min,.ssb,.mpf,.spf,.h,.i,.fcstd,.nci,.gz";

/** The file name extensions of NC programs. */
const PROGRAMS = /\.(nc|ngc|tap|cnc|eia|min|ssb|mpf|spf|h|i)$/i;

/** Does the file have the extension of an NC program? */
export function isProgram(name: string): boolean {
  return PROGRAMS.test(name);
}

/** A button that opens files. */
export function openButton(text: string, title: string, accept: string, open: (files: File[]) => void): HTMLElement {
  const input = element("input", { type: "file", multiple: "", hidden: "", accept });
  const button = element("button", { title }, text);
  button.onclick = () => input.click();
  input.onchange = () => {
    open([...(input.files ?? [])]);
    // so that the same file can be opened again
    input.value = "";
  };
  return element("span", {}, button, input);
}

/** Opens files that are dropped anywhere on the page. */
export function takeDrops(text: string, open: (files: File[]) => void): void {
  const drop = element("div", { class: "drop", hidden: "" }, text);
  document.body.append(drop);
  addEventListener("dragover", (event) => {
    // text that is dragged inside the page is not a file
    if (!event.dataTransfer?.types.includes("Files")) return;
    event.preventDefault();
    drop.hidden = false;
  });
  addEventListener("dragleave", (event) => {
    if (!event.relatedTarget) drop.hidden = true;
  });
  addEventListener("drop", (event) => {
    if (!event.dataTransfer?.types.includes("Files")) return;
    event.preventDefault();
    drop.hidden = true;
    open([...(event.dataTransfer?.files ?? [])]);
  });
}
