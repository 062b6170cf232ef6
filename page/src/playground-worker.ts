// Runs postform in a separate thread, so that the page stays responsive while a long program is printed and proven.

import { run } from "./wasi.ts";

let module: WebAssembly.Module | null = null;

interface Asked {
  id: number;
  module?: WebAssembly.Module;
  request?: Uint8Array;
}

addEventListener("message", async (event: MessageEvent<Asked>) => {
  const { id, request } = event.data;
  module = event.data.module ?? module;
  if (!request) return;
  try {
    const answer = await run(module!, request);
    postMessage({ id, answer }, { transfer: [answer.buffer] });
  } catch (error) {
    postMessage({ id, error: error instanceof Error ? error.message : String(error) });
  }
});
