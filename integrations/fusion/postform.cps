/**
  postform: the toolpath of Fusion, Inventor or HSM as a job in JSON Lines, which `postform render` prints for any machine.

  Install it as any post of your own, post with it, then: postform render part.jsonl --form haas.pf -o part.nc
*/

description = "postform job";
longDescription = "Writes the toolpath as a job for postform, which prints the NC program of your machine.";
vendor = "postform";
legal = "MIT license";
certificationLevel = 2;
minimumRevision = 45702;

extension = "jsonl";
setCodePage("utf-8");

capabilities = CAPABILITY_MILLING;
tolerance = spatial(0.002, MM);
minimumChordLength = spatial(0.25, MM);
minimumCircularRadius = spatial(0.01, MM);
maximumCircularRadius = spatial(1000, MM);
minimumCircularSweep = toRad(0.01);
maximumCircularSweep = toRad(180);
allowHelicalMoves = true;
allowedCircularPlanes = undefined; // all three; what lies otherwise comes as lines

// the canned cycles of a job; the others come as moves
var KINDS = {
  "drilling": "drill",
  "counter-boring": "face",
  "chip-breaking": "chipbreak",
  "deep-drilling": "deep",
  "tapping": "tap",
  "right-tapping": "tap",
  "left-tapping": "ltap",
  "tapping-with-chip-breaking": "tap",
  "right-tapping-with-chip-breaking": "tap",
  "left-tapping-with-chip-breaking": "ltap",
  "reaming": "ream",
  "boring": "ream",
  "stop-boring": "bore",
  "fine-boring": "bore"
};

var openCycle; // the head of the cycle whose points are being written
var compensating = RADIUS_COMPENSATION_OFF; // what the last move was made with
var inOperation = false;
var waiting = []; // what comes before the first operation

/** Writes an item of the job on a line. */
function item(object) {
  if (!inOperation && !object.start && !object.operation && !object.end) {
    waiting.push(object);
  } else {
    writeln(JSON.stringify(object));
  }
}

/** A length or feed without the noise of unit conversion: a millionth. */
function rounded(value) {
  return Math.round(value * 1e6) / 1e6 + 0; // no minus zero
}

function position(x, y, z) {
  return [rounded(x), rounded(y), rounded(z)];
}

/** Says why there is no job. */
function refuse(text) {
  error(localize("postform: " + text));
}

// The head: tools, units, order

function onOpen() {
  var start = {postform: 1};
  var number = parseInt(programName, 10);
  if (String(number) == programName && number > 0) {
    start.program = number;
  }
  start.name = programComment || programName || "";
  start.units = unit == IN ? "inch" : "mm";
  start.machine = "mill";
  start.tools = tools();
  start.tool_order = [];
  for (var i = 0; i < getNumberOfSections(); ++i) {
    var next = getSection(i).getTool().number;
    if (next != start.tool_order[start.tool_order.length - 1]) {
      start.tool_order.push(next);
    }
  }
  item({start: start});
}

/** The tools, each number once. */
function tools() {
  var table = getToolTable();
  var list = [];
  var seen = {};
  for (var i = 0; i < table.getNumberOfTools(); ++i) {
    var each = table.getTool(i);
    var made = {
      number: each.number,
      diameter: rounded(each.diameter),
      length_offset: each.lengthOffset,
      diameter_offset: each.diameterOffset
    };
    if (each.cornerRadius > 0) {
      made.corner_radius = rounded(each.cornerRadius);
    }
    if (each.description || each.comment) {
      made.comment = each.description || each.comment;
    }
    if (seen[each.number] === undefined) {
      list.push(made);
      seen[each.number] = made.diameter;
    } else if (seen[each.number] != made.diameter) {
      refuse("two tools of different diameters have the number " + each.number);
    }
  }
  return list;
}

// Operations

