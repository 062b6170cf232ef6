// A setting that is read late starts the server once more, and never two of them.
import assert from "node:assert";
import { build } from "esbuild";

const { outputFiles } = await build({ entryPoints: ["src/latest.ts"], bundle: true, format: "esm", write: false });
const { Latest } = await import(`data:text/javascript,${encodeURIComponent(outputFiles[0].text)}`);

let path = "";
let at = 0;
const done = [];
const server = new Latest(async (isOutdated) => {
  assert.equal(++at, 1, "one at a time");
  const read = path;
  await new Promise((later) => setTimeout(later, 20));
  done.push([read, isOutdated()]);
  at--;
});
const first = server.ask();
path = "/opt/a";
void server.ask();
path = "/opt/postform";
await Promise.all([first, server.ask()]);
assert.deepEqual(done, [["", true], ["/opt/postform", false]]);
// one that failed keeps nothing from being done
const fails = new Latest(() => Promise.reject(new Error("no")));
await assert.rejects(fails.ask());
await assert.rejects(fails.ask());
console.log("latest: ok");
