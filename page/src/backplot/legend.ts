// The legend: the meaning of the colours in a picture.

import { element } from "../element.ts";
import type { Program } from "../program.ts";
import { toolText } from "../scene.ts";
import { type Colour, type Colours, css, ofTool } from "./colours.ts";
import type { Shades } from "./shades.ts";

/** Maximum number of entries; the others are only counted. */
const MOST = 8;

export function legendOf(program: Program, shades: Shades, colours: Colours, hasOld: boolean): HTMLElement[] {
  const entries = [element("span", { class: "rapid" }, "rapid"), ...(shades.range ? [ramp(shades.range, shades.meaning, program, colours)] : numbers(program, shades, colours))];
  if (hasOld) entries.push(element("span", { class: "was" }, "before"));
  return entries;
}

/** An entry for each tool or operation that cuts. */
function numbers(program: Program, { meaning }: Shades, colours: Colours): HTMLElement[] {
  const { moveKind, moveTool, moveLine, head } = program.path!;
  const of = meaning === "tool" ? (move: number) => moveTool[move] : (move: number) => program.item(moveLine[move])?.operation ?? 0;
  const used = new Set<number>();
  for (let move = 0; move < moveKind.length; move++) if ([1, 2].includes(moveKind[move] & 15)) used.add(of(move));
  const name = (number: number) => {
    if (meaning === "tool") return number === 0 ? "no tool" : toolText(head, head.tools[number]);
    return number === 0 ? "no operation" : `operation ${number}`;
  };
  const rest = used.size > MOST ? [element("i", {}, `and ${used.size - MOST} more`)] : [];
  return [...[...used].sort((a, b) => a - b).slice(0, MOST).map((number) => coloured(name(number), ofTool(colours, number))), ...rest];
}

function coloured(name: string, colour: Colour): HTMLElement {
  const entry = element("span", {}, name);
  entry.style.setProperty("--c", css(colour));
  return entry;
}

/** The least value, the ramp of colours, and the greatest value. */
function ramp([least, greatest]: [number, number], meaning: string, program: Program, colours: Colours): HTMLElement {
  const { units } = program.path!.head;
  const bar = element("i", {});
  bar.style.background = `linear-gradient(to right, ${colours.ramp.map((colour) => css(colour)).join(", ")})`;
  const shown = (value: number) => String(Math.round(value * 1000) / 1000 + 0);
  return element("span", { class: "ramp" }, `${meaning} ${shown(least)} `, bar, ` ${shown(greatest)} ${meaning === "feed" ? "" : units}`.trimEnd());
}
