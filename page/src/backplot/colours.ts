// The colours of the page, as the style sheet says them.

export type Colour = [red: number, green: number, blue: number];

/** How many colours tools have; then they begin again. */
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
}

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
  };
}

export function css(colour: Colour, alpha = 1): string {
  return `rgb(${colour.map((part) => Math.round(part * 255)).join(" ")} / ${alpha})`;
}

/** The colour of the tool at a place in the list of tools; the first is no tool. */
export function ofTool(colours: Colours, tool: number): Colour {
  return colours.tools[(tool + TOOLS - 1) % TOOLS];
}
