// Requests to postform as WebAssembly, and its answers.

import { run } from "./wasi.js";

/** A text, and its name in messages. The name of a job determines the format of the job. */
export interface Text {
  name: string;
  text: string;
}

/** A finding about a form, a job or a program. */
export interface Finding {
  /** `PF101`: see docs/rules and docs/errors.md. */
  code: string;
  severity: "error" | "warning" | "note";
  message: string;
  /** The text to type instead. */
  help: string | null;
  file: string | null;
  /** The line, counted from 1. */
  line: number | null;
  /** The column in bytes, counted from 1. */
  column: number | null;
  /** The position in a job: `operations[0].path[3]`. */
  path: string | null;
  /** The line of the program, from 1. */
  program_line: number | null;
  /** The whole finding in one line. */
  text: string;
}

export interface Options {
  /** Values of properties of the form. */
  properties?: Record<string, string | number | boolean>;
  /** Values of variables and answers to the form's questions. */
  set?: Record<string, number>;
  /** The number of the program. */
  number?: number;
  /** Units of the program. */
  units?: "mm" | "inch";
  /** Units of a job that contains no units. */
  assumeUnits?: "mm" | "inch";
  /** The date, or the date and time, for forms that print it: `2026-03-31T14:05`. Default: the current date and time. */
  date?: string;
  /** Run the program and compare it with the job. */
  verify?: boolean;
}

/** A complete program. */
export interface Program {
  program: string;
  fileName: string;
  /** The verdict. It begins with `identical`, `equivalent` or `not proven`. */
  verdict: string;
  findings: Finding[];
}

/** The positions of the axes X Y Z A B C; null: only the machine has the position. */
export type Position = [number | null, number | null, number | null, number | null, number | null, number | null];

/** An action of the machine: its line, and the keys of its kind, as in the output of `postform simulate --format json`. */
export interface Action {
  /** The line of the program, from 1. */
  line: number;
  rapid?: Position;
  feed?: Position;
  /** The end of an arc; `center` and `plane` belong to it. */
  arc?: Position;
  center?: [number, number, number];
  plane?: "xy" | "zx" | "yz";
  turn?: "cw" | "ccw";
  turns?: number;
  /** The feed, or the lead of a thread. */
  f?: number;
  lead?: number;
  /** The axes whose position is that of the machine. */
  machine?: string;
  dwell?: number;
  spindle?: "cw" | "ccw" | "stop";
  s?: number;
  orient?: number;
  stop?: "program" | "optional" | "end";
  tool?: number;
  coolant?: "flood" | "mist" | "off";
  units?: "mm" | "inch";
  work?: number;
}

/** The actions of a machine that runs a program. */
export interface Simulated {
  actions: Action[];
  warnings: Finding[];
  /** The block that the control refuses; the program was run up to it. */
  refused: Finding | null;
}

/** The error if no program can be printed from a form, a job or an option, or if a program differs from its job. */
export class PostformError extends Error {
  /** The refused program, if there is one. */
  program?: string;
  verdict?: string;
  constructor(message: string, readonly findings: Finding[]) {
    super(message);
    this.name = "PostformError";
  }
}

/** The loaded postform. */
export class Postform {
  constructor(private readonly module: WebAssembly.Module) {}

  private async ask(request: object): Promise<any> {
    const answer = await run(this.module, new TextEncoder().encode(JSON.stringify(request)));
    const value = JSON.parse(new TextDecoder().decode(answer));
    if (value.error !== undefined) throw new PostformError(value.error, value.findings);
    return value;
  }

  /** Every finding of a form; `files` are the forms that this form calls, by their names. */
  async lint(form: Text, files: Record<string, string> = {}): Promise<Finding[]> {
    return (await this.ask({ command: "lint", form, files })).findings;
  }

  /** Prints a job and verifies the program. */
  async render(form: Text, job: Text, options: Options = {}, files: Record<string, string> = {}): Promise<Program> {
    const now = new Date(Date.now() - new Date().getTimezoneOffset() * 60_000).toISOString().slice(0, 16);
    const { refused, ...program } = await this.ask({ command: "render", form, files, job, options: { date: now, ...options } });
    if (refused) {
      const error = new PostformError(program.verdict, program.findings);
      throw Object.assign(error, { program: program.program, verdict: program.verdict });
    }
    return program;
  }

  /** Runs a program by the rules of a control, such as `haas`. With `startUnknown`, positions that depend on the start position are null. */
  async simulate(program: string, options: { control?: string; units?: "mm" | "inch"; startUnknown?: boolean } = {}): Promise<Simulated> {
    const { control, units, startUnknown } = options;
    return this.ask({ command: "simulate", program, control, startUnknown, options: { units } });
  }

  /** The verdict about a program; it may be `different`. */
  async verify(form: Text, job: Text, program: string, options: Pick<Options, "assumeUnits"> = {}): Promise<string> {
    return (await this.ask({ command: "verify", form, job, program, options })).verdict;
  }
}
