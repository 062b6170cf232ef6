import { Postform } from "./postform.js";

export { Postform, PostformError } from "./postform.js";

/** Loads postform. */
export async function load(): Promise<Postform> {
  const response = await fetch(new URL("../postform.wasm", import.meta.url));
  return new Postform(await WebAssembly.compile(await response.arrayBuffer()));
}
