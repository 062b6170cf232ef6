// Finds the lines of the form that determine the words of a block: letter formats and commands.

import type { Place } from "./scene.ts";

/** Commands that determine words, by a pattern for the beginning of the word. */
const COMMANDS: [word: RegExp, commands: string[]][] = [
  [/^N\d/, ["Sequence#s"]],
  [/^[IJKR][-+.\d]/, ["CtrCode", "CtrIncremental?", "ByQuadrants?"]],
  [/^G1[789]$/, ["ArcPlane"]],
  [/^G0*2$/, ["CW"]],
  [/^G0*3$/, ["CCW"]],
  [/^G0*0$/, ["Rapid"]],
  [/^G0*1$/, ["Feed"]],
  [/^G(2[01]|7[01])$/, ["Units", "Inch/MM"]],
  [/^G9[01]$/, ["Inc/Abs"]],
  [/^G9[89]$/, ["ReturnPlane"]],
  [/^G4[012]$/, ["CDC"]],
  [/^D\d/, ["CDCCode"]],
  [/^G0*4$/, ["Dwell"]],
  [/^M0*[345]$/, ["Spindle"]],
  [/^M0*[789]$/, ["Coolant"]],
  [/^(G5[4-9]|E\d)/, ["Work", "MoreWork"]],
];

/** A line of the form that determines a word. */
export interface Source {
  word: string;
  file: number;
  line: number;
  text: string;
}

/** The form lines that determine the words of a block; `texts` are those of the form's files. */
export function sourcesOf(block: string, formats: Record<string, Place>, texts: string[]): Source[] {
  const words = block.replace(/\([^)]*\)?|;.*/g, " ").match(/[A-Z][-+.\d]+/gi) ?? [];
  const found: Source[] = [];
  const add = (word: string, file: number, line: number) => {
    const text = texts[file]?.split("\n")[line]?.trim();
    if (text && !found.some((known) => known.file === file && known.line === line)) found.push({ word, file, line, text });
  };
  for (const word of words) {
    const place = formats[word[0].toUpperCase()];
    if (place) add(word, place[0], place[1]);
    for (const command of COMMANDS.filter(([begin]) => begin.test(word.toUpperCase())).flatMap(([, commands]) => commands)) {
      const line = (texts[0] ?? "").split("\n").findIndex((line) => line.trimStart().toLowerCase().startsWith(`${command.toLowerCase()} `));
      if (line >= 0) add(word, 0, line);
    }
  }
  return found;
}
