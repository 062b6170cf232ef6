// postform.cps with a stand-in for Autodesk's engine: node --test integrations/fusion/
// The program postform is target/debug/postform, or $POSTFORM.
"use strict";

const assert = require("node:assert");
const { execFileSync } = require("node:child_process");
const fs = require("node:fs");
const path = require("node:path");
const { test } = require("node:test");

const { CONSTANTS, Vector, post, section, tool } = require("./mock.js");

const ROOT = path.join(__dirname, "..", "..");
const POSTFORM = process.env.POSTFORM || path.join(ROOT, "target", "debug", "postform");

/** The program that a form makes of a job. */
function program(lines, form = "fanuc") {
  const input = lines.join("\n") + "\n";
  const args = ["render", "-", "--from", "jsonl", "--form", path.join(ROOT, "postforms", form + ".pf"), "--program", "1"];
  return execFileSync(POSTFORM, args, { input, encoding: "utf8", stdio: ["pipe", "pipe", "inherit"] });
}

/** The job of one operation. */
function job(events, given = {}, settings = {}) {
  return post([section({ tool: tool(1), events, ...given })], settings).lines;
}

/** The items of that operation, without its head and way in. */
function items(events, given, settings) {
  return job(events, given, settings).slice(4, -1).map((line) => JSON.parse(line));
}

test("the head says units, tools and their order", () => {
  const tap = tool(7, { diameter: 6.8, description: "M8 tap", type: CONSTANTS.TOOL_TAP_RIGHT_HAND, lengthOffset: 17 });
  const mill = tool(2, { cornerRadius: 0.5 });
  const { lines } = post(
    [section({ tool: mill }), section({ tool: tap }), section({ tool: tap }), section({ tool: mill })],
    { programComment: "Bracket", unit: CONSTANTS.IN },
  );
  assert.deepStrictEqual(JSON.parse(lines[0]).start, {
    postform: 1, program: 1001, name: "Bracket", units: "inch", machine: "mill",
    tools: [
      { number: 2, diameter: 10, length_offset: 2, diameter_offset: 2, corner_radius: 0.5 },
      { number: 7, diameter: 6.8, length_offset: 17, diameter_offset: 7, comment: "M8 tap" },
    ],
    tool_order: [2, 7, 2],
  });
  assert.deepStrictEqual(JSON.parse(lines.at(-1)), { end: true });
});

test("an operation has its tool, offset, spindle and coolant, and goes to its place before its height", () => {
  const { lines } = post([
    section({ tool: tool(3, { clockwise: false, coolant: CONSTANTS.COOLANT_MIST }), workOffset: 2, from: [1, 2, 30],
      parameters: { "operation-comment": "Rim" } }),
  ]);
  assert.deepStrictEqual(lines.slice(1, 4).map((line) => JSON.parse(line)), [
    { operation: { name: "Rim", tool: 3, work: 55, spindle: { speed: 3000, direction: "ccw" }, coolant: "mist", feed_mode: "per_minute", comment: "Rim" } },
    { rapid: [1, 2] },
    { rapid: [null, null, 30] },
  ]);
});

test("the same tool goes up before it goes across", () => {
  const down = (engine) => engine.rapid(5, 5, 2);
  const mill = tool(1);
  const { lines } = post([section({ tool: mill, events: down }), section({ tool: mill, from: [9, 9, 20] })]);
  const second = lines.findIndex((line, i) => i > 1 && line.includes("operation"));
  assert.deepStrictEqual(lines.slice(second + 1, second + 4), ['{"rapid":[null,null,20]}', '{"rapid":[9,9]}', '{"rapid":[null,null,20]}']);
});

