// How the page does with the bracket and with many moves: milliseconds to the first picture and verdict, frames, memory, and from a key
// to a new picture and verdict. Frames are told as a ratio to drawing all lines once with gl.LINES in the same browser, which has no GPU
// here; the verdict as a ratio to a whole `postform render` of the same job, which proves it too and is run in turn with the keys.
//
//   node test/figures.mjs [MOVES..]     0: the bracket
import { spawnSync } from "node:child_process";
import { createWriteStream, readFileSync, rmSync } from "node:fs";
import { once } from "node:events";
import { join } from "node:path";
import { browser, folder, postform, ready, watch } from "./harness.mjs";

/** A finishing pass over a wave: short moves, line by line. */
async function job(path, moves) {
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

const found = await browser();
for (const moves of process.argv.length > 2 ? process.argv.slice(2).map(Number) : [0, 100_000, 1_000_000]) {
  const path = folder();
  if (moves) await job(join(path, "bracket.json"), moves);
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
  const drawn = await page.evaluate(async () => {
    const { backplot } = window.page;
    const gl = document.querySelector("canvas.path").getContext("webgl2");
    const pixel = new Uint8Array(4);
    const time = (draw) => {
      const began = performance.now();
      draw();
      gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel); // until it is drawn
      return performance.now() - began;
    };
    const middle = (times) => times.sort((a, b) => a - b)[times.length >> 1];
    const frames = [];
    for (let i = 0; i < 9; i++) {
      backplot.camera.orbit(20, 3);
      frames.push(time(() => backplot.draw()));
    }
    const pieces = backplot.frames.pieces;
    // nearer: all of the detail, little of it in sight
    backplot.camera.zoom(40, 300, 300);
    const near = middle([0, 1, 2].map(() => time(() => backplot.draw())));
    // the same lines drawn once each, by the plainest means
    const shader = (type, text) => {
      const made = gl.createShader(type);
      gl.shaderSource(made, text);
      gl.compileShader(made);
      return made;
    };
    const program = gl.createProgram();
    gl.attachShader(program, shader(gl.VERTEX_SHADER, "#version 300 es\nin vec3 a;uniform float s;void main(){gl_Position=vec4(a.xy*s,0,1);}"));
    gl.attachShader(program, shader(gl.FRAGMENT_SHADER, "#version 300 es\nprecision highp float;out vec4 c;void main(){c=vec4(1);}"));
    gl.linkProgram(program);
    const { points } = window.page.program.path;
    const buffer = gl.createBuffer();
    gl.bindVertexArray(gl.createVertexArray());
    gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
    gl.bufferData(gl.ARRAY_BUFFER, points, gl.STATIC_DRAW);
    gl.enableVertexAttribArray(0);
    gl.vertexAttribPointer(0, 3, gl.FLOAT, false, 0, 0);
    const plain = middle([0, 1, 2].map(() => time(() => {
      gl.useProgram(program);
      gl.uniform1f(gl.getUniformLocation(program, "s"), 0.009);
      gl.drawArrays(gl.LINE_STRIP, 0, points.length / 3);
    })));
    return { frame: middle(frames), pieces, near, plain, memory: performance.memory?.usedJSHeapSize / 1e6 };
  });
  const keys = [];
  const commands = [];
  for (let i = 0; i < (moves > 200_000 ? 5 : 15); i++) {
    const began = performance.now();
    const { status } = spawnSync(postform, ["render", "bracket.json", "--form", "my.pf", "-o", "part.nc"], { cwd: path });
    if (status !== 0) throw new Error(`postform render ended with ${status}`);
    commands.push(performance.now() - began);
    keys.push(await page.evaluate(async () => {
      const { page } = window;
      const before = page.times.length;
      const { view } = page.editor;
      const at = view.state.doc.toString().indexOf("Name Fanuc") + 10;
      const began = performance.now();
      view.dispatch({ changes: { from: at, insert: "x" } });
      while (page.times.length === before) await new Promise((done) => setTimeout(done, 1));
      while (page.running || !/^(proven|different|not)/.test(document.querySelector(".verdict").textContent)) await new Promise((done) => setTimeout(done, 1));
      return [page.times[page.times.length - 1], performance.now() - began];
    }));
  }
  const median = (times) => times.sort((a, b) => a - b)[times.length >> 1];
  const [picture, proven, command] = [keys.map((times) => times[0]), keys.map((times) => times[1]), commands].map(median);
  const most = Number(/VmHWM:\s*(\d+)/.exec(readFileSync(`/proc/${served.pid}/status`, "utf8"))?.[1]) / 1000;
  console.log(`${moves ? `${moves} moves` : "the bracket"}: first picture ${first.toFixed(0)} ms, verdict ${verdict.toFixed(0)} ms; ` +
    `a frame ${drawn.frame.toFixed(1)} ms for ${drawn.pieces} lines (${(drawn.frame / drawn.plain).toFixed(2)} of drawing all lines once, ${drawn.plain.toFixed(1)} ms), ` +
    `from near ${drawn.near.toFixed(1)} ms; heap ${drawn.memory?.toFixed(0)} MB, postform ${most.toFixed(0)} MB at most; from a key to the picture ${picture.toFixed(0)} ms, ` +
    `to the verdict ${proven.toFixed(0)} ms (${(proven / command).toFixed(2)} of a whole render, ${command.toFixed(0)} ms)`);
  await page.close();
  served.end();
  rmSync(path, { recursive: true });
}
await found.close();
