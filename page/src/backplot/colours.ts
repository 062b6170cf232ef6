// The colours of the page, from the style sheet.

export type Colour = [red: number, green: number, blue: number];

/** The number of tool colours; further tools repeat the colours. */
export const TOOLS = 8;

export interface Colours {
  tools: Colour[];
  rapid: Colour;
  old: Colour;
  lit: Colour;
  bad: Colour;
  paper: Colour;
  ink: Colour;
  dim: Colour;
  part: Colour;
  grid: Colour;
  stock: Colour;
  /** Colours of X, Y and Z. */
  axes: Colour[];
  /** Colours of a quantity, from the least value to the greatest. */
  ramp: Colour[];
}

/** The number of colours in the ramp. */
export const RAMP = 5;
/** Share by which the deepest cut fades into the background. */
export const FADE = 0.5;

export function colours(): Colours {
  const style = getComputedStyle(document.documentElement);
  const read = (name: string): Colour => {
    const value = style.getPropertyValue(name).trim().replace("#", "");
    const long = value.length === 3 ? [...value].map((c) => c + c).join("") : value;
    return [0, 2, 4].map((at) => parseInt(long.slice(at, at + 2), 16) / 255) as Colour;
  };
  return {
    tools: Array.from({ length: TOOLS }, (_, i) => read(`--t${i}`)),
    rapid: read("--rapid"),
    old: read("--old"),
    lit: read("--lite"),
    bad: read("--bad"),
    paper: read("--pane"),
    ink: read("--ink"),
    dim: read("--dim"),
    part: read("--part"),
    grid: read("--grid"),
    stock: read("--stock"),
    axes: ["--x", "--y", "--z"].map(read),
    ramp: Array.from({ length: RAMP }, (_, i) => read(`--r${i}`)),
  };
}

export function css(colour: Colour, alpha = 1): string {
  return `rgb(${colour.map((part) => Math.round(part * 255)).join(" ")} / ${alpha})`;
}

export function mix(a: Colour, b: Colour, share: number): Colour {
  return a.map((part, i) => part + (b[i] - part) * share) as Colour;
}

/** The colour for a value from 0 to 255. */
export function ofValue(colours: Colours, value: number): Colour {
  const at = (value / 255) * (RAMP - 1);
  const below = Math.min(RAMP - 2, Math.floor(at));
  return mix(colours.ramp[below], colours.ramp[below + 1], at - below);
}

/** A colour that fades with the depth of a cut: shade 255 is the highest cut, 0 the deepest. */
export function faded(colours: Colours, colour: Colour, shade: number): Colour {
  return mix(colour, colours.paper, FADE * (1 - shade / 255));
}

/** The index of a tool in one byte. If there are more tools than colours, tools share an index. */
export function inByte(tool: number): number {
  return tool && 1 + ((tool - 1) % TOOLS);
}

/** The colour of a tool by its index in the list of tools; index 0 means no tool. */
export function ofTool(colours: Colours, tool: number): Colour {
  return colours.tools[(tool + TOOLS - 1) % TOOLS];
}