test("moves, arcs in three planes, and numbers without noise", () => {
  const made = items((engine) => {
    engine.rapid(1, 2.0000000001, 3);
    engine.linear(4, -1e-12, 6, 499.99899999999997);
    engine.circular(true, [5, 0, 6], [6, 0, 5], 200);
    engine.circular(false, [6, 0, 6], [7, 0, 6], 200, CONSTANTS.PLANE_ZX);
    engine.circular(false, [7, 1, 6], [7, 1, 7], 200, CONSTANTS.PLANE_YZ);
    engine.circular(false, [7, 1, 6], [8, 1, 7], 200, -1);
  });
  assert.deepStrictEqual(made, [
    { rapid: [1, 2, 3] },
    { line: [4, 0, 6], feed: 499.999 },
    { arc: { to: [6, 0, 5], center: [5, 0, null], direction: "cw", plane: "xy" }, feed: 200 },
    { arc: { to: [7, 0, 6], center: [6, null, 6], direction: "ccw", plane: "xz" }, feed: 200 },
    { arc: { to: [7, 1, 7], center: [null, 1, 6], direction: "ccw", plane: "yz" }, feed: 200 },
    { line: [8, 1, 7], feed: 200 },
  ]);
});

test("cutter compensation is switched by straight moves", () => {
  const made = items((engine) => {
    engine.rapid(0, 0, 5);
    engine.compensate(engine.RADIUS_COMPENSATION_LEFT);
    engine.linear(1, 0, 5, 100);
    engine.linear(2, 0, 5, 100);
    engine.compensate(engine.RADIUS_COMPENSATION_OFF);
    engine.linear(3, 0, 5, 100);
  });
  assert.deepStrictEqual(made.slice(1), [
    { infeed: [1, 0, 5], side: "left", feed: 100 },
    { line: [2, 0, 5], feed: 100 },
    { outfeed: [3, 0, 5], feed: 100 },
  ]);
});

test("a cycle's heights are the program's: R is the retract height, Z the bottom, and it comes back to the clearance", () => {
  const lines = job((engine) => engine.holes("drilling", { clearance: 15, retract: 6, stock: 1, bottom: -12 }, [[10, 20, -12], [30, 20, -12]]));
  assert.ok(lines.includes('{"cycle":{"kind":"drill","depth":13,"clear":5,"return":14,"feed":100}}'), lines.join("\n"));
  const printed = program(lines);
  assert.match(printed, /G98 G81 X10\. Y20\. Z-12\. R6\. F100\.\n.*X30\./, printed);
  assert.match(printed, /Z15\..*\n.*G98/, printed);
});

test("holes of other heights are cycles of their own", () => {
  const lines = job((engine) => {
    engine.holes("drilling", {}, [[0, 0, -5], [9, 0, -5]]);
    engine.holes("drilling", { stock: -3, retract: 2, bottom: -8 }, [[20, 0, -8]]);
  });
  const printed = program(lines);
  assert.match(printed, /Z-5\. R5\./, printed);
  assert.match(printed, /X20\. Z-8\. R2\.|X20\. Y0 Z-8\. R2\./, printed);
});

