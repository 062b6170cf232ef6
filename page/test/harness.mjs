// What the tests of the page share: a browser, `postform watch` in a folder of its own, and a list of tests.
import { spawn } from "node:child_process";
import { once } from "node:events";
import { createWriteStream, existsSync, mkdtempSync, copyFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { delimiter, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";
import { chromium } from "playwright-core";

export const root = fileURLToPath(new URL("../..", import.meta.url));
export const postform = resolve(process.env.POSTFORM ?? join(root, "target/debug/postform"));

function installed() {
  const names = ["chromium", "chromium-headless-shell", "google-chrome", "chrome"];
  const folders = (process.env.PATH ?? "").split(delimiter);
  return process.env.BROWSER_PATH ?? folders.flatMap((folder) => names.map((name) => join(folder, name))).find(existsSync);
}

/** The browser, with WebGL2 by software where there is no GPU. */
export async function browser() {
  const executablePath = installed();
  if (!executablePath || !existsSync(postform)) {
    console.error(`can't run: ${executablePath ? `build ${postform} first` : "no Chromium is installed"}`);
    process.exit(77);
  }
  const args = ["--no-sandbox", "--disable-gpu", "--disable-background-networking", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"];
  return chromium.launch({ executablePath, args: [...args, "--enable-precise-memory-info"] });
}

/** A folder with the bracket and a form. */
export function folder(form = "postforms/fanuc.pf", job = "samples/bracket/job.json") {
  const path = mkdtempSync(join(tmpdir(), "postform-page-"));
  copyFileSync(join(root, form), join(path, "my.pf"));
  copyFileSync(join(root, job), join(path, "bracket.json"));
  return path;
}

/** A job of many moves: a finishing pass over a wave, short moves line by line. */
export async function manyMoves(path, moves) {
  const file = createWriteStream(path);
  const head = { postform: 1, program: 1, units: "mm", tools: [{ number: 1, diameter: 6 }] };
  file.write(JSON.stringify(head).slice(0, -1));
  file.write(',"operations":[{"tool":1,"work":54,"spindle":{"speed":8000,"direction":"cw"},"feed":1500,"path":[{"rapid":[0,0,20]}');
  const side = Math.round(Math.sqrt(moves));
  for (let i = 0; i < moves; i++) {
    const row = Math.floor(i / side);
    const x = ((row % 2 ? side - 1 - (i % side) : i % side) / side) * 200;
    const y = (row / side) * 200;
    const z = 5 * Math.sin(x / 15) * Math.cos(y / 20);
    if (!file.write(`,{"line":[${x.toFixed(3)},${y.toFixed(3)},${z.toFixed(3)}]}`)) await once(file, "drain");
  }
  file.end("]}]}");
  await once(file, "finish");
}

/** `postform watch` in a folder: its address, and how it is ended. */
export async function watch(path, ...more) {
  const child = spawn(postform, ["watch", "my.pf", "--job", "bracket.json", "--no-open", ...more], { cwd: path, env: { ...process.env, XDG_RUNTIME_DIR: path } });
  let said = "";
  child.stderr.on("data", (text) => (said += text));
  const address = await new Promise((resolve, reject) => {
    child.stdout.once("data", (line) => resolve(String(line).trim()));
    child.once("exit", (code) => reject(new Error(`postform watch ended with ${code}: ${said}`)));
  });
  return { address, pid: child.pid, end: () => (child.removeAllListeners("exit"), child.kill()) };
}

const tests = [];
export function test(name, run) {
  tests.push([name, run]);
}

/** Runs all tests, or those whose name has a word of the command line. */
export async function run() {
  const found = await browser();
  const wanted = process.argv.slice(2).filter((word) => !word.startsWith("--"));
  let failed = 0;
  for (const [name, run] of tests) {
    if (wanted.length && !wanted.some((word) => name.includes(word))) continue;
    const ends = [];
    try {
      await run({
        /** A page with the bracket in it, ready. */
        async open({ form, job, moves, more = [], ...options } = {}) {
          const path = folder(form, job);
          if (moves) await manyMoves(join(path, "bracket.json"), moves);
          const served = await watch(path, ...more);
          ends.push(() => served.end());
          const context = await found.newContext({ viewport: { width: 1280, height: 800 }, ...options });
          const page = await context.newPage();
          const wrong = [];
          page.on("pageerror", (error) => wrong.push(String(error)));
          page.on("request", (request) => {
            if (!request.url().startsWith("data:") && !request.url().startsWith(served.address)) wrong.push(`asks ${request.url()}`);
          });
          // the page as it was built last, in a program that was built before
          if (process.env.PAGE) await page.route(served.address, (route) => route.fulfill({ path: process.env.PAGE, contentType: "text/html" }));
          await page.goto(served.address);
          await ready(page);
          ends.push(async () => {
            await context.close();
            rmSync(path, { recursive: true });
            if (wrong.length) throw new Error(wrong.join("\n"));
          });
          /** The program again, in the same folder. */
          const start = async () => {
            const again = await watch(path, ...more);
            ends.push(() => again.end());
            return again;
          };
          return { page, path, address: served.address, end: served.end, start };
        },
        browser: found,
      });
      for (const end of ends.splice(0).reverse()) await end();
      console.log(`ok      ${name}`);
    } catch (error) {
      failed++;
      console.log(`FAILED  ${name}\n${error.stack ?? error}`);
      for (const end of ends.reverse()) await Promise.resolve(end()).catch(() => {});
    }
  }
  await found.close();
  console.log(failed ? `${failed} failed` : "all passed");
  process.exit(failed ? 1 : 0);
}

/** Until the page shows what it was asked for. */
export function ready(page) {
  return page.waitForFunction(() => window.page && !window.page.running && window.page.backplot.frames.count > 1, null, { timeout: 120_000 });
}

/**
 * Fails unless `is` equals `expected`. If `is` is a function, it is called until it returns `expected`: what a page shows comes from the server, and
 * reaches two pages at different times.
 */
export async function equal(is, expected, what = "") {
  const wanted = JSON.stringify(expected);
  const [last, holds] = await retry(is, (value) => JSON.stringify(value) === wanted);
  if (!holds) throw new Error(`${what}\n  is        ${JSON.stringify(last)}\n  expected  ${wanted}`);
}

/** Fails unless `holds` is true; a function is called until it returns true. `what` may be a function, too: it is called after a failure. */
export async function ok(holds, what) {
  const [, held] = await retry(holds, Boolean);
  if (!held) throw new Error(typeof what === "function" ? await what() : what);
}

/** The last value and whether it is right; a function is called again for ten seconds until its value is right. */
async function retry(value, right) {
  const end = Date.now() + 10_000;
  for (;;) {
    const is = typeof value === "function" ? await value() : value;
    if (right(is) || typeof value !== "function" || Date.now() > end) return [is, right(is)];
    await new Promise((again) => setTimeout(again, 50));
  }
}
