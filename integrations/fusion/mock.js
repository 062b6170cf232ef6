// A stand-in for Autodesk's post engine: what its documentation says of the functions, constants and objects that postform.cps
// uses. A name that is not here is an error in the post.
"use strict";

const fs = require("node:fs");
const path = require("node:path");
const vm = require("node:vm");

const SCRIPT = path.join(__dirname, "postform.cps");

const CONSTANTS = {
  MM: 0, IN: 1, EOL: "\n",
  CAPABILITY_MILLING: 1, TYPE_MILLING: 0, TYPE_TURNING: 1,
  RADIUS_COMPENSATION_OFF: 0, RADIUS_COMPENSATION_LEFT: 1, RADIUS_COMPENSATION_RIGHT: 2,
  PLANE_XY: 0, PLANE_ZX: 2, PLANE_YZ: 1,
  COOLANT_OFF: 0, COOLANT_FLOOD: 1, COOLANT_MIST: 2, COOLANT_THROUGH_TOOL: 3,
  COOLANT_AIR: 4, COOLANT_AIR_THROUGH_TOOL: 5, COOLANT_SUCTION: 6, COOLANT_FLOOD_MIST: 7, COOLANT_FLOOD_THROUGH_TOOL: 8,
  TOOL_DRILL: 1, TOOL_MILLING_END_FLAT: 10, TOOL_TAP_RIGHT_HAND: 7, TOOL_TAP_LEFT_HAND: 8,
  COMMAND_STOP: 1, COMMAND_OPTIONAL_STOP: 2, COMMAND_END: 3, COMMAND_SPINDLE_CLOCKWISE: 4,
  COMMAND_SPINDLE_COUNTERCLOCKWISE: 5, COMMAND_START_SPINDLE: 6, COMMAND_STOP_SPINDLE: 7, COMMAND_COOLANT_ON: 8,
  COMMAND_COOLANT_OFF: 9, COMMAND_LOCK_MULTI_AXIS: 10, COMMAND_UNLOCK_MULTI_AXIS: 11, COMMAND_BREAK_CONTROL: 12,
};

function Vector(x, y, z) {
  Object.assign(this, { x, y, z });
}

/** A tool with what Autodesk's tools have. */
function tool(number, given = {}) {
  return {
    number, diameter: 10, cornerRadius: 0, lengthOffset: number, diameterOffset: number, description: "", comment: "",
    clockwise: true, coolant: CONSTANTS.COOLANT_FLOOD, type: CONSTANTS.TOOL_MILLING_END_FLAT, spindleRPM: 3000, threadPitch: 0,
    getTappingFeedrate() {
      return this.spindleRPM * this.threadPitch;
    },
    ...given,
  };
}

/** An operation: its tool, its place, and the events that happen in it as calls of `engine`. */
function section(given) {
  return {
    workOffset: 1, workPlane: { forward: new Vector(0, 0, 1) }, from: [0, 0, 50], parameters: {}, multiAxis: false, optional: false,
    type: CONSTANTS.TYPE_MILLING, events() {}, before() {},
    getTool() {
      return this.tool;
    },
    getType() {
      return this.type;
    },
    isMultiAxis() {
      return this.multiAxis;
    },
    isOptional() {
      return this.optional;
    },
    getInitialPosition() {
      return new Vector(...this.from);
    },
    ...given,
  };
}

/** Posts these operations: the job's lines, and the warnings. An error of the post is thrown. */
function post(sections, settings = {}) {
  const lines = [];
  const warnings = [];
  let at = new Vector(0, 0, 0);
  let plane = CONSTANTS.PLANE_XY;
  let arc;
  const tools = [...new Set(sections.map((each) => each.tool))];

  const world = {
    ...CONSTANTS,
    Vector,
    unit: CONSTANTS.MM, programName: "1001", programComment: "",
    radiusCompensation: CONSTANTS.RADIUS_COMPENSATION_OFF, cycle: undefined, cycleType: undefined,
    tool: undefined, currentSection: undefined, spindleSpeed: 0,
    ...settings,
    setCodePage() {},
    spatial: (value) => value,
    toRad: (degrees) => (degrees * Math.PI) / 180,
    toDeg: (radians) => (radians * 180) / Math.PI,
    localize: (text) => text,
    writeln: (text) => lines.push(text),
    error(text) {
      throw new Error(text);
    },
    warning: (text) => warnings.push(text),
    getToolTable: () => ({ getNumberOfTools: () => tools.length, getTool: (i) => tools[i] }),
    getNumberOfSections: () => sections.length,
    getSection: (i) => sections[i],
    isFirstSection: () => world.currentSection === sections[0],
    getPreviousSection: () => sections[sections.indexOf(world.currentSection) - 1],
    isSameDirection: (a, b) => a.x === b.x && a.y === b.y && a.z === b.z,
    setRotation() {},
    getFramePosition: (position) => position,
    getCurrentPosition: () => at,
    getCircularPlane: () => plane,
    hasParameter: (name) => name in world.currentSection.parameters,
    getParameter: (name) => world.currentSection.parameters[name],
    getCommandStringId: (command) => Object.keys(CONSTANTS).find((name) => name.startsWith("COMMAND_") && CONSTANTS[name] === command),
    linearize() {
      // a chord is enough to see that moves come
      engine.linear(...arc.to, arc.feed);
    },
    expandCyclePoint(x, y, z) {
      engine.rapid(x, y, world.cycle.clearance);
      engine.rapid(x, y, world.cycle.retract);
      engine.linear(x, y, z, world.cycle.feedrate);
      engine.rapid(x, y, world.cycle.clearance);
    },
  };
  vm.createContext(world);
  vm.runInContext(fs.readFileSync(SCRIPT, "utf8"), world, { filename: SCRIPT });

  /** An event, where the post has an entry function for it. */
  function call(name, ...args) {
    if (typeof world[name] === "function") {
      world[name](...args);
    }
  }
  const engine = {
    ...CONSTANTS,
    rapid(x, y, z) {
      call("onRapid", x, y, z);
      at = new Vector(x, y, z);
    },
    linear(x, y, z, feed) {
      call("onLinear", x, y, z, feed);
      at = new Vector(x, y, z);
    },
    circular(clockwise, center, to, feed, inPlane = CONSTANTS.PLANE_XY) {
      plane = inPlane;
      arc = { to, feed };
      call("onCircular", clockwise, ...center, ...to, feed);
      at = new Vector(...to);
    },
    compensate(side) {
      world.radiusCompensation = side;
      call("onRadiusCompensation");
    },
    /** A cycle with its parameters, absolute heights as Autodesk has them, and its points: x, y and the bottom. */
    holes(type, parameters, points) {
      world.cycleType = type;
      world.cycle = { clearance: 15, retract: 5, stock: 0, bottom: points[0][2], depth: -points[0][2], feedrate: 100, dwell: 0, ...parameters };
      call("onCycle");
      for (const [x, y, z] of points) {
        call("onCyclePoint", x, y, z);
        at = new Vector(x, y, world.cycle.clearance);
      }
      call("onCycleEnd");
    },
    call,
  };

  call("onOpen");
  for (const each of sections) {
    each.before(engine);
    world.currentSection = each;
    world.tool = each.tool;
    world.spindleSpeed = each.tool.spindleRPM;
    call("onSection");
    at = new Vector(...each.from);
    each.events(engine);
    call("onSectionEnd");
  }
  call("onClose");
  return { lines, warnings };
}

module.exports = { CONSTANTS, Vector, post, section, tool };
