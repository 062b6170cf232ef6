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
const kinds = { ".html": "text/html", ".wasm": "application/wasm", ".js": "text/javascript" };
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
await equal(() => page.evaluate(() => window.page.program.all()), expected, "byte for byte");
await ok(async () => (await page.locator(".verdict").innerText()).startsWith("proven"), "proven in the browser");

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
await equal(() => page.evaluate(() => window.page.program.all()), haas, "the dropped form prints");
await drop("samples/bracket/expected.fanuc.nc");
await ok(async () => (await page.locator(".beside").innerText()).startsWith("against expected.fanuc.nc"), "compared");
await drop("samples/cl-drill/job.cl");
await ok(async () => (await page.locator(".tab").count()) === 2, "the dropped job is a tab");

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
// the thread of the page is free while postform works
const longest = await page.evaluate(async () => {
  let [last, most] = [performance.now(), 0];
  const timer = setInterval(() => {
    most = Math.max(most, performance.now() - last);
    last = performance.now();
  }, 1);
  await window.host.verdict(0, []);
  clearInterval(timer);
  return most;
});

// what was typed and opened is there after a reload
await page.waitForTimeout(600);
await page.reload();
await page.waitForFunction(() => window.page, null, { timeout: 60_000 });
await ready(page);
await ok(async () => (await page.evaluate(() => window.page.editor.text)).includes("Name xxxxxxxxx"), "typed text is kept");
await equal(() => page.locator(".tab").count(), 2, "and so are the jobs");

// saved: a file of the form, and nothing is left to save
const [saved] = await Promise.all([page.waitForEvent("download"), page.getByRole("button", { name: "save", exact: true }).first().click()]);
await equal(saved.suggestedFilename(), "haas.pf");
await ok(readFileSync(await saved.path(), "utf8").includes("Name xxxxxxxxx"), "the file is what was typed");
const [program] = await Promise.all([page.waitForEvent("download"), page.locator(".tools").getByRole("button", { name: "save" }).click()]);
await equal(readFileSync(await program.path(), "utf8"), await page.evaluate(() => window.page.program.all()), "the program as a file");

// shared: the link has the form and the job in it
await page.evaluate(() => (navigator.clipboard.writeText = async (text) => void (window.copied = text)));
await page.getByRole("button", { name: "share link" }).click();
await page.waitForFunction(() => window.copied);
const link = await page.evaluate(() => window.copied);
const other = await (await found.newContext()).newPage();
await other.goto(link);
await other.waitForFunction(() => window.page, null, { timeout: 60_000 });
await ready(other);
await equal(() => other.evaluate(() => window.page.program.all()), await page.evaluate(() => window.page.program.all()), "the link opens the same");
await equal(new URL(other.url()).hash, "", "the link is taken out of the address");
for (const broken of ["#files=", "#files=AAAA", "#files=%00", `#files=${"A".repeat(5000)}`]) {
  await other.goto("about:blank");
  await other.goto(address + broken);
  await other.waitForFunction(() => window.page, null, { timeout: 60_000 });
  await ok(async () => /can't be read/.test(await other.locator(".front [role=status]").innerText()), `${broken.slice(0, 20)}: said`);
}

// the examples
for (const name of await page.locator("[aria-label=Example] option").allInnerTexts()) {
  if (name === "examples…") continue;
  await page.locator("[aria-label=Example]").selectOption(name);
  await page.waitForTimeout(400);
  await ready(page);
  await ok(async () => (await page.evaluate(() => window.page.program?.path?.moves ?? 0)) > 3, `${name}: drawn`);
  await ok(async () => /proven/.test(await page.locator(".verdict").innerText()), async () => `${name}: ${await page.locator(".verdict").innerText()}`);
}

// jobs are opened by the button and closed again
await page.locator('header input[type="file"]').setInputFiles([join(root, "samples/drill-machine/job.json")]);
await page.waitForFunction(() => document.querySelectorAll(".tab").length === 2 && document.querySelectorAll(".tab")[1].getAttribute("aria-selected") === "true");
await page.getByTitle("Close this job").click();
await page.waitForFunction(() => document.querySelectorAll(".tab").length === 1);
await ready(page);

await page.evaluate(() => {
  const { view } = window.page.editor;
  view.dispatch({ changes: { from: 0, insert: "Nonsense here\n" } });
});
await page.waitForFunction(() => document.querySelector(".cm-lintRange-error"));
await equal(wrong, [], "no errors, and no other server");
const size = statSync(join(folder, "postform.wasm")).size;
const packed = gzipSync(readFileSync(join(folder, "postform.wasm"))).length;
console.log(`ok      the playground; postform.wasm ${(size / 1e6).toFixed(2)} MB, ${(packed / 1e6).toFixed(2)} MB packed; ` +
  `longest wait of the page ${longest.toFixed(0)} ms; from a key to the verdict ${times.sort((a, b) => a - b)[4].toFixed(0)} ms`);
// without WebAssembly the page is a page that says so
const bare = await (await found.newContext()).newPage();
await bare.addInitScript(() => delete window.WebAssembly);
await bare.goto(address);
await ok(async () => /has no WebAssembly/.test(await bare.locator(".sorry").innerText()), "said");
await found.close();
server.close();
