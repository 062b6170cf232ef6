// The playground from a plain file server, as anybody may put it somewhere: it prints the bracket byte for byte as the program does, files
// can be dropped on it, and it asks no other server. `docs/playground/build` makes it first.
import { createServer } from "node:http";
import { existsSync, readFileSync, statSync } from "node:fs";
import { extname, join } from "node:path";
import { gzipSync } from "node:zlib";
import { browser, equal, ok, ready, root } from "./harness.mjs";

const folder = join(root, "docs/playground");
if (!existsSync(join(folder, "postform.wasm"))) {
  console.error("can't run: docs/playground/build makes the playground first");
  process.exit(77);
}
const kinds = { ".html": "text/html", ".wasm": "application/wasm" };
const server = createServer((request, response) => {
  const path = join(folder, request.url === "/" ? "index.html" : new URL(request.url, "http://x").pathname);
  if (!existsSync(path)) return response.writeHead(404).end();
  response.writeHead(200, { "Content-Type": kinds[extname(path)] ?? "application/octet-stream" }).end(readFileSync(path));
});
await new Promise((listening) => server.listen(0, "127.0.0.1", listening));
const address = `http://127.0.0.1:${server.address().port}/`;
const found = await browser();
const page = await found.newPage({ viewport: { width: 1280, height: 800 } });
const wrong = [];
page.on("pageerror", (error) => wrong.push(String(error)));
page.on("request", (request) => {
  if (!request.url().startsWith(address) && !request.url().startsWith("data:")) wrong.push(request.url());
});
await page.goto(address);
await page.waitForFunction(() => window.page, null, { timeout: 60_000 });
await ready(page);
const expected = readFileSync(join(root, "samples/bracket/expected.fanuc.nc"), "utf8");
equal(await page.evaluate(() => window.page.program.all()), expected, "byte for byte");
ok((await page.locator(".verdict").innerText()).startsWith("proven"), "proven in the browser");

/** Drops files on the page. */
async function drop(...paths) {
  const files = paths.map((path) => ({ name: path.split("/").pop(), text: readFileSync(join(root, path), "utf8") }));
  await page.evaluate((files) => {
    const data = new DataTransfer();
    for (const { name, text } of files) data.items.add(new File([text], name));
    document.body.dispatchEvent(new DragEvent("drop", { dataTransfer: data, bubbles: true, cancelable: true }));
  }, files);
  await page.waitForTimeout(300);
  await ready(page);
}

await drop("postforms/haas.pf");
const haas = readFileSync(join(root, "samples/bracket/expected.haas.nc"), "utf8");
equal(await page.evaluate(() => window.page.program.all()), haas, "the dropped form prints");
await drop("samples/bracket/expected.fanuc.nc");
ok((await page.locator(".beside").innerText()).startsWith("against expected.fanuc.nc"), "compared");
await drop("samples/cl-drill/job.cl");
ok(await page.locator(".tab").count() === 2, "the dropped job is a tab");

// typed: from a key to the new verdict
const times = [];
for (let i = 0; i < 9; i++) {
  times.push(await page.evaluate(async () => {
    const { view } = window.page.editor;
    const before = window.page.painted.length;
    view.dispatch({ changes: { from: view.state.doc.toString().indexOf("Name ") + 5, insert: "x" } });
    while (window.page.painted.length === before) await new Promise((done) => setTimeout(done, 1));
    return window.page.painted.at(-1).verdict;
  }));
}
await page.evaluate(() => {
  const { view } = window.page.editor;
  view.dispatch({ changes: { from: 0, insert: "Nonsense here\n" } });
});
await page.waitForFunction(() => document.querySelector(".cm-lintRange-error"));
equal(wrong, [], "no errors, and no other server");
const size = statSync(join(folder, "postform.wasm")).size;
const packed = gzipSync(readFileSync(join(folder, "postform.wasm"))).length;
console.log(`ok      the playground; postform.wasm ${(size / 1e6).toFixed(2)} MB, ${(packed / 1e6).toFixed(2)} MB packed; ` +
  `from a key to the verdict ${times.sort((a, b) => a - b)[4].toFixed(0)} ms`);
await found.close();
server.close();