function onSection() {
  if (currentSection.getType() != TYPE_MILLING) {
    refuse("only milling and drilling: take the other operations out");
  }
  if (currentSection.isMultiAxis()) {
    refuse("an operation moves the tool axis: a form has no words for it");
  }
  var plane = currentSection.workPlane;
  if (!isSameDirection(plane.forward, new Vector(0, 0, 1))) {
    refuse("the tool is tilted: make a setup whose Z is the tool's axis, and post it by itself");
  }
  setRotation(plane);
  if (currentSection.isOptional()) {
    warning(localize("postform: an optional operation is always made"));
  }
  var name = hasParameter("operation-comment") ? getParameter("operation-comment") : "";
  var operation = {name: name, tool: tool.number, work: work()};
  operation.spindle = spindle(spindleSpeed, tool.clockwise);
  operation.coolant = coolant(tool.coolant);
  operation.feed_mode = "per_minute";
  if (name) {
    operation.comment = name;
  }
  var changes = isFirstSection() || getPreviousSection().getTool().number != tool.number;
  item({operation: operation});
  inOperation = true;
  for (var i = 0; i < waiting.length; ++i) {
    item(waiting[i]);
  }
  waiting = [];
  var from = getFramePosition(currentSection.getInitialPosition());
  if (!changes && getCurrentPosition().z < from.z) {
    item({rapid: [null, null, rounded(from.z)]});
  }
  item({rapid: [rounded(from.x), rounded(from.y)]});
  item({rapid: [null, null, rounded(from.z)]});
}

/** G54 is Autodesk's 1; beyond G59 it is the number of the offset. */
function work() {
  var offset = currentSection.workOffset;
  if (offset == 0) {
    warning(localize("postform: the setup has no work offset, G54 is taken"));
    offset = 1;
  }
  return offset <= 6 ? 53 + offset : offset;
}

function spindle(speed, clockwise) {
  return speed > 0 ? {speed: rounded(speed), direction: clockwise ? "cw" : "ccw"} : {direction: "off"};
}

function coolant(kind) {
  switch (kind) {
  case COOLANT_OFF:
    return "off";
  case COOLANT_FLOOD:
    return "on";
  case COOLANT_MIST:
    return "mist";
  case COOLANT_THROUGH_TOOL:
    return "through";
  case COOLANT_AIR:
    return "air";
  case COOLANT_FLOOD_MIST:
    return ["on", "mist"];
  case COOLANT_FLOOD_THROUGH_TOOL:
    return ["on", "through"];
  }
  refuse("coolant of tool " + tool.number + ": a job has no suction and no air through the tool; choose another coolant for it");
}

function onSectionEnd() {
  endCycle();
  if (compensating != RADIUS_COMPENSATION_OFF) {
    refuse("an operation ends under cutter compensation");
  }
}

function onClose() {
  item({end: true});
}

// Moves

function onRapid(x, y, z) {
  endCycle();
  if (compensating != radiusCompensation) {
    refuse("cutter compensation is switched by a rapid: give the operation a lead-in and a lead-out");
  }
  item({rapid: position(x, y, z)});
}

function onLinear(x, y, z, feed) {
  endCycle();
  var to = position(x, y, z);
  var move = {line: to, feed: rounded(feed)};
  if (compensating != radiusCompensation) {
    if (compensating != RADIUS_COMPENSATION_OFF && radiusCompensation != RADIUS_COMPENSATION_OFF) {
      refuse("cutter compensation changes its side without being switched off");
    }
    move = radiusCompensation == RADIUS_COMPENSATION_OFF
      ? {outfeed: to, feed: rounded(feed)}
      : {infeed: to, side: radiusCompensation == RADIUS_COMPENSATION_LEFT ? "left" : "right", feed: rounded(feed)};
    compensating = radiusCompensation;
  }
  item(move);
}

function onCircular(clockwise, cx, cy, cz, x, y, z, feed) {
  endCycle();
  if (compensating != radiusCompensation) {
    refuse("cutter compensation is switched on an arc: lead in and out by straight moves");
  }
  var center = position(cx, cy, cz);
  var plane;
  switch (getCircularPlane()) {
  case PLANE_XY:
    plane = "xy";
    center[2] = null;
    break;
  case PLANE_ZX:
    plane = "xz";
    center[1] = null;
    break;
  case PLANE_YZ:
    plane = "yz";
    center[0] = null;
    break;
  default:
    linearize(tolerance);
    return;
  }
  var arc = {to: position(x, y, z), center: center, direction: clockwise ? "cw" : "ccw", plane: plane};
  item({arc: arc, feed: rounded(feed)});
}

function onRapid5D() {
  refuse("an operation moves the tool axis: a form has no words for it");
}

function onLinear5D() {
  refuse("an operation moves the tool axis: a form has no words for it");
}

// Holes

