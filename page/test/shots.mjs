// The pictures of docs/images that show the page. Look at each before you commit it.
import { rmSync } from "node:fs";
import { join } from "node:path";
import { browser, folder, ready, root, watch } from "./harness.mjs";

const found = await browser();
const old = join(root, "samples/bracket/expected.haas.nc");

async function shot(name, { scheme = "light", width = 1280, height = 760, more = [], act }) {
  const path = folder();
  const served = await watch(path, ...more);
  const page = await found.newPage({ viewport: { width, height }, colorScheme: scheme });
  if (process.env.PAGE) await page.route(served.address, (route) => route.fulfill({ path: process.env.PAGE, contentType: "text/html" }));
  await page.goto(served.address);
  await ready(page);
  await act?.(page);
  await page.waitForTimeout(900);
  await page.screenshot({ path: join(root, "docs/images", `${name}.png`) });
  await page.close();
  served.end();
  rmSync(path, { recursive: true });
}

/** Chooses the first block with these words, and so many on. */
const choose = (words, on = 0) => (page) => page.evaluate(([words, on]) => {
  const { program } = window.page;
  for (let line = 1; line <= program.lines; line++) {
    if (program.text(line).includes(words)) return window.page.choose(line + on, "key");
  }
}, [words, on]);

await shot("watch", { act: choose("G82", 1) });
await shot("watch-dark", { scheme: "dark", more: ["--against", old], act: choose("G83") });
await shot("watch-wrong", {
  act: async (page) => {
    await page.evaluate(() => {
      const { view } = window.page.editor;
      const at = view.state.doc.toString().indexOf("\nT[tool]") + 8;
      view.dispatch({ changes: { from: at, insert: " " }, selection: { anchor: at }, scrollIntoView: true });
      view.focus();
    });
    await page.waitForTimeout(800);
    await ready(page);
    await page.locator(".cm-lintRange-error, .cm-lintRange-warning").first().hover();
  },
});
await found.close();