test("kinds of holes", () => {
  const head = (type, parameters = {}, given = {}) => {
    const made = items((engine) => engine.holes(type, parameters, [[0, 0, -10]]), { tool: tool(1, given) });
    const cycle = made.find((each) => each.cycle);
    return cycle ? cycle.cycle : made;
  };
  const own = (type, parameters, given) => {
    const { depth, clear, return: up, ...rest } = head(type, parameters, given);
    assert.deepStrictEqual([depth, clear, up], [10, 5, 15]);
    return rest;
  };
  assert.deepStrictEqual(own("counter-boring", { dwell: 0.5 }), { kind: "face", feed: 100, dwell: 0.5 });
  assert.deepStrictEqual(own("counter-boring"), { kind: "drill", feed: 100 });
  assert.deepStrictEqual(own("deep-drilling", { incrementalDepth: 3 }), { kind: "deep", feed: 100, step: 3 });
  assert.deepStrictEqual(
    own("chip-breaking", { incrementalDepth: 3, incrementalDepthReduction: 0.5, minimumIncrementalDepth: 1, accumulatedDepth: 10 }),
    { kind: "chipbreak", feed: 100, step: 3, decr: 0.5, min_step: 1 },
  );
  assert.ok(Array.isArray(head("chip-breaking", { incrementalDepth: 3, accumulatedDepth: 6 })));
  assert.deepStrictEqual(own("tapping", {}, { threadPitch: 1.25, spindleRPM: 400 }), { kind: "tap", feed: 500 });
  assert.deepStrictEqual(own("tapping", {}, { threadPitch: 1, spindleRPM: 400, type: CONSTANTS.TOOL_TAP_LEFT_HAND, clockwise: false }), { kind: "ltap", feed: 400 });
  assert.deepStrictEqual(own("left-tapping", {}, { threadPitch: 1, spindleRPM: 400, clockwise: false }), { kind: "ltap", feed: 400 });
  assert.deepStrictEqual(
    own("right-tapping-with-chip-breaking", { incrementalDepth: 4 }, { threadPitch: 1, spindleRPM: 400 }),
    { kind: "tap", feed: 400, step: 4, mode: "chipbreak" },
  );
  assert.deepStrictEqual(own("reaming", { retractFeedrate: 100 }), { kind: "ream", feed: 100 });
  assert.ok(Array.isArray(head("reaming", { retractFeedrate: 200 })));
  assert.deepStrictEqual(own("boring", { dwell: 1 }), { kind: "ream", feed: 100, dwell: 1 });
  assert.deepStrictEqual(own("stop-boring"), { kind: "bore", feed: 100 });
  assert.deepStrictEqual(own("fine-boring", { shift: 0.2, shiftOrientation: Math.PI / 2 }), { kind: "bore", feed: 100, orient: 90, offset: 0.2 });
  for (const type of ["gun-drilling", "bore-milling", "thread-milling", "a kind of 2031"]) {
    assert.ok(Array.isArray(head(type)), type); // as moves
  }
});

test("what happens between moves", () => {
  const made = items((engine) => {
    engine.holes("drilling", {}, [[0, 0, -5]]);
    engine.call("onDwell", 1.5);
    engine.call("onSpindleSpeed", 1200);
    engine.call("onComment", "Größe <3>");
    engine.call("onPassThrough", "G4 P1\nM8");
    for (const name of ["STOP", "OPTIONAL_STOP", "COOLANT_OFF", "COOLANT_ON", "STOP_SPINDLE", "START_SPINDLE", "LOCK_MULTI_AXIS"]) {
      engine.call("onCommand", CONSTANTS["COMMAND_" + name]);
    }
  });
  assert.deepStrictEqual(made.slice(made.findIndex((each) => each.cycle_end) + 1), [
    { dwell: 1.5 }, { spindle: { speed: 1200, direction: "cw" } }, { comment: "Größe <3>" }, { text: "G4 P1" }, { text: "M8" },
    { stop: "program" }, { stop: "optional" }, { coolant: "off" }, { coolant: "on" }, { spindle: { direction: "off" } },
    { spindle: { speed: 3000, direction: "cw" } },
  ]);
});

test("what comes before the first operation is in it", () => {
  const { lines } = post([section({ tool: tool(1), before: (engine) => engine.call("onComment", "look at the vise") })]);
  assert.ok(lines[1].startsWith('{"operation"'));
  assert.strictEqual(lines[2], '{"comment":"look at the vise"}');
});

test("a missing work offset is G54, with a warning", () => {
  const { lines, warnings } = post([section({ tool: tool(1), workOffset: 0 }), section({ tool: tool(1), workOffset: 9, optional: true })]);
  assert.match(lines[1], /"work":54/);
  assert.ok(lines.some((line) => line.includes('"work":9,')));
  assert.deepStrictEqual(warnings.map((text) => text.slice(0, 22)), ["postform: the setup ha", "postform: an optional "]);
});