function onCyclePoint(x, y, z) {
  if (String(cycleType).indexOf("probing") == 0) {
    refuse("probing is not a job's: take the operation out");
  }
  var head = cycleHead(z);
  if (!head) {
    endCycle();
    expandCyclePoint(x, y, z);
    return;
  }
  var text = JSON.stringify(head);
  if (openCycle != text) {
    endCycle();
    if (getCurrentPosition().z < cycle.clearance) {
      item({rapid: [null, null, rounded(cycle.clearance)]});
    }
    item({cycle: head});
    openCycle = text;
  }
  item({point: position(x, y, top(z))});
}

/** The top of a hole whose bottom is z: Autodesk's heights are absolute, a job's are distances from the top. */
function top(z) {
  return z + cycle.stock - cycle.bottom;
}

/** What a job says of the cycle; nothing for a cycle that must come as moves. */
function cycleHead(z) {
  var kind = KINDS[cycleType];
  var outAtFeed = kind == "ream" && cycle.retractFeedrate !== undefined && cycle.retractFeedrate != cycle.feedrate;
  var partly = kind == "chipbreak" && cycle.accumulatedDepth !== undefined && cycle.accumulatedDepth < cycle.depth;
  if (!kind || outAtFeed || partly) {
    return undefined;
  }
  var tapping = kind == "tap" || kind == "ltap";
  if (cycleType == "tapping" && tool.type == TOOL_TAP_LEFT_HAND) {
    kind = "ltap";
  }
  if (kind == "face" && !(cycle.dwell > 0)) {
    kind = "drill";
  }
  var head = {
    kind: kind,
    depth: rounded(top(z) - z),
    clear: rounded(cycle.retract - top(z)),
    "return": rounded(cycle.clearance - top(z)),
    feed: rounded(tapping ? tool.getTappingFeedrate() : cycle.feedrate)
  };
  if (cycle.dwell > 0 && kind != "drill") {
    head.dwell = rounded(cycle.dwell);
  }
  var pecks = kind == "deep" || kind == "chipbreak" || cycleType.indexOf("-with-chip-breaking") > 0;
  if (pecks) {
    head.step = rounded(cycle.incrementalDepth);
    if (cycle.incrementalDepthReduction > 0) {
      head.decr = rounded(cycle.incrementalDepthReduction);
      head.min_step = rounded(cycle.minimumIncrementalDepth);
    }
    if (tapping) {
      head.mode = "chipbreak";
    }
  }
  if (cycleType == "fine-boring") {
    head.orient = rounded(toDeg(cycle.shiftOrientation));
    head.offset = rounded(cycle.shift);
  }
  return head;
}

function onCycleEnd() {
  endCycle();
}

function endCycle() {
  if (openCycle) {
    openCycle = undefined;
    item({cycle_end: true});
  }
}

// Between moves

function onDwell(seconds) {
  endCycle();
  item({dwell: rounded(seconds)});
}

function onSpindleSpeed(speed) {
  endCycle();
  item({spindle: spindle(speed, tool.clockwise)});
}

function onComment(text) {
  endCycle();
  item({comment: String(text)});
}

function onPassThrough(text) {
  endCycle();
  var lines = String(text).split(/\r?\n/);
  for (var i = 0; i < lines.length; ++i) {
    item({text: lines[i]});
  }
}

function onOrientateSpindle() {
  refuse("the spindle is oriented outside a cycle: take the command out");
}

function onCommand(command) {
  endCycle();
  switch (command) {
  case COMMAND_STOP:
    item({stop: "program"});
    return;
  case COMMAND_OPTIONAL_STOP:
    item({stop: "optional"});
    return;
  case COMMAND_COOLANT_ON:
    item({coolant: coolant(tool.coolant == COOLANT_OFF ? COOLANT_FLOOD : tool.coolant)});
    return;
  case COMMAND_COOLANT_OFF:
    item({coolant: "off"});
    return;
  case COMMAND_SPINDLE_CLOCKWISE:
    item({spindle: spindle(spindleSpeed, true)});
    return;
  case COMMAND_SPINDLE_COUNTERCLOCKWISE:
    item({spindle: spindle(spindleSpeed, false)});
    return;
  case COMMAND_START_SPINDLE:
    item({spindle: spindle(spindleSpeed, tool.clockwise)});
    return;
  case COMMAND_STOP_SPINDLE:
    item({spindle: {direction: "off"}});
    return;
  case COMMAND_LOCK_MULTI_AXIS:
  case COMMAND_UNLOCK_MULTI_AXIS:
    return; // no rotary axis is ever moved
  }
  refuse("a command that a job can't say: " + getCommandStringId(command) + ". Take it out of Manual NC");
}
