// How the page does with the bracket and with many moves, in a browser without a GPU: milliseconds to the first picture and verdict,
// frames while the path is turned, memory, and from a key until the new picture and the new verdict are painted. What is typed changes the
// program (a blank between the words of each block) or does not (a letter of the form's name). Times are told as ratios to a whole
// `postform render` of the same job, which proves it too and is run in turn with the keys.
//
//   node test/figures.mjs [MOVES..]     0: the bracket
import { spawnSync } from "node:child_process";
import { readFileSync, rmSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { browser, folder, manyMoves, postform, ready, watch } from "./harness.mjs";

const median = (times) => times.sort((a, b) => a - b)[times.length >> 1];
const found = await browser();
for (const moves of process.argv.length > 2 ? process.argv.slice(2).map(Number) : [0, 100_000, 1_000_000]) {
  const path = folder();
  if (moves) await manyMoves(join(path, "bracket.json"), moves);
  const form = join(path, "my.pf");
  writeFileSync(form, readFileSync(form, "utf8").replace("Name Fanuc 0i-M", "Name Fanuc 0i-M\nSpaces? Y"));
  const served = await watch(path);
  const page = await found.newPage({ viewport: { width: 1280, height: 800 } });
  await page.addInitScript(() => {
    const look = () => {
      if (window.page?.backplot.frames.pieces > 0 && !window.firstPicture) window.firstPicture = performance.now();
      else requestAnimationFrame(look);
    };
    requestAnimationFrame(look);
  });
  // the page as it was built last, in a program that was built before
  if (process.env.PAGE) await page.route(served.address, (route) => route.fulfill({ path: process.env.PAGE, contentType: "text/html" }));
  await page.goto(served.address);
  await page.waitForFunction(() => window.firstPicture, null, { timeout: 120_000 });
  const first = await page.evaluate(() => window.firstPicture);
  await ready(page);
  await page.waitForFunction(() => /^(proven|different|not)/.test(document.querySelector(".verdict").textContent), null, { timeout: 120_000 });
  const verdict = await page.evaluate(() => performance.now());
  // until the frame is painted, as somebody sees it
  const frames = await page.evaluate(async () => {
    const { backplot } = window.page;
    const painted = () => new Promise((done) => requestAnimationFrame(() => setTimeout(done)));
    const times = async (count, act) => {
      const all = [];
      for (let i = 0; i < count; i++) {
        await painted();
        const began = performance.now();
        act();
        await painted();
        all.push(performance.now() - began);
      }
      return all.sort((a, b) => a - b)[count >> 1];
    };
    const canvas = document.querySelector("canvas.path");
    const press = () => canvas.dispatchEvent(new KeyboardEvent("keydown", { key: "ArrowLeft" }));
    const nothing = await times(9, () => {});
    const turning = await times(15, press);
    const coarse = backplot.frames.pieces;
    await new Promise((done) => setTimeout(done, 400));
    const still = await times(3, () => backplot.redraw());
    return { nothing, turning, coarse, still, fine: backplot.frames.pieces, by: backplot.drawsBy, heap: performance.memory?.usedJSHeapSize / 1e6 };
  });
  // the stock, cut to the end, and frames while the timeline plays over it
  const stock = await page.evaluate(async () => {
    const { backplot, timeline, program } = window.page;
    if (!backplot.toggleStock) return null; // a page of before
    const began = performance.now();
    backplot.toggleStock();
    while (backplot.stock && backplot.stock.done < program.path.pieces) await new Promise(requestAnimationFrame);
    if (!backplot.stock) return null;
    const cut = performance.now() - began;
    timeline.toggle();
    const [frames, from] = [backplot.frames.count, performance.now()];
    await new Promise((done) => setTimeout(done, 3000));
    const rate = ((backplot.frames.count - frames) * 1000) / (performance.now() - from);
    timeline.end();
    backplot.toggleStock();
    return { cut, rate };
  });
  const keys = { changing: [], leaving: [] };
  const commands = [];
  for (let i = 0; i < (moves > 200_000 ? 5 : 11); i++) {
    const began = performance.now();
    const { status } = spawnSync(postform, ["render", "bracket.json", "--form", "my.pf", "-o", "part.nc"], { cwd: path });
    if (status !== 0) throw new Error(`postform render ended with ${status}`);
    commands.push(performance.now() - began);
    for (const [kind, behind, text] of [["changing", "Spaces? ", i % 2 ? "Y" : "N"], ["leaving", "Name Fanuc", "x"]]) {
      keys[kind].push(await page.evaluate(async ([behind, text]) => {
        const { page } = window;
        const { view } = page.editor;
        const before = page.painted.length;
        const at = view.state.doc.toString().indexOf(behind) + behind.length;
        const to = behind === "Spaces? " ? view.state.doc.lineAt(at).to : at;
        view.dispatch({ changes: { from: at, to, insert: text } });
        while (page.painted.length === before || !page.painted.at(-1).verdict) await new Promise((done) => setTimeout(done, 5));
        return page.painted.at(-1);
      }, [behind, text]));
      await page.waitForTimeout(300);
    }
  }
  const command = median(commands);
  const most = Number(/VmHWM:\s*(\d+)/.exec(readFileSync(`/proc/${served.pid}/status`, "utf8"))?.[1]) / 1000;
  const told = (times) => {
    const [picture, verdict] = ["picture", "verdict"].map((of) => median(times.map((time) => time[of])));
    return `picture ${picture.toFixed(0)} ms, verdict ${verdict.toFixed(0)} ms (${(verdict / command).toFixed(2)} of a render)`;
  };
  console.log(`${moves ? `${moves} moves` : "the bracket"}: first picture ${first.toFixed(0)} ms, verdict ${verdict.toFixed(0)} ms; ` +
    `a frame by ${frames.by} while turning ${frames.turning.toFixed(1)} ms (${frames.coarse} lines; a frame without anything ${frames.nothing.toFixed(1)} ms), ` +
    `${stock ? `stock to the end ${stock.cut.toFixed(0)} ms, ${stock.rate.toFixed(0)} frames a second playing; ` : ""}` +
    `at rest ${frames.still.toFixed(1)} ms (${frames.fine} lines); heap ${frames.heap?.toFixed(0)} MB, postform ${most.toFixed(0)} MB at most; ` +
    `a key that changes the program: ${told(keys.changing)}; one that does not: ${told(keys.leaving)}; a whole render ${command.toFixed(0)} ms`);
  await page.close();
  served.end();
  rmSync(path, { recursive: true });
}
await found.close();
