// Files for the reader of the page.

import { element } from "./element.ts";

/** Saves bytes as a file, where the browser puts downloads. */
export function download(name: string, content: BlobPart): void {
  const address = URL.createObjectURL(new Blob([content], { type: "application/octet-stream" }));
  element("a", { href: address, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(address), 10_000);
}
