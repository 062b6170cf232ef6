// Times from a machine file.

import type { Path, Scene } from "./scene.ts";

/**
 * Sets the times of a path to the times of the machine file, if the scene contains these times. A scene contains the lines of blocks in the order in
 * which the blocks ran, and the seconds to the end of each block. The time of a block is divided among its moves as in the program's own times.
 */
export function takeTimes(path: Path, scene: Scene): void {
  if (!scene.has("timedLine")) return;
  const lines = scene.array("timedLine", Uint32Array);
  const ends = scene.array("timedEnd", Float32Array);
  if (!lines.length) return;
  const { moves, moveLine, ownTime } = path;
  const times = new Float32Array(moves);
  const isTimed = new Uint8Array(lines.reduce((most, line) => Math.max(most, line), 0) + 1);
  for (const line of lines) isTimed[line] = 1;
  let [block, begin] = [0, 0];
  for (let first = 0; first < moves; ) {
    const line = moveLine[first];
    let last = first;
    while (last + 1 < moves && moveLine[last + 1] === line) last++;
    let end = begin;
    if (isTimed[line]) {
      while (block < lines.length && lines[block] !== line) begin = ends[block++];
      // the time of a repeated block includes all its runs up to the next block that moves
      const next = last + 1 < moves ? moveLine[last + 1] : 0;
      for (let at = block; at < lines.length && lines[at] !== next; at++) {
        if (lines[at] === line) [end, block] = [ends[at], at + 1];
      }
    }
    const [before, after] = [first > 0 ? ownTime[first - 1] : 0, ownTime[last]];
    for (let move = first; move <= last; move++) {
      const share = after > before ? (ownTime[move] - before) / (after - before) : 1;
      times[move] = begin + share * (end - begin);
    }
    begin = end;
    first = last + 1;
  }
  if (path.isTimed && times.every((time, move) => time === path.moveTime[move])) return;
  path.moveTime = times;
  path.isTimed = true;
}
