// Bundles the page: one file each for `postform watch`, for pages of `postform plot`, and for the playground.
import { createHash } from "node:crypto";
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { build } from "esbuild";

const here = (name) => new URL(name, import.meta.url).pathname;

/** What the page may do: run its own script, style itself, and ask where it came from. */
function policy(script, connects) {
  const hash = createHash("sha256").update(script).digest("base64");
  return [
    "default-src 'none'",
    `script-src 'sha256-${hash}'${connects.wasm ? " 'wasm-unsafe-eval'" : ""}`,
    "style-src 'unsafe-inline'",
    "img-src data:",
    `connect-src ${connects.self ? "'self'" : "'none'"}`,
    ...(connects.wasm ? ["worker-src 'self'"] : []),
    "base-uri 'none'",
    "form-action 'none'",
  ].join("; ");
}

/** A script of its own, for a thread of the playground. */
async function script(entry, out) {
  const options = { bundle: true, minify: true, format: "iife", target: "es2022", charset: "utf8", legalComments: "none" };
  await build({ ...options, entryPoints: [here(`src/${entry}.ts`)], outfile: here(out) });
}

/** Removes the indents and the comments of the shaders in gl.ts, which would be part of their text. */
const shaders = {
  name: "shaders",
  setup: ({ onLoad }) =>
    onLoad({ filter: /gl\.ts$/ }, ({ path }) => ({ contents: readFileSync(path, "utf8").replace(/^ +| +\/\/ .*$/gm, ""), loader: "ts" })),
};

async function page(entry, out, connects, data = "") {
  const bundled = await build({
    entryPoints: [here(`src/${entry}.ts`)],
    bundle: true,
    minify: true,
    format: "iife",
    target: "es2022",
    charset: "utf8",
    legalComments: "none",
    write: false,
    outdir: here("."),
    loader: { ".css": "css" },
    plugins: [shaders],
  });
  const text = (end) => bundled.outputFiles.find((file) => file.path.endsWith(end))?.text.trim() ?? "";
  // the text of a script must not end it
  const script = text(".js").replaceAll("</script", "<\\/script");
  const html = readFileSync(here("src/page.html"), "utf8")
    .replace("POLICY", () => policy(script, connects))
    .replace("STYLE", () => text(".css"))
    .replace("DATA", () => data)
    .replace("SCRIPT", () => script);
  const path = here(out);
  mkdirSync(new URL(".", `file://${path}`).pathname, { recursive: true });
  writeFileSync(path, html);
  console.log(`${out}: ${html.length} bytes`);
}

await page("watch", "dist/watch.html", { self: true });
await page("plot", "dist/plot.html", {}, '<script type="application/octet-stream" id="scene">SCENE</script>');
await script("playground-worker", "../docs/playground/worker.js");
await page("playground", "../docs/playground/index.html", { self: true, wasm: true });
