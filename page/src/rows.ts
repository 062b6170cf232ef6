// The rows of the program pane: the lines of the program, and between them the blocks that only the old program has.

import type { Hunks } from "./scene.ts";

/** Maximum number of rows of the old program; further rows are left out. */
const MOST = 10_000;

/** Blocks that only the old program has, and the line of the new program after which these blocks are shown. */
interface Gone {
  after: number;
  /** The first of these lines in the old program, from 1, and their number. */
  old: number;
  count: number;
  /** The row of the first block, from 0. */
  row: number;
}

export class Rows {
  private readonly gone: Gone[] = [];
  readonly count: number;

  constructor(private readonly lines: number, hunks: Hunks["hunks"]) {
    let rows = 0;
    for (const [oldFrom, oldTo, from, to] of hunks) {
      const count = Math.min(oldTo - oldFrom - (to - from), MOST - rows);
      if (count <= 0) continue;
      this.gone.push({ after: to, old: oldFrom + (to - from) + 1, count, row: to + rows });
      rows += count;
    }
    this.count = lines + rows;
  }

  /** The row of a line. */
  of(line: number): number {
    let before = 0;
    for (const gone of this.gone) {
      if (gone.after >= line) break;
      before += gone.count;
    }
    return line - 1 + before;
  }

  /** The line at a row, or the line of the old program. */
  at(row: number): { line: number } | { old: number } {
    let before = 0;
    for (const gone of this.gone) {
      if (gone.row > row) break;
      if (row < gone.row + gone.count) return { old: gone.old + row - gone.row };
      before += gone.count;
    }
    return { line: Math.min(this.lines, row - before + 1) };
  }
}
