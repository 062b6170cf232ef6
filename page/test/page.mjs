// The page of `postform watch` in a real browser: what is typed, clicked and pressed, and what is then shown.
import { spawnSync } from "node:child_process";
import { mkdtempSync, readFileSync, renameSync, unlinkSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { equal, ok, postform, ready, root, run, test, watch } from "./harness.mjs";

const chosen = (page) => page.locator(".ln.on").innerText();
const formLine = (page) => page.locator(".cm-line.cm-lit").innerText();
const line = async (page) => Number(await page.locator(".ln.on").getAttribute("data-line"));

/** Puts the cursor of the form behind some text of a line, and types. */
async function type(page, behind, text, keys = []) {
  await page.evaluate((behind) => {
    const { view } = window.page.editor;
    const at = view.state.doc.toString().indexOf(behind) + behind.length;
    view.dispatch({ selection: { anchor: at }, scrollIntoView: true });
    view.focus();
  }, behind);
  for (const key of keys) await page.keyboard.press(key);
  await page.keyboard.type(text);
  await page.waitForTimeout(50);
  await ready(page);
}

test("three panes, and what was proven", async ({ open }) => {
  const { page } = await open();
  await equal(() => page.title(), "my.pf · bracket.json · postform");
  await ok(async () => (await page.locator(".verdict").innerText()).startsWith("proven"), "the verdict");
  for (const pane of ["Form", "Program", "Path"]) await ok(() => page.getByRole("region", { name: pane, exact: true }).isVisible(), pane);
  const program = readFileSync(join(root, "samples/bracket/expected.fanuc.nc"), "utf8");
  await equal(() => page.evaluate(() => window.page.program.all()), program, "byte for byte as render prints it");
});

test("lines between @if and @end are indented, and saving is confirmed", async ({ open }) => {
  const { page, path } = await open();
  await type(page, "1stToolChange\n", "");
  await page.keyboard.type("@if [tool] > 3\nM1\n@else\nM0\n@end\n");
  await ready(page);
  const text = await page.evaluate(() => window.page.editor.text);
  await ok(text.includes("1stToolChange\n@if [tool] > 3\n  M1\n@else\n  M0\n@end\n"), text.slice(text.indexOf("1stToolChange"), text.indexOf("1stToolChange") + 80));
  await page.keyboard.press("Control+s");
  await page.waitForFunction(() => document.querySelector("footer").textContent.includes("my.pf is saved"));
  await ok(readFileSync(join(path, "my.pf"), "utf8").includes("  M1\n@else"), "and it is");
});

test("the program is searched while the word is typed", async ({ open }) => {
  const { page } = await open();
  await page.getByRole("region", { name: "Program", exact: true }).getByText("find").click();
  const field = page.getByLabel("Find in the program");
  const seen = [];
  for (const letter of "G98 G83") {
    await field.press(letter === " " ? "Space" : letter);
    seen.push(await line(page));
  }
  await ok(async () => (await chosen(page)).includes("G98 G83"), () => chosen(page));
  await ok(seen.every((at, i) => i === 0 || at >= seen[i - 1]), `a longer word is found from the shorter one on: ${seen}`);
  await field.press("x");
  await ok(async () => (await page.locator(".find").innerText()).includes("not in the program"), "what is not there");
});

test("a wrong word is underlined and said", async ({ open }) => {
  const { page, path } = await open();
  const before = readFileSync(join(path, "my.pf"), "utf8");
  await type(page, "1stToolChange\nT[tool]", " ");
  const wrong = page.locator(".cm-lintRange-error, .cm-lintRange-warning").first();
  await equal(() => wrong.innerText(), "M6", "the word that is lost");
  await wrong.hover();
  const told = page.locator(".cm-tooltip-lint");
  await told.waitFor();
  await ok(async () => /M6.* is lost/.test(await told.innerText()), "said in words");
  await ok(async () => (await page.locator(".lint").innerText()) !== "0 errors, 0 warnings", "and counted");
  await equal(readFileSync(join(path, "my.pf"), "utf8"), before, "nothing is written");
  const verdict = await page.locator(".verdict").innerText();
  await ok(/different|lost/.test(verdict), `a tool change without M6 is not proven: ${verdict}`);
  // and fixed again
  await page.keyboard.press("Backspace");
  await ready(page);
  await page.waitForFunction(() => document.querySelector(".verdict").textContent.startsWith("proven"));
});

test("a form with errors says so and keeps the last picture", async ({ open }) => {
  const { page } = await open();
  await type(page, "Machine Mill", "xx");
  await page.waitForFunction(() => document.body.classList.contains("stale"));
  await ok(async () => (await page.locator(".verdict").innerText()).includes("errors"), "said");
  await ok(async () => await page.locator(".ln").count() > 5, "the program of before is there");
});

test("a click on a move shows its block, form line and job item", async ({ open }) => {
  const { page } = await open();
  await page.getByRole("button", { name: "top" }).click();
  // a hole of the peck cycle
  const target = await page.evaluate(() => {
    const { program, backplot } = window.page;
    for (let line = 1; line <= program.lines; line++) {
      if (/G1 G41/.test(program.text(line))) return { line, at: backplot.pixelOf(line) };
    }
  });
  const box = await page.locator("canvas.path").boundingBox();
  await page.mouse.click(box.x + target.at[0], box.y + target.at[1]);
  await equal(() => line(page), target.line, "the block");
  await ok(async () => (await formLine(page)).includes("G[icomp]") || (await formLine(page)).includes("D"), async () => `the form line: ${await formLine(page)}`);
  await ok(async () => /operations\[1\]/.test(await page.locator(".where").innerText()), "the item of the job");
});

test("a click on a block shows its form line, move and item", async ({ open }) => {
  const { page } = await open();
  await page.locator(".ln", { hasText: "T2 M6" }).scrollIntoViewIfNeeded().catch(() => {});
  await page.evaluate(() => {
    const { program } = window.page;
    for (let line = 1; line <= program.lines; line++) if (program.text(line).includes("G82")) window.page.listing.choose(line - 2, [], true);
  });
  await page.locator(".ln", { hasText: "G82" }).click();
  await ok(async () => (await formLine(page)).includes("G82"), () => formLine(page));
  await ok(async () => /operations\[2\].*points\[0\]/.test(await page.locator(".where").innerText()), () => page.locator(".where").innerText());
  await ok(async () => (await page.locator(".state").innerText()).includes("G82"), "the cycle is in force");
});

test("a click on a form line shows the block that it printed", async ({ open }) => {
  const { page } = await open();
  await page.evaluate(() => {
    const { view } = window.page.editor;
    view.dispatch({ effects: [], selection: { anchor: view.state.doc.toString().indexOf("G[retplane] G83") }, scrollIntoView: true });
  });
  await page.locator(".cm-line", { hasText: "G83" }).click();
  await ok(async () => (await chosen(page)).includes("G83"), () => chosen(page));
  await ok(async () => /operations\[/.test(await page.locator(".where").innerText()), "and its item");
});

test("what the state says leads to the block that said it", async ({ open }) => {
  const { page } = await open();
  await page.keyboard.press("End");
  await page.getByRole("region", { name: "State after" }).getByRole("button", { name: /^T\d/ }).click();
  await ok(async () => /T5 M6/.test(await chosen(page)), () => chosen(page));
});

test("keys step by block, tool, item and play", async ({ open }) => {
  const { page } = await open();
  await page.keyboard.press("Home");
  await equal(() => line(page), 1);
  await page.keyboard.press("n");
  await page.keyboard.press("n");
  await page.keyboard.press("p");
  await equal(() => line(page), 2);
  await page.keyboard.press("t");
  await ok(async () => (await chosen(page)).includes("T1 M6"), () => chosen(page));
  await page.keyboard.press("t");
  await ok(async () => (await chosen(page)).includes("T2 M6"), () => chosen(page));
  await page.keyboard.press("Shift+T");
  await ok(async () => (await chosen(page)).includes("T1 M6"), () => chosen(page));
  const before = await page.locator(".where").innerText();
  await page.keyboard.press("i");
  await ok(async () => (await page.locator(".where").innerText()) !== before, "another item");
  const at = await line(page);
  await page.keyboard.press("Space");
  await page.waitForFunction((at) => Number(document.querySelector(".ln.on").getAttribute("data-line")) > at + 3, at);
  await page.keyboard.press("Space");
  await page.keyboard.press("2");
  await equal(() => page.locator(".views [aria-pressed=true]").innerText(), "front");
  await page.keyboard.press("?");
  await ok(() => page.getByRole("dialog", { name: "Keys" }).isVisible(), "the keys are told");
});

test("words that repeat are struck out, with why", async ({ open }) => {
  const { page } = await open();
  await page.evaluate(() => {
    const { program } = window.page;
    for (let line = 1; line <= program.lines; line++) if (program.text(line).includes("G82")) window.page.choose(line + 1, "key");
  });
  const gone = await page.locator(".note s").allInnerTexts();
  await ok(gone.includes("G82") && gone.some((word) => word.startsWith("R.1")) && gone.includes("F6"), gone.join(" "));
  await ok(async () => (await page.locator(".note s").last().getAttribute("title")).includes("said it"), "with the line that said it");
});

test("the first difference is shown in all panes", async ({ open }) => {
  const { page, path } = await open();
  const form = readFileSync(join(path, "my.pf"), "utf8");
  // the peck cycle drills at places that are the job's with X and Y exchanged
  writeFileSync(join(path, "my.pf"), form.replace("G83 X[h] Y[v] Z[d]", "G83 X[v] Y[h] Z[d]"));
  await page.waitForFunction(() => document.querySelector(".verdict").textContent.startsWith("different"), null, { timeout: 20_000 });
  await page.locator(".verdict").click();
  await ok(async () => await page.locator(".ln.on.bad").count() === 1, "chosen and marked in the program");
  await ok(async () => (await formLine(page).catch(() => "")) === "" && (await page.locator(".cm-line.cm-bad").innerText()).includes("G83"), "the form line is the Peck's");
  await ok(async () => /PV\d+/.test(await page.locator(".note").innerText()), () => page.locator(".note").innerText());
  await ok(async () => (await page.locator(".note .help").first().innerText()).length > 10, "with what helps");
});

test("what could stand here is listed, with what it holds, and what a word is", async ({ open }) => {
  const { page } = await open();
  await type(page, "R[vclear] P[dwell] F[frate]", " R[vcl");
  const list = page.locator(".cm-tooltip-autocomplete");
  await list.waitFor();
  await ok(async () => /vclear.*0\.1/s.test(await list.locator("[aria-selected]").innerText()), () => list.innerText());
  // the editor takes an Enter for a line break until the list has stood for a moment
  await page.waitForTimeout(200);
  await page.keyboard.press("Enter");
  await ok(async () => (await page.evaluate(() => window.page.editor.text)).includes("F[frate] R[vclear]"), "taken over whole");
  await page.keyboard.press("Control+z");
  await page.keyboard.press("Escape");
  await page.locator(".cm-line", { hasText: "G81 X[h]" }).first().locator("span", { hasText: "[retplane]" }).hover();
  const known = page.locator(".cm-tooltip .known");
  await known.waitFor();
  await ok(async () => (await known.innerText()).includes("retplane"), () => known.innerText());
});

test("against an old program", async ({ open }) => {
  const path = join(root, "samples/bracket/expected.haas.nc");
  const { page } = await open({ more: ["--against", path] });
  await ok(async () => /against expected.haas.nc: \d+ blocks differ/.test(await page.locator(".beside").innerText()), () => page.locator(".beside").innerText());
  await page.keyboard.press("Home");
  await page.keyboard.press("d");
  await ok(async () => await page.locator(".ln.on.other").count() === 1, "the first change is chosen");
  await ok(async () => (await page.locator(".note").innerText()).includes("before:"), "with what stood there");
  await ok(async () => (await page.locator(".legend").innerText()).includes("before"), "the old path is drawn");
});

test("blocks that only the old program has stand between the lines", async ({ open }) => {
  const path = join(mkdtempSync(join(tmpdir(), "postform-page-old-")), "old.nc");
  const program = readFileSync(join(root, "samples/bracket/expected.fanuc.nc"), "utf8").split("\n");
  const at = program.findIndex((line) => line.includes("G82"));
  writeFileSync(path, [...program.slice(0, at), "M97 (CLAMP)", "M98 (AIR)", ...program.slice(at)].join("\n"));
  const { page } = await open({ more: ["--against", path] });
  await page.evaluate((line) => window.page.choose(line, "key"), at + 1);
  await equal(() => page.locator(".ln.gone").allInnerTexts(), ["−M97 (CLAMP)", "−M98 (AIR)"]);
  const order = await page.locator(".ln").allInnerTexts();
  const gone = order.findIndex((text) => text.includes("CLAMP"));
  await ok(order[gone - 1].endsWith(program[at - 1]) && order[gone + 2].endsWith(program[at]), "where they stood");
  // what is clicked after them is the line that is shown there
  await page.locator(".ln").nth(gone + 3).click();
  await equal(() => line(page), at + 2);
});

test("what changed since the last save is marked, and saved", async ({ open }) => {
  const { page, path } = await open();
  await type(page, "G[unitmode] G17 G40 G49 G80 G90", " G94");
  await page.waitForFunction(() => document.querySelector(".beside").textContent.includes("since the last save"));
  await equal(() => page.locator(".beside").innerText(), "1 block changed since the last save");
  await page.keyboard.press("Control+s");
  await page.waitForFunction(() => document.querySelector(".save").hidden);
  await ok(readFileSync(join(path, "my.pf"), "utf8").includes("G80 G90 G94"), "written");
  await page.waitForFunction(() => document.querySelector(".beside").textContent === "");
  // and what is saved elsewhere comes by itself
  const form = readFileSync(join(path, "my.pf"), "utf8");
  writeFileSync(join(path, "my.pf"), form.replace("G80 G90 G94", "G80 G90"));
  await page.waitForFunction(() => !window.page.editor.text.includes("G94"), null, { timeout: 20_000 });
});

test("until the very text is checked nothing is called proven", async ({ open }) => {
  const { page } = await open({ more: ["--job", "bracket.json"] });
  const tabs = page.locator(".tabs .tab span");
  await page.waitForFunction(() => document.querySelectorAll(".tabs .tab span.ok").length === 2);
  let answer = () => {};
  await page.route("**/scene", async (route) => {
    await new Promise((done) => (answer = done));
    // the page may have asked for it no more
    await route.continue().catch(() => {});
  });
  await type(page, "Machine Mill", " # a").catch(() => {});
  const shown = () => page.evaluate(() => {
    const verdict = document.querySelector(".verdict");
    return [verdict.textContent, verdict.classList.contains("ok"), document.body.classList.contains("pending")].join();
  });
  await equal(() => shown(), "checking…,false,true", "while it is checked");
  await equal(() => tabs.evaluateAll((all) => all.filter((mark) => mark.classList.contains("ok")).length), 0, "and in the tabs");
  // a key more: the answer that comes is about the text before it
  await page.evaluate(() => {
    const { view } = window.page.editor;
    const at = view.state.doc.toString().indexOf("# a") + 3;
    view.dispatch({ changes: { from: at, insert: "b" } });
  });
  const first = answer;
  first();
  await page.waitForTimeout(500);
  await equal(() => shown(), "checking…,false,true", "the answer about the text before");
  await page.unroute("**/scene");
  answer();
  await page.waitForFunction(() => document.querySelector(".verdict").textContent.startsWith("proven"));
  await equal(() => page.evaluate(() => document.body.classList.contains("pending")), false, "checked");
});

test("a server that is gone leaves no verdict, and keeps what was typed", async ({ open }) => {
  const { page, end } = await open();
  await type(page, "Machine Mill", " # mine");
  end();
  await page.waitForFunction(() => document.querySelector(".verdict").textContent === "not checked", null, { timeout: 20_000 });
  await equal(() => page.locator(".verdict.ok").count(), 0, "nothing is green");
  const banner = page.locator(".banner");
  await ok(async () => (await banner.innerText()).startsWith("Not checked: "), () => banner.innerText());
  for (const name of ["try again", "copy what was typed"]) await ok(() => banner.getByRole("button", { name }).isVisible(), name);
  await page.evaluate(() => {
    const { view } = window.page.editor;
    view.dispatch({ changes: { from: 0, insert: "# more\n" } });
  });
  await page.waitForTimeout(300);
  await equal(() => page.locator(".verdict").innerText(), "not checked", "a key later, too");
  await ok(async () => (await page.evaluate(() => window.page.editor.text)).startsWith("# more\n"), "and what is typed stays");
});

test("a form that is deleted on the disk leaves no verdict", async ({ open }) => {
  const { page, path } = await open();
  unlinkSync(join(path, "my.pf"));
  await page.waitForFunction(() => !document.querySelector(".verdict").classList.contains("ok"), null, { timeout: 20_000 });
  await ok(async () => (await page.evaluate(() => window.page.editor.text)).includes("1stToolChange"), "what was there stays");
});

test("what was typed stays where the form gets another file", async ({ open }) => {
  const { page, path } = await open();
  writeFileSync(join(path, "mine.toml"), 'name = "mine"\nlike = "fanuc"\n');
  await type(page, "Machine Mill", " # mine");
  await page.evaluate(() => {
    const { view } = window.page.editor;
    const at = view.state.doc.toString().indexOf("Control fanuc");
    view.dispatch({ changes: { from: at, to: at + "Control fanuc".length, insert: "Control mine.toml" } });
  });
  await page.waitForTimeout(300);
  await ready(page);
  const text = () => page.evaluate(() => window.page.editor.text);
  await ok(async () => (await text()).includes("Machine Mill # mine"), "what was typed before");
  await type(page, "Machine Mill # mine", "!");
  await ok(async () => (await text()).includes("# mine!"), "and behind it");
  // a file that only what is typed names is looked at, too
  writeFileSync(join(path, "mine.toml"), 'name = "mine"\nlike = "nothing"\n');
  await page.waitForFunction(() => document.querySelectorAll(".files [role=tab]").length === 2, null, { timeout: 20_000 });
  await ok(async () => (await page.locator(".lint").innerText()).includes("nothing"), "what is wrong with it is said");
  await ok(async () => (await text()).includes("# mine!"), "and what was typed is there");
  await page.evaluate(() => window.page.editor.view.focus());
  for (let undo = 0; undo < 12; undo++) await page.keyboard.press("Control+z");
  await ok(async () => !(await text()).includes("# mine"), "and it can be undone");
});

test("a save does not write over what somebody else has saved", async ({ open }) => {
  const { page, path } = await open();
  await type(page, "Machine Mill", " # mine");
  const theirs = readFileSync(join(path, "my.pf"), "utf8") + "# theirs\n";
  writeFileSync(join(path, "my.pf"), theirs);
  const banner = page.locator(".banner");
  await banner.waitFor({ timeout: 20_000 });
  await page.keyboard.press("Control+s");
  await page.waitForTimeout(300);
  await equal(readFileSync(join(path, "my.pf"), "utf8"), theirs, "not unasked");
  await banner.getByRole("button", { name: "keep mine" }).click();
  await page.locator(".cm-content").focus();
  await page.keyboard.press("Control+s");
  await page.waitForFunction(() => document.querySelector(".save").hidden);
  await ok(readFileSync(join(path, "my.pf"), "utf8").includes("# mine"), "but when it was chosen");
});

test("a word that is typed in full is itself, and Esc leaves the form only twice", async ({ open }) => {
  const { page } = await open();
  await type(page, "MoveHome\nG91 G28 Z0\nG90\nEnd\n", "\nStop");
  const list = page.locator(".cm-tooltip-autocomplete");
  await list.waitFor();
  await ok(async () => (await list.locator("[aria-selected]").innerText()).startsWith("Stop"), () => list.innerText());
  await ok(async () => !(await list.locator("[aria-selected]").innerText()).startsWith("StopCode"), "no other word");
  await page.keyboard.press("Escape");
  await page.keyboard.type("x");
  await ok(async () => (await page.evaluate(() => window.page.editor.text)).includes("\nStopx"), "a list is closed, and typing goes on");
  await page.keyboard.press("Backspace");
  await page.keyboard.press("Escape");
  await page.keyboard.press("Escape");
  await page.keyboard.press("Escape");
  await equal(() => page.evaluate(() => document.activeElement.getAttribute("aria-label")), "Program");
});

test("a job that can't be printed says what, where and what helps", async ({ open }) => {
  const { page, path } = await open();
  const job = readFileSync(join(path, "bracket.json"), "utf8");
  // replaced as a whole: the server must not read the file between its truncation and its text
  writeFileSync(join(path, "bracket.new"), job.replace('"tool": 1', '"tool": 77'));
  renameSync(join(path, "bracket.new"), join(path, "bracket.json"));
  await page.waitForFunction(() => document.querySelector(".verdict").textContent.startsWith("no program"), null, { timeout: 20_000 });
  const note = await page.locator(".note").innerText();
  await ok(note.includes("PJ006") && note.includes("operations[0]") && note.includes("add the tool to"), note);
});

test("jobs are tabs with their verdicts", async ({ open }) => {
  const { page } = await open({ more: ["--job", join(root, "samples/drill-machine/job.json")] });
  await page.waitForFunction(() => [...document.querySelectorAll(".tab span")].every((mark) => mark.textContent));
  await equal(() => page.locator(".tab").count(), 2);
  await page.getByRole("tab", { name: /drill-machine/ }).click();
  await page.waitForTimeout(100);
  await ready(page);
  await ok(async () => (await page.title()).includes("job.json"), () => page.title());
});

test("at two widths, light and dark", async ({ open }) => {
  for (const width of [1280, 1920]) {
    for (const colorScheme of ["light", "dark"]) {
      const { page } = await open({ viewport: { width, height: 900 }, colorScheme });
      const sizes = await page.evaluate(() => ({
        wide: document.documentElement.scrollWidth, high: document.documentElement.scrollHeight,
        panes: [...document.querySelectorAll("section")].map((pane) => pane.getBoundingClientRect().width),
        dark: getComputedStyle(document.body).backgroundColor,
      }));
      await equal([sizes.wide, sizes.high], [width, 900], "nothing is cut off or scrolls");
      await ok(sizes.panes.length === 3 && sizes.panes.every((pane) => pane >= 270), String(sizes.panes));
      await equal(sizes.dark === "rgb(21, 23, 26)", colorScheme === "dark");
    }
  }
});

test("everything has a name for a screen reader", async ({ open }) => {
  const { page } = await open();
  const nameless = await page.evaluate(() =>
    [...document.querySelectorAll("button, canvas, section, [role], [tabindex]")]
      .filter((found) => !found.closest("[aria-hidden=true], .cm-editor") && !found.hidden)
      .filter((found) => !(found.getAttribute("aria-label") || found.title || found.textContent.trim()))
      .map((found) => found.outerHTML.slice(0, 100)));
  await equal(nameless.filter((html) => !html.includes("lint") && !html.includes('role="alert"')), []);
  const path = page.getByRole("img", { name: /Backplot: \d+ moves, 20 holes, 5 tools/ });
  await ok(() => path.isVisible(), "the path is told in words");
  const list = page.getByRole("listbox", { name: "Program" });
  const active = await list.getAttribute("aria-activedescendant");
  await ok(async () => await page.locator(`#${active}[role=option][aria-selected=true]`).count() === 1, "the chosen block is told");
  await ok(async () => (await page.getByRole("textbox", { name: "Form" }).count()) === 1, "the form is a field with a name");
});

test("WebGL2 and a plain canvas draw the same", async ({ browser, open }) => {
  const { address } = await open();
  // a browser without a GPU has a WebGL2 by software, which is slower than a plain canvas, and is only asked for here
  const draws = async (by) => {
    const page = await browser.newPage({ viewport: { width: 1280, height: 800 } });
    await page.addInitScript((by) => {
      const get = HTMLCanvasElement.prototype.getContext;
      HTMLCanvasElement.prototype.getContext = function (kind, options) {
        if (kind !== "webgl2") return get.call(this, kind, options);
        return by === "WebGL2" ? get.call(this, kind, { ...options, preserveDrawingBuffer: true }) : null;
      };
      const name = WebGL2RenderingContext.prototype.getParameter;
      WebGL2RenderingContext.prototype.getParameter = function (of) {
        return of === 0x9246 || of === 0x1f01 ? "a GPU" : name.call(this, of);
      };
    }, by);
    await page.goto(address);
    await ready(page);
    await equal(() => page.evaluate(() => window.page.backplot.drawsBy), by);
    const inked = await page.evaluate(() => {
      // the lines alone: a plain canvas has the ground, too
      Object.assign(window.page.backplot.painter, { ground: null });
      window.page.backplot.draw();
      const from = document.querySelector("canvas.path");
      const to = Object.assign(document.createElement("canvas"), { width: from.width, height: from.height }).getContext("2d");
      to.drawImage(from, 0, 0);
      const { data } = to.getImageData(0, 0, from.width, from.height);
      const cells = new Set();
      for (let i = 3; i < data.length; i += 4) {
        if (data[i] > 60) cells.add(`${Math.floor(((i >> 2) % from.width) / 8)} ${Math.floor((i >> 2) / from.width / 8)}`);
      }
      return [...cells];
    });
    await page.close();
    return new Set(inked);
  };
  const [gl, plain] = [await draws("WebGL2"), await draws("canvas")];
  const both = [...gl].filter((cell) => plain.has(cell)).length;
  await ok(both > 100 && both > 0.9 * Math.max(gl.size, plain.size), `${gl.size} and ${plain.size} cells with ink, ${both} of them the same`);
});

test("of a long path a coarse picture is drawn while it is turned, and a fine one at rest", async ({ open }) => {
  const { page } = await open({ moves: 60_000 });
  await page.waitForFunction(() => window.page.backplot.frames.pieces > 50_000);
  await page.evaluate(() => {
    const { backplot } = window.page;
    const draw = backplot.draw.bind(backplot);
    window.least = Infinity;
    backplot.draw = () => {
      draw();
      window.least = Math.min(window.least, backplot.frames.pieces);
    };
  });
  const box = await page.locator("canvas.path").boundingBox();
  await page.mouse.move(box.x + 200, box.y + 200);
  await page.mouse.down();
  await page.mouse.move(box.x + 260, box.y + 220, { steps: 4 });
  await page.mouse.up();
  await page.waitForFunction(() => window.least < 26_000);
  await page.waitForFunction(() => window.page.backplot.frames.pieces > 50_000);
  await ok(async () => (await page.locator(".verdict").innerText()).startsWith("proven"), "the verdict came behind the picture");
});

test("a machine says whether the program fits, and how long it takes", async ({ open }) => {
  const machine = join(root, "samples/bracket/vf2.toml");
  const { page, path } = await open({ form: "postforms/haas.pf", more: ["--machine", machine] });
  const fit = page.locator(".fit");
  await page.waitForFunction(() => document.querySelector(".fit").textContent.startsWith("fits VF-2 north, 2 warnings · "));
  await fit.click();
  const note = await page.locator(".note").innerText();
  for (const part of ["PM015: the machine's table has no length H5", "G55 X lies between -31.5 and -1.5", "tool changes 0:21", "not checked: cutter compensation"]) {
    await ok(note.includes(part), `${part} in ${note}`);
  }
  await ok(async () => (await page.locator(".verdict").innerText()).startsWith("proven"), "whether it is what the job asks for is another question");
  // the timeline counts in the machine's times
  const clock = await page.evaluate(() => {
    const { path } = window.page.program;
    return { total: window.page.timeline.total, timed: path.isTimed, rises: path.moveTime.every((time, i, all) => i === 0 || time >= all[i - 1]), text: document.querySelector(".timeline .clock").textContent };
  });
  await ok(clock.timed && clock.rises && Math.abs(clock.total - 240) < 1.5 && clock.text.endsWith("4:00"), JSON.stringify(clock));
  // a form may name its machine, and one that is wrong is said
  writeFileSync(join(path, "own.toml"), 'control = "haas"\nunits = "inch"\n[axes.X]\ntravel = [0, -30]\n');
  const served = await watch(path);
  const other = await page.context().newPage();
  await other.goto(served.address);
  await ready(other);
  await ok(() => other.locator(".fit").isHidden(), "no machine, nothing said");
  await type(other, "Control haas", "\nMachineFile own.toml");
  await other.waitForFunction(() => document.querySelector(".lint").textContent.includes("the travel of X goes from 0 to -30"));
  writeFileSync(join(path, "own.toml"), 'control = "haas"\nunits = "inch"\n[axes.X]\ntravel = [-14, 0]\n[offsets]\nG54 = [-14, 0, 0]\n');
  await type(other, "MachineFile own.toml", " ");
  await other.waitForFunction(() => document.querySelector(".fit").textContent.startsWith("does not fit"));
  await ok(async () => (await other.evaluate(() => [...window.page.marks.bad.values()].map((mark) => mark.text).join())).includes("PM001: T1 needs X-14.5"), "its block is marked");
  await other.close();
  served.end();
});

test("jobs are opened in tabs and closed again", async ({ open }) => {
  const { page, address } = await open({ form: "postforms/haas.pf" });
  const other = await page.context().newPage();
  await other.goto(address);
  await ready(other);
  const tabs = (of = page) => of.getByRole("tab").allInnerTexts();
  await ok(async () => (await tabs()).length === 1 && (await page.getByTitle("Close this job").isHidden()), "one job can't be closed");
  const choose = (...files) => page.locator('header input[type="file"]').setInputFiles(files);
  await choose(join(root, "samples/drill-machine/job.json"), join(root, "samples/bracket/job.json"));
  // both are named job.json: the second replaced the first, and is shown
  await page.waitForFunction(() => window.page.program?.lines > 90 && document.querySelectorAll(".tab")[1]?.getAttribute("aria-selected") === "true");
  await page.waitForFunction(() => [...document.querySelectorAll(".tab")].every((tab) => tab.textContent.endsWith("✓")));
  await ok(async () => (await tabs()).length === 2, async () => `${await tabs()}`);
  await ok(async () => (await page.locator(".banner").innerText()).includes("job.json: an opened job of the same name was replaced"), "which is said");
  // another page of the same server has the tab, too
  await other.waitForFunction(() => document.querySelectorAll(".tab").length === 2 && document.querySelectorAll(".tab")[1].textContent.endsWith("✓"));
  await ok(async () => (await other.getByRole("tab").nth(0).getAttribute("aria-selected")) === "true", "which still shows its own job");
  // what is no job is named, and opens no tab
  const path = mkdtempSync(join(tmpdir(), "postform-"));
  writeFileSync(join(path, "photo.json"), Buffer.from([0x89, 0x50, 0x4e, 0x47, 0, 1, 2]));
  writeFileSync(join(path, "letter.txt"), "Dear customer");
  await choose(join(path, "letter.txt"));
  await page.waitForFunction(() => document.querySelector(".banner").textContent.includes("letter.txt was not opened: the format of letter.txt is unknown"));
  await choose(join(path, "photo.json"));
  await page.waitForFunction(() => document.querySelectorAll(".tab").length === 3 && /no program/.test(document.querySelector(".verdict").textContent));
  await page.getByTitle("Close this job").click();
  await page.waitForFunction(() => document.querySelectorAll(".tab").length === 2 && document.querySelector(".verdict").textContent.startsWith("proven"));
  // a tab that another page closed
  await other.getByRole("tab").nth(1).click();
  await other.waitForFunction(() => document.querySelectorAll(".tab")[1].getAttribute("aria-selected") === "true" && document.querySelector(".verdict").textContent.startsWith("proven"));
  await page.getByTitle("Close this job").click();
  await other.waitForFunction(() => document.querySelectorAll(".tab").length === 1 && document.querySelector(".verdict").textContent.startsWith("proven"));
  await ok(() => page.getByTitle("Close this job").isHidden(), "the last one stays");
});

test("each kind of machine has its picture", async ({ open }) => {
  for (const [form, job, words] of [
    ["haas-lathe", "lathe-part", ["X", "Z"]],
    ["fanuc-lathe", "lathe-part", ["X", "Z"]],
    ["wire-edm", "wire", ["U15", "V9.5"]],
    ["haas-4axis", "four-axis", ["A720"]],
    ["plasma", "plasma", ["X", "Y"]],
    ["heidenhain", "bracket", ["X", "Z"]],
  ]) {
    const { page } = await open({ form: `postforms/${form}.pf`, job: `samples/${job}/job.json` });
    const moves = await page.evaluate(() => window.page.program.path?.moves ?? 0);
    await ok(moves > 5, `${form}: ${moves} moves`);
    await ok(async () => /proven/.test(await page.locator(".verdict").innerText()), async () => `${form}: ${await page.locator(".verdict").innerText()}`);
    const shown = await page.evaluate(() => {
      const all = [];
      for (let line = 1; line <= window.page.program.lines; line++) {
        window.page.choose(line, "key");
        all.push(document.querySelector(".state [aria-label=position]")?.innerText ?? "");
      }
      return all.join("\n");
    });
    for (const word of words) await ok(shown.includes(word), `${form}: no ${word} among the positions`);
  }
});

test("a rotary axis turns the points about it", async ({ open }) => {
  const { page } = await open({ form: "postforms/haas-4axis.pf", job: "samples/four-axis/job.json" });
  const tops = await page.evaluate(() => {
    const { path } = window.page.program;
    return Array.from({ length: path.holeLine.length }, (_, hole) => [...path.holes.subarray(hole * 6, hole * 6 + 3)].map((value, axis) => Math.round((value + path.head.middle[axis]) * 1000) / 1000));
  });
  // the two holes at A0 are drilled from above, those at A90 from the side that is turned up
  await equal(tops, [[1, 0, 1.1], [2, 0, 1.1], [1, -1.1, 0], [2, -1.1, 0]]);
});

test("a page that is loaded again and again finds a connection", async ({ open }) => {
  const { page } = await open();
  for (let i = 0; i < 80; i++) await page.reload({ waitUntil: "domcontentloaded" });
  await ready(page);
  await ok(async () => (await page.locator(".verdict").innerText()).startsWith("proven"), "served");
});

test("a page that is hidden holds no connection, and asks again when it is seen", async ({ open }) => {
  const { page, path } = await open();
  const hide = (hidden) => page.evaluate((hidden) => {
    Object.defineProperty(document, "hidden", { value: hidden, configurable: true });
    document.dispatchEvent(new Event("visibilitychange"));
  }, hidden);
  await hide(true);
  const form = readFileSync(join(path, "my.pf"), "utf8");
  writeFileSync(join(path, "my.pf"), form.replace("Name Fanuc 0i-M", "Name Other"));
  await page.waitForTimeout(1500);
  await ok(async () => !(await page.evaluate(() => window.page.editor.text)).includes("Name Other"), "it is not told");
  await hide(false);
  await page.waitForFunction(() => window.page.editor.text.includes("Name Other"));
});

test("a server that is started again is joined again, and what was typed is kept", async ({ open }) => {
  const { page, address, end, start } = await open();
  await type(page, "Name ", "My ");
  end();
  await page.waitForFunction(() => document.querySelector(".verdict").textContent === "not checked");
  const again = await start();
  await equal(again.address, address, "the same address");
  await page.waitForFunction(() => document.querySelector(".verdict").textContent.startsWith("proven"), null, { timeout: 30_000 });
  await ok(async () => (await page.evaluate(() => window.page.editor.text)).includes("Name My "), "typed text is there");
});

test("a form that was deleted is written again", async ({ open }) => {
  const { page, path } = await open();
  const form = join(path, "my.pf");
  const before = readFileSync(form, "utf8");
  unlinkSync(form);
  await page.getByRole("button", { name: "write it again" }).click();
  await page.waitForFunction(() => document.querySelector(".verdict").textContent.startsWith("proven"));
  await equal(readFileSync(form, "utf8"), before);
});

test("a job that is not there is a tab with its error", async ({ open }) => {
  const { page } = await open({ more: ["--job", "gone.json"] });
  await ok(async () => (await page.locator(".verdict").innerText()).startsWith("proven"), "the other job is shown");
  await page.locator(".tab", { hasText: "gone" }).click();
  await page.waitForFunction(() => document.querySelector(".verdict").textContent.includes("can't read gone.json"));
  await ok(async () => (await page.evaluate(() => window.page.editor.text)).length > 100, "the form is there");
});

test("keys act on the panes after a click on a button, and Tab leaves a form that was only looked at", async ({ open }) => {
  const { page } = await open();
  await page.getByRole("button", { name: "top" }).click();
  await page.keyboard.press("Home");
  await page.keyboard.press("Space");
  await page.waitForFunction(() => Number(document.querySelector(".ln.on").getAttribute("data-line")) > 3);
  await page.keyboard.press("Space");
  const text = await page.evaluate(() => window.page.editor.text);
  await page.locator(".cm-line").nth(3).click();
  await page.keyboard.press("Tab");
  await ok(async () => !(await page.evaluate(() => window.page.editor.hasFocus)), "Tab goes on");
  await equal(() => page.evaluate(() => window.page.editor.text), text, "and writes nothing");
  await page.locator(".cm-line").nth(3).click();
  await page.keyboard.type("x");
  await page.keyboard.press("Tab");
  await ok(() => page.evaluate(() => window.page.editor.hasFocus), "after typing it indents");
});

test("colours show the tool, the operation, Z or the feed, and deep cuts fade", async ({ open }) => {
  const { page } = await open();
  const seen = async (meaning) => {
    await page.locator("[aria-label='Colours show']").selectOption(meaning);
    return page.evaluate(() => {
      const { kinds } = window.page.backplot;
      const of = (byte) => new Set(Array.from({ length: kinds.length / 4 }, (_, i) => i).filter((i) => [1, 2].includes(kinds[i * 4])).map((i) => kinds[i * 4 + byte])).size;
      return { colours: of(2), shades: of(3), legend: document.querySelector(".legend").innerText.replaceAll("\n", " ") };
    });
  };
  const tool = await seen("tool");
  await ok(tool.colours === 5 && tool.shades > 4 && /T1.*T5/.test(tool.legend), JSON.stringify(tool));
  const operation = await seen("operation");
  await ok(operation.colours > 5 && /operation 1/.test(operation.legend), JSON.stringify(operation));
  const height = await seen("Z");
  await ok(height.colours > 4 && height.shades === 1 && /Z -0.8.* 0.* inch/.test(height.legend), JSON.stringify(height));
  const feed = await seen("feed");
  await ok(feed.colours > 2 && /feed 4 .*24/.test(feed.legend), JSON.stringify(feed));
});

test("a rapid that is made again is drawn once", async ({ open }) => {
  const { page, path } = await open();
  const path_ = [[0, 0, 5], [9, 0, 5], [0, 0, 5], [9, 0, 5]].map((rapid) => ({ rapid }));
  const tools = [{ number: 1, diameter: 6 }];
  const operation = { tool: 1, work: 54, spindle: { speed: 900, direction: "cw" }, feed: 100, path: [...path_, { line: [9, 0, 0] }] };
  writeFileSync(join(path, "bracket.json"), JSON.stringify({ postform: 1, program: 1, units: "mm", tools, operations: [operation] }));
  await page.waitForFunction(() => window.page.program?.path?.head.units === "mm");
  const kinds = await page.evaluate(() => Array.from(window.page.backplot.kinds).filter((_, at) => at % 4 === 0));
  await ok(kinds.join().includes("0,0,4,4,1"), `two of them are repeats: ${kinds}`);
});

test("the distance between two points", async ({ open }) => {
  const { page } = await open();
  await page.getByRole("button", { name: "top" }).click();
  await page.getByRole("button", { name: "measure" }).click();
  await ok(async () => /first point/.test(await page.locator(".told-here").innerText()), "what to click");
  const box = await page.locator("canvas.path").boundingBox();
  const ends = await page.evaluate(() => {
    const { program, backplot } = window.page;
    const line = Array.from({ length: program.lines }, (_, i) => i + 1).find((line) => program.text(line).includes("N400 Y2.5"));
    const [from, to] = program.moves(line);
    const { points, first } = program.path;
    return [first[from], first[to]].map((point) => backplot.camera.project(points, point * 3));
  });
  // a little inside the move, so that its own ends are the nearest
  const [[ax, ay], [bx, by]] = ends;
  for (const share of [0.05, 0.95]) await page.mouse.click(box.x + ax + (bx - ax) * share, box.y + ay + (by - ay) * share);
  await ok(async () => /distance 2.75 inch · X 0 Y -?2.75 Z 0/.test(await page.locator(".told-here").innerText()), () => page.locator(".told-here").innerText());
});

test("the timeline plays the program in its time", async ({ open }) => {
  const { page } = await open();
  await equal(() => page.locator(".clock").innerText().then((text) => text.split(" / ")[1]), "3:30", "the time of the program");
  await equal(() => page.locator(".timeline .marks i").count(), 4, "a mark for each tool change");
  await page.getByLabel("Time", { exact: true }).fill("5000");
  const half = await page.evaluate(() => ({ time: window.page.timeline.time, line: window.page.line, cursor: window.page.backplot.cursor.point }));
  await ok(Math.abs(half.time - 105) < 1 && half.line > 40 && half.cursor > 10, JSON.stringify(half));
  // a slice of the times by hand: the seconds of a cut are its length by its feed
  const cut = await page.evaluate(() => {
    const { program } = window.page;
    const line = Array.from({ length: program.lines }, (_, i) => i + 1).find((line) => program.text(line).includes("N410 X3."));
    const [move] = program.moves(line);
    return program.path.moveTime[move] - program.path.moveTime[move - 1];
  });
  await ok(Math.abs(cut - (3 / 18) * 60) < 0.01, `3 inches at 18 inches a minute: ${cut}`);
  await page.getByLabel("Time", { exact: true }).fill("9900");
  await page.getByRole("button", { name: "▶" }).click();
  await page.waitForFunction(() => !window.page.timeline.isPlaying && window.page.line === window.page.program.lines);
  await equal(() => page.evaluate(() => window.page.backplot.cursor), null, "all of it is shown again");
});

test("the tools cut the stock, and a rapid through a block of a known size is marked", async ({ open }) => {
  const { page, path } = await open();
  await page.getByRole("button", { name: "stock" }).click();
  await page.waitForFunction(() => window.page.backplot.stock);
  await page.waitForTimeout(500);
  const heights = (places) => page.evaluate((places) => {
    const { stock } = window.page.backplot;
    const { middle } = window.page.program.path.head;
    return places.map(([x, y]) => {
      const [column, row] = [Math.round((x - middle[0] - stock.x) / stock.cell), Math.round((y - middle[1] - stock.y) / stock.cell)];
      return Math.round((stock.heights[row * stock.wide + column] + middle[2]) * 1000) / 1000;
    });
  }, places);
  // the floor of the pocket, the top of the part between two holes, the contour's floor beside the part (its radius is compensated)
  await equal(() => heights([[2, 1.25], [0.9, 2.2], [-0.2, 1.25], [0.06, 1.25]]), [-0.25, 0, -0.5, 0]);
  await equal(() => page.locator(".ln.bad").count(), 0, "no size is known: nothing is called wrong");
  const field = page.getByLabel("X from");
  await field.fill("-1");
  await field.blur();
  await page.waitForFunction(() => window.page.marks.bad.size > 0);
  const bad = await page.evaluate(() => [...window.page.marks.bad].map(([line, { text }]) => [window.page.program.text(line), text]));
  await ok(bad.length === 1 && bad[0][0].includes("Z-.5") && /rapid goes through stock/.test(bad[0][1]), JSON.stringify(bad));
  await field.fill("0");
  await page.getByLabel("Y from").fill("0");
  await page.getByLabel("Y from").blur();
  await page.waitForFunction(() => window.page.marks.bad.size === 0);
  // verify, which has code of its own, finds the same rapids; from G55 on it has a block of its own, which the page draws over the first
  const [least, greatest, top] = [-0.3, 4, 0.3];
  for (const [name, value] of [["X from", least], ["X to", greatest], ["Y from", least], ["Y to", greatest], ["Z top", top]]) {
    await page.getByLabel(name).fill(String(value));
    await page.getByLabel(name).blur();
  }
  const stock = `X${least}..${greatest} Y${least}..${greatest} Z${top}`;
  const verified = spawnSync(postform, ["verify", "bracket.json", "--form", "my.pf", "--format", "json", "--stock", stock], { cwd: path, encoding: "utf8" });
  const other = await page.evaluate(() => Array.from({ length: window.page.program.lines }, (_, i) => i + 1).find((line) => window.page.program.text(line).includes("G55 G0")));
  const expected = JSON.parse(verified.stdout).stock.findings.map((found) => found.program_line).filter((line) => line < other);
  await ok(expected.length > 5, `${expected}`);
  await page.waitForFunction(([expected, other]) => String([...window.page.marks.bad.keys()].filter((line) => line < other).sort((a, b) => a - b)) === String(expected), [expected, other]);
});

test("words are found in the program, and the program is copied", async ({ open }) => {
  const { page } = await open();
  await page.keyboard.press("Home");
  await page.keyboard.press("/");
  await page.keyboard.type("g82");
  await page.keyboard.press("Enter");
  const first = await line(page);
  await ok(async () => (await chosen(page)).includes("G82"), () => chosen(page));
  await page.keyboard.press("Shift+Enter");
  await ok(async () => (await chosen(page)).includes("G82"), "round the end");
  await page.locator(".find input").fill("NOWHERE");
  await page.keyboard.press("Enter");
  await ok(async () => /not in the program/.test(await page.locator(".find").innerText()), "said");
  await page.keyboard.press("Escape");
  await ok(async () => first > 1 && !(await page.locator(".find").isVisible()), "closed");
  await page.evaluate(() => (navigator.clipboard.writeText = async (text) => void (window.copied = text)));
  await page.getByRole("button", { name: "copy" }).click();
  await equal(() => page.evaluate(() => window.copied === window.page.program.all()), true);
});

test("a block shows the formats and commands that decide on its words", async ({ open }) => {
  const { page } = await open();
  await page.evaluate(() => window.page.choose(41, "key"));
  const shown = await page.locator(".decided button").allInnerTexts();
  for (const text of ["F >5.>4", "X->4.>4", "Sequence#s N 10 10"]) await ok(shown.includes(text), `${text}: ${shown}`);
  await page.locator(".decided button", { hasText: "F >5.>4" }).click();
  await equal(() => page.evaluate(() => window.page.editor.view.state.doc.lineAt(window.page.editor.view.state.selection.main.head).text), "F >5.>4");
});

test("properties are set live and not written", async ({ open }) => {
  const { page, path } = await open();
  const before = readFileSync(join(path, "my.pf"), "utf8");
  await ok(async () => (await page.evaluate(() => window.page.program.all())).includes("END MILL"), "a comment");
  await page.getByRole("button", { name: "properties" }).click();
  await page.getByLabel("Comments with part, tools, operations and extents").selectOption("no");
  await page.waitForFunction(() => !window.page.running && window.page.program && !window.page.program.all().includes("END MILL"));
  await ok(async () => /proven/.test(await page.locator(".verdict").innerText()), "and proven");
  await equal(readFileSync(join(path, "my.pf"), "utf8"), before);
});

test("an empty form begins with a post of the kit", async ({ open }) => {
  const { page, path } = await open();
  await page.evaluate(() => window.page.editor.type(""));
  const kit = page.getByRole("group", { name: "Begin with a post" });
  await kit.waitFor();
  await kit.getByLabel("Units").selectOption("inch");
  await kit.getByRole("button", { name: /^haas Haas VF$/ }).click();
  await page.waitForFunction(() => document.querySelector(".verdict").textContent.startsWith("proven"));
  await ok(async () => (await page.evaluate(() => window.page.editor.text)).includes("Units inch"), "in its units");
  await ok(async () => !(await kit.isVisible()) && readFileSync(join(path, "my.pf"), "utf8").includes("Fanuc"), "nothing is written before it is saved");
});

test("panes are as wide as they are dragged, and hidden", async ({ open }) => {
  const { page } = await open();
  const widths = () => page.evaluate(() => [...document.querySelectorAll("main > section")].map((pane) => Math.round(pane.getBoundingClientRect().width)));
  const before = await widths();
  const handle = page.getByRole("separator").first();
  const box = await handle.boundingBox();
  await page.mouse.move(box.x + 2, 400);
  await page.mouse.down();
  await page.mouse.move(box.x - 150, 400, { steps: 5 });
  await page.mouse.up();
  const dragged = await widths();
  await ok(Math.abs(dragged[0] - before[0] + 150) < 6 && dragged[2] === before[2], `${before} ${dragged}`);
  await page.reload();
  await ready(page);
  await equal(() => widths(), dragged, "kept");
  await handle.focus();
  for (let i = 0; i < 20; i++) await page.keyboard.press("ArrowLeft");
  await equal(async () => (await widths())[0], 0, "hidden");
  await handle.dblclick();
  await equal(() => widths(), before, "as it was");
});

test("a page of 640 pixels is usable", async ({ open }) => {
  const { page } = await open({ viewport: { width: 640, height: 900 } });
  const wide = await page.evaluate(() => document.documentElement.scrollWidth);
  await ok(wide <= 640, `nothing is cut off: ${wide}`);
  for (const pane of ["Form", "Program", "Path"]) await ok(async () => (await page.getByRole("region", { name: pane, exact: true }).boundingBox()).height > 150, pane);
});

test("axe finds nothing, in light and dark, with everything open, and in an empty form", async ({ open }) => {
  const axe = readFileSync(join(root, "page/node_modules/axe-core/axe.min.js"), "utf8");
  for (const colorScheme of ["light", "dark"]) {
    const { page } = await open({ colorScheme });
    const findings = async () => {
      await page.evaluate(axe);
      return page.evaluate(async () => (await window.axe.run(document)).violations.map(({ id, nodes }) => `${id}: ${nodes[0].html}`));
    };
    await equal(() => findings(), [], `${colorScheme}, as it opens`);
    await page.getByRole("button", { name: "properties" }).click();
    await page.getByRole("button", { name: "stock" }).click();
    await page.keyboard.press("/");
    await equal(() => findings(), [], `${colorScheme}, with all panels`);
    await page.evaluate(() => window.page.editor.type(""));
    await page.getByRole("group", { name: "Begin with a post" }).waitFor();
    await equal(() => findings(), [], `${colorScheme}, an empty form`);
  }
});

test("what a first user met: keys after a click on a block, one save for a key, a misspelt name, the time of a block without a move", async ({ open }) => {
  const { page } = await open();
  const before = await page.evaluate(() => window.page.editor.text);
  await page.locator(".cm-line").nth(2).click();
  await page.locator(".ln").nth(2).click();
  await page.keyboard.type("nn");
  await equal(() => page.evaluate(() => window.page.editor.text), before, "letters are keys of the page");
  // a name that is nearly right is written by a button
  await type(page, "\nG1 G[side] D[dcomp] X[h] Y[v] F[frat", "", ["Delete"]);
  await page.waitForFunction(() => document.body.classList.contains("stale"));
  await page.locator(".cm-lintRange-error").first().hover();
  await page.locator(".cm-tooltip-lint").getByRole("button", { name: "write `frate`" }).click();
  await page.waitForFunction(() => document.querySelector(".verdict").textContent.startsWith("proven"));
  await equal(() => page.evaluate(() => window.page.editor.text), before);
  // one key, one save
  await type(page, "Name ", "My ");
  let saves = 0;
  page.on("request", (request) => (saves += request.url().endsWith("/save") ? 1 : 0));
  await page.keyboard.press("Control+s");
  await page.waitForTimeout(400);
  await equal(async () => [saves, await page.locator(".banner").isVisible()], [1, false]);
  // the time of a block without a move is that of the move before it
  const times = await page.evaluate(() => {
    const { program, timeline } = window.page;
    const line = Array.from({ length: program.lines }, (_, i) => i + 1).find((line) => /T5 M6/.test(program.text(line)));
    const at = (line) => (window.page.choose(line, "key"), timeline.time);
    return [at(1), at(line) > at(line - 20), at(program.lines) === timeline.total];
  });
  await equal(times, [0, true, true]);
});

test("the form is laid out as fmt does, and a refused block is counted", async ({ open }) => {
  const { page } = await open();
  const before = await page.evaluate(() => window.page.editor.text);
  await page.evaluate(() => {
    const { editor } = window.page;
    editor.type(editor.text.replace("Machine Mill", "machine Mill"));
  });
  await page.locator(".cm-line").nth(4).click();
  await page.keyboard.press("Shift+Alt+F");
  await page.waitForFunction((before) => window.page.editor.text === before, before);
  await page.evaluate(() => {
    const { editor } = window.page;
    editor.type(editor.text.replace("\nEndCode\n", "\nEndCode\nG81 G0\n"));
  });
  await page.waitForFunction(() => /1 error, /.test(document.querySelector(".lint").textContent));
});

test("the code of a finding leads to its explanation", async ({ open }) => {
  const { page } = await open();
  await type(page, "1stToolChange\nT[tool]", " ");
  await page.locator(".cm-lintRange-error, .cm-lintRange-warning").first().hover();
  await page.locator(".cm-tooltip-lint").getByRole("button", { name: "PF101" }).click();
  const dialog = page.getByRole("dialog", { name: "What PF101 means" });
  await ok(async () => /two spaces/i.test(await dialog.innerText()), () => dialog.innerText());
  await dialog.getByRole("button", { name: "close" }).click();
  await equal(() => page.locator("dialog[open]").count(), 0);
});

test("warnings of printing are counted", async ({ open }) => {
  const { page } = await open();
  await page.evaluate(() => {
    const { editor } = window.page;
    editor.type(editor.text.replaceAll("G43 H[lcomp] Z[d] M[cool]", "G43 H[lcomp] Z[d] M8"));
  });
  await page.waitForFunction(() => /1 warning: the form prints M8/.test(document.querySelector(".lint").textContent));
});

await run();