test("what no job can say is an error", () => {
  const refused = (why, given, events = () => {}) =>
    assert.throws(() => post([section({ tool: tool(1), events, ...given })]), (error) => error.message.includes(why) || assert.fail(error.message));
  refused("only milling", { type: CONSTANTS.TYPE_TURNING });
  refused("moves the tool axis", { multiAxis: true });
  refused("is tilted", { workPlane: { forward: new Vector(0, 1, 0) } });
  refused("no suction", { tool: tool(1, { coolant: CONSTANTS.COOLANT_SUCTION }) });
  refused("no air through the tool", { tool: tool(1, { coolant: CONSTANTS.COOLANT_AIR_THROUGH_TOOL }) });
  refused("probing", {}, (engine) => engine.holes("probing-x", {}, [[0, 0, 0]]));
  refused("switched by a rapid", {}, (engine) => {
    engine.compensate(engine.RADIUS_COMPENSATION_LEFT);
    engine.rapid(0, 0, 0);
  });
  refused("switched on an arc", {}, (engine) => {
    engine.compensate(engine.RADIUS_COMPENSATION_LEFT);
    engine.circular(true, [1, 0, 0], [2, 0, 0], 100);
  });
  refused("changes its side", {}, (engine) => {
    engine.compensate(engine.RADIUS_COMPENSATION_LEFT);
    engine.linear(1, 0, 0, 100);
    engine.compensate(engine.RADIUS_COMPENSATION_RIGHT);
    engine.linear(2, 0, 0, 100);
  });
  refused("ends under cutter compensation", {}, (engine) => {
    engine.compensate(engine.RADIUS_COMPENSATION_RIGHT);
    engine.linear(1, 0, 0, 100);
  });
  refused("COMMAND_BREAK_CONTROL", {}, (engine) => engine.call("onCommand", CONSTANTS.COMMAND_BREAK_CONTROL));
  refused("oriented", {}, (engine) => engine.call("onOrientateSpindle", 90));
  refused("moves the tool axis", {}, (engine) => engine.call("onLinear5D", 0, 0, 0, 0, 0, 1, 100));
  assert.throws(() => post([section({ tool: tool(1) }), section({ tool: tool(1, { diameter: 3 }) })]), /the number 1/);
});

test("a whole part is printed by every mill's form", () => {
  const { lines } = post([
    section({ tool: tool(1, { description: "Schaftfräser 10" }), from: [-20, 0, 15], parameters: { "operation-comment": "Contour" },
      events(engine) {
        engine.rapid(-20, 0, 5);
        engine.linear(-20, 0, -3, 300);
        engine.compensate(engine.RADIUS_COMPENSATION_LEFT);
        engine.linear(0, 0, -3, 800);
        engine.circular(true, [10, 0, -3], [10, 10, -3], 800);
        engine.linear(40, 10, -3, 800);
        engine.compensate(engine.RADIUS_COMPENSATION_OFF);
        engine.linear(60, 10, -3, 800);
        engine.rapid(60, 10, 15);
      } }),
    section({ tool: tool(2, { diameter: 6.8, spindleRPM: 2000 }), from: [20, 20, 15],
      events: (engine) => engine.holes("deep-drilling", { incrementalDepth: 4 }, [[20, 20, -18], [40, 20, -18]]) }),
    section({ tool: tool(3, { diameter: 8, spindleRPM: 500, threadPitch: 1.25 }), from: [20, 20, 15],
      events: (engine) => engine.holes("right-tapping", {}, [[20, 20, -12], [40, 20, -12]]) }),
  ]);
  const page = path.join(ROOT, "tests", "data", "fusion.jsonl"); // docs/sources/fusion.md shows what is in it
  if (process.env.OVERWRITE) {
    fs.writeFileSync(page, lines.join("\n") + "\n");
  }
  assert.strictEqual(fs.readFileSync(page, "utf8"), lines.join("\n") + "\n");
  for (const form of ["fanuc", "haas", "linuxcnc"]) {
    const printed = program(lines, form);
    assert.match(printed, /G41/, form);
    assert.match(printed, /G83 X20\. Y20\. Z-18\./, form);
    assert.match(printed, /Z-12\..* F625\./, form);
  }
});
