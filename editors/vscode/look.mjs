// The packed extension in a real VS Code: code-server in a headless Chromium, a form opened, a wrong word typed, and what is shown
// looked at. Heavy, and so no part of CI: `just vscode-shot`. Pictures are written into the folder that is named last.
//
// node look.mjs CODE_SERVER POSTFORM FOLDER; CODE_SERVER is what npm installed (`npm install code-server`, with node 24)

import { execFileSync, spawn } from "node:child_process";
import { cpSync, existsSync, mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { createServer } from "node:net";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import puppeteer from "puppeteer-core";

const [codeServer = "code-server", postform = "target/debug/postform", pictures = "."] = process.argv.slice(2);
const root = resolve(import.meta.dirname, "../..");
const chromium = ["/usr/bin/chromium-headless-shell", "/usr/bin/chromium", "/usr/bin/google-chrome"].find((path) => existsSync(path));
const folder = mkdtempSync(join(tmpdir(), "postform-look-"));
const shop = join(folder, "shop");

mkdirSync(join(folder, "data/User"), { recursive: true });
mkdirSync(shop);
mkdirSync(pictures, { recursive: true });
const form = readFileSync(join(root, "postforms/haas.pf"), "utf8");
writeFileSync(join(shop, "my.pf"), form);
cpSync(join(root, "samples/bracket/job.json"), join(shop, "bracket.json"));
writeFileSync(join(shop, "postform.toml"), 'form = "my.pf"\ncontrol = "haas"\njobs = ["bracket.json"]\n');
writeFileSync(join(shop, "part.nc"), "%\nO1 (PART)\nG20 G90 G54\nG0 X1. Y1.\nG1 Z-.1 F5. G99999\nM30\n%\n");
const settings = {
  "workbench.startupEditor": "none",
  "workbench.colorTheme": "Default Light Modern",
  "security.workspace.trust.enabled": false,
  "telemetry.telemetryLevel": "off",
  "editor.minimap.enabled": false,
  "chat.commandCenter.enabled": false,
  "chat.disableAIFeatures": true,
  "workbench.secondarySideBar.defaultVisibility": "hidden",
  "workbench.tips.enabled": false,
  "editor.fontSize": 13,
  "files.autoSave": "off",
  "postform.path": resolve(postform),
};
writeFileSync(join(folder, "data/User/settings.json"), JSON.stringify(settings));
// nowhere but where the setting says
const home = join(folder, "home");
mkdirSync(home);
const env = { ...process.env, HOME: home };

/** A port that is free. */
const port = await new Promise((done) => {
  const server = createServer().listen(0, "127.0.0.1", () => {
    const { port } = server.address();
    server.close(() => done(port));
  });
});

const where = ["--extensions-dir", join(folder, "extensions"), "--user-data-dir", join(folder, "data")];
const quiet = ["--auth", "none", "--disable-telemetry", "--disable-update-check", "--disable-workspace-trust"];
execFileSync(codeServer, [...where, "--install-extension", join(import.meta.dirname, "postform.vsix")], { stdio: "inherit", env });
const server = spawn(codeServer, [...where, ...quiet, "--bind-addr", `127.0.0.1:${port}`, shop], { stdio: ["ignore", "pipe", "inherit"], env });
const browser = await puppeteer.launch({ executablePath: chromium, args: ["--no-sandbox"], headless: "shell" });

const page = await browser.newPage();

const failures = [];
async function check(text, is) {
  try {
    await is();
    console.log(`ok   ${text}`);
  } catch (error) {
    failures.push(text);
    console.log(`FAILED: ${text}: ${String(error).split("\n")[0]}`);
  }
}

try {
  await new Promise((done, fail) => {
    server.stdout.on("data", (data) => String(data).includes("HTTP server listening") && done());
    server.on("exit", (code) => fail(new Error(`code-server ended with ${code}`)));
  });
  await page.setViewport({ width: 1280, height: 800 });
  page.setDefaultTimeout(180_000);
  await page.goto(`http://127.0.0.1:${port}/?folder=${encodeURIComponent(shop)}`);
  await page.waitForSelector(".monaco-workbench");
  const shot = (name) => page.screenshot({ path: join(pictures, `vscode-${name}.png`) });
  const press = async (...keys) => {
    for (const key of keys.slice(0, -1)) await page.keyboard.down(key);
    await page.keyboard.press(keys.at(-1));
    for (const key of keys.slice(0, -1).reverse()) await page.keyboard.up(key);
  };
  const pause = (ms) => new Promise((done) => setTimeout(done, ms));
  // blanks are of several kinds there
  const seen = (selector, text) =>
    page.waitForFunction(
      (selector, text) => [...document.querySelectorAll(selector)].some((one) => one.textContent.replace(/\s+/g, "").includes(text)),
      {},
      selector,
      text.replace(/\s+/g, ""),
    );
  const command = async (text) => {
    await press("F1");
    await page.waitForSelector(".quick-input-widget input");
    await page.keyboard.type(text);
    await pause(800);
    await press("Enter");
  };
  // by the list of files: Go to File needs a search program that code-server downloads
  const open = async (name) => {
    await command("File: Focus on Files Explorer");
    const row = await page.waitForSelector(`.explorer-folders-view .monaco-list-row[aria-label^="${name}"]`);
    await row.click({ count: 2 });
    await seen(".tab.active", name);
  };
  /** Puts the cursor before the first words like these of the form. */
  const goTo = async (text) => {
    const before = form.slice(0, form.indexOf(text)).split("\n");
    await press("Control", "g");
    await page.waitForSelector(".quick-input-widget input");
    await page.keyboard.type(`${before.length}:${before.at(-1).length + 1}`);
    await press("Enter");
    await seen(".statusbar-item", `Ln ${before.length}, Col`);
  };

  await open("my.pf");
  await check("postform is found where the setting says", async () => {
    const told = await page.evaluate(() => document.querySelector(".notifications-toasts")?.textContent ?? "");
    if (told.includes("postform is not")) throw new Error(told);
  });
  await check("the verdict stands above the form", () => seen(".codelens-decoration", "blocks, proven"));
  await check("the form is coloured", () => page.waitForSelector(".view-line .mtk6, .view-line .mtk5"));
  await goTo("R[vclear] P[dwell]");
  await check("hints stand behind words", () => seen(".view-line", "→ R.1"));

  // hover
  await command("Show or Focus Hover");
  await check("hover explains, with the current job", () => seen(".monaco-hover", "clearance plane (R plane)"));
  await pause(700);
  await shot("hover");
  await press("Escape");

  // a wrong word: diagnostics, and completion behind a bracket
  await goTo("G[retplane] G82");
  await press("End");
  await press("Enter");
  await page.keyboard.type("X[hh]");
  await check("a wrong word is underlined", () => page.waitForSelector(".squiggly-error"));
  await page.keyboard.type(" R[vcl");
  await check("variables are completed", () => seen(".suggest-widget .monaco-list-row", "vclear"));
  await press("Control", "Space"); // the list stays, with its details
  await check("with what they are and hold", () => seen(".suggest-details", "0.1 in bracket: clearance plane"));
  await pause(700);
  await shot("completion");
  await press("Escape");
  await command("Problems: Focus on Problems View");
  await check("and is said", () => seen(".markers-panel", "is not a variable"));
  await pause(500);
  await shot("problems");
  await command("View: Close Panel");
  await command("File: Revert File");
  await page.waitForFunction(() => !document.querySelector(".squiggly-error"));

  // the program beside the form
  await command("POSTFORM: Render here");
  await check("the program is shown beside the form", () => seen(".view-line", "G98 G81"));
  await command("POSTFORM: Verify all jobs");
  await check("the verdict of each job is said", () => seen(".notification-toast", "bracket: "));

  // a program by its control
  await open("part.nc");
  await check("what a control refuses is underlined", () => page.waitForSelector(".squiggly-error, .squiggly-warning"));

  // the setting is changed: what is not there is said with what to do, and the server starts anew where it is
  const saved = (path) => writeFileSync(join(folder, "data/User/settings.json"), JSON.stringify({ ...settings, "postform.path": path }));
  await command("Notifications: Clear All Notifications");
  saved("/nowhere/postform");
  await check("a program that is not there is said, with what to do", () => seen(".notification-toast", "or say where it is"));
  await command("Notifications: Clear All Notifications");
  saved(resolve(postform));
  await open("my.pf");
  await check("and the server starts anew where the setting says", () => seen(".codelens-decoration", "blocks, proven"));
} catch (error) {
  failures.push(String(error));
  console.log(error);
  await page.screenshot({ path: join(folder, "failed.png") });
} finally {
  await browser.close();
  server.kill();
}
if (failures.length === 0) rmSync(folder, { recursive: true, force: true, maxRetries: 5, retryDelay: 500 });
console.log(failures.length === 0 ? "VS Code: all of it" : `${failures.length} failed; see ${folder}: VS Code's logs are in data/logs`);
process.exit(failures.length === 0 ? 0 : 1);
