// Downloads of files.

import { element } from "./element.ts";

/** Saves bytes as a file, in the browser's folder for downloads. */
export function download(name: string, content: BlobPart): void {
  const address = URL.createObjectURL(new Blob([content], { type: "application/octet-stream" }));
  element("a", { href: address, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(address), 10_000);
}
