// Marks in the panes: differences from the job, changes since the last save and against an old program, findings.

import type { Program } from "./program.ts";
import type { Finding, Head } from "./scene.ts";

/** Marks at lines of the program. */
export interface Marks {
  /** Changed since the form was saved. */
  saved: Set<number>;
  /** Lines that differ from the compared program, with the old text. */
  against: Map<number, string[]>;
  /** Lines that differ from the job or are refused, with the reason and the help. */
  bad: Map<number, { text: string; help: string }>;
}

export function noMarks(): Marks {
  return { saved: new Set(), against: new Map(), bad: new Map() };
}

export function marksOf(head: Head, old: Program | null): Marks {
  const marks = noMarks();
  for (const [, , from, to] of head.saved?.hunks ?? []) {
    for (let line = from; line < Math.max(to, from + 1); line++) marks.saved.add(line + 1);
  }
  for (const [oldFrom, oldTo, from, to] of head.against?.hunks ?? []) {
    // block by block; the remaining old blocks are shown after the last line
    for (let line = from; line < Math.max(to, from + 1); line++) {
      const first = oldFrom + line - from;
      const last = line + 1 >= to ? oldTo : Math.min(first + 1, oldTo);
      const was: string[] = [];
      for (let at = first; at < Math.min(last, first + 6); at++) was.push(old?.text(at + 1) ?? "");
      marks.against.set(line + 1, was);
    }
  }
  for (const found of head.verdict?.findings ?? []) marks.bad.set(found.line, { text: `${found.code}: ${found.message}`, help: found.help });
  for (const found of head.fit?.findings ?? []) if (found.line) marks.bad.set(found.line, { text: `${found.code}: ${found.message}`, help: found.help });
  const refused = head.picture?.refused;
  if (refused?.line) marks.bad.set(refused.line, { text: `${refused.code}: ${refused.message}`, help: refused.help ?? "" });
  return marks;
}

/** The lines at which stepping through the marks stops: the first line of each run. */
export function stops(marks: Marks): number[] {
  const runs = [...marks.bad.keys(), ...starts(marks.against.keys()), ...starts(marks.saved)];
  return [...new Set(runs)].sort((a, b) => a - b);
}

function starts(lines: Iterable<number>): number[] {
  const sorted = [...lines].sort((a, b) => a - b);
  return sorted.filter((line, i) => i === 0 || sorted[i - 1] !== line - 1);
}

/** All findings of the form: from lint, from printing, differences from the job, and errors of the machine. */
export function findingsOf(head: Head): Finding[] {
  const printed = [...(head.notes ?? []), ...(head.stopped?.by === "job" ? head.stopped.findings : [])];
  const wrong = (head.verdict?.findings ?? []).map((found) => ({ severity: "error" as const, ...found }));
  const differences = [...wrong, ...(head.fit?.findings ?? [])].flatMap((found): Finding[] => {
    if (!found.form) return [];
    const message = `${found.message} (line ${found.line} of the program)`;
    const labels = [{ at: found.form, text: "prints this block" }];
    const { severity } = found;
    return [{ code: found.code, severity, message, help: found.help, labels, place: found.item, fix: null }];
  });
  return [...(head.form?.findings ?? []), ...printed.filter((found) => found.labels.length), ...differences];
}
