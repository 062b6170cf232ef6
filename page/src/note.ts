// The note about a block: its errors, its old text, its origin, and words that it does not print.

import { element } from "./element.ts";
import type { Marks } from "./marks.ts";
import { itemPath, type Program } from "./program.ts";
import { repeats } from "./repeats.ts";
import type { Finding, Fit, Verdict } from "./scene.ts";

/** Proposed form words for generated blocks, by the text of the block. */
const OWN: [RegExp, string][] = [
  [/^[(;]/, "CommentLine, or [optext] in Operation"],
  [/^M0?0$/, "Stop"],
  [/^M0?1$/, "OptStop, or Stop"],
  [/^G0?4\D/, "DwellBlock"],
  [/^(G5[4-9]|G15\d?|E\d+)(\.\d+)?( [HP]\d+)?$/, "WorkChange, or Upon [work]"],
  [/^(G9[67] )?S\d+( M0?[345])?$|^M0?[345]$/, "SpindleChange"],
  [/^M0?[789]$|^M8[89]$/, "CoolantChange"],
  [/^G9[3459]$/, "FeedModeChange"],
];

/** `formText`: the form line that printed the block. */
export function noteOf(program: Program, line: number, marks: Marks, formText: string): HTMLElement[] {
  const note: HTMLElement[] = [];
  const bad = marks.bad.get(line);
  if (bad) note.push(element("div", { class: "bad" }, bad.text), element("div", { class: "help" }, bad.help));
  const was = marks.against.get(line);
  if (was) note.push(element("div", {}, "before: ", ...(was.length ? struck(was.map((word) => ({ word }))) : ["nothing"])));
  const form = program.form(line);
  if (form) {
    const gone = repeats(formText, program.text(line), program, line);
    note.push(element("div", {}, `printed by line ${form.line + 1}: `, element("code", {}, formText.trim())));
    if (gone.length) {
      const why = gone.length === 1 ? `repeats: ${gone[0].why}` : "these values are still in force";
      note.push(element("div", { class: "gone" }, "not printed: ", ...struck(gone), why));
    }
  } else if (program.isTraced) {
    const block = program.text(line).replace(/^\s*N\d+\s*/, "");
    const own = OWN.find(([made]) => made.test(block))?.[1] ?? (program.item(line)?.point ? "a sequence for this kind of cycle, as Drill, Peck or Custom1" : undefined);
    note.push(element("div", { class: "gen" }, "no line of the form printed this block: postform made it from the job's item", own ? `; the form would print it by ${own}` : ""));
  }
  return note;
}

/** The reason why there is no program: each finding, its location in the job, and its help. */
export function stoppedNote(findings: Finding[]): HTMLElement[] {
  return findings.slice(0, 3).flatMap((found) => [
    element("div", { class: "bad" }, `${found.code}: ${found.message}`),
    element("div", { class: "help" }, [found.help, found.place && `at ${found.place}`].filter(Boolean).join(" · ")),
  ]);
}

/** Further text of a verdict: allowances and help. */
export function verdictNote(verdict: Verdict): HTMLElement[] {
  const lines = [...verdict.allowed.map((line) => `allowed: ${line}`), verdict.help].filter(Boolean);
  return [element("div", {}, verdict.text), ...lines.map((line) => element("div", { class: "help" }, line))];
}

/** Further text about a machine: times, ranges, and everything that is not checked. */
export function fitNote(fit: Fit): HTMLElement[] {
  const findings = fit.findings.map((found) => element("div", { class: found.severity === "error" ? "bad" : "warn" }, `${found.code}: ${found.message}`));
  return [element("div", {}, fit.text), ...findings, ...fit.more.map((line) => element("div", { class: "help" }, line))];
}

function struck(words: { word: string; why?: string }[]): (Node | string)[] {
  return words.flatMap(({ word, why }) => [element("s", why ? { title: why } : {}, word), " "]);
}

/** `block 41 of 99 · operations[2].path[0] · line 59 of the job`. */
export function whereOf(program: Program, line: number): string {
  const item = program.item(line);
  const job = item?.jobLine ? ` · line ${item.jobLine} of the job` : "";
  return `block ${line} of ${program.lines}${item ? ` · ${itemPath(item)}` : ""}${job}`;
}
