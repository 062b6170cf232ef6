import { readFile } from "node:fs/promises";
import { Postform } from "./postform.js";

export { Postform, PostformError } from "./postform.js";

/** Loads postform. */
export async function load(): Promise<Postform> {
  const bytes = await readFile(new URL("../postform.wasm", import.meta.url));
  return new Postform(await WebAssembly.compile(new Uint8Array(bytes)));
}
