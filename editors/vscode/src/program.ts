// The program postform: found, not carried.

import { execFile } from "node:child_process";
import { access, constants } from "node:fs/promises";
import { homedir } from "node:os";
import { delimiter, isAbsolute, join } from "node:path";
import { promisify } from "node:util";

const run = promisify(execFile);
const NAME = process.platform === "win32" ? "postform.exe" : "postform";

async function isProgram(path: string): Promise<boolean> {
  try {
    await access(path, constants.X_OK);
    return true;
  } catch {
    return false;
  }
}

async function first(paths: string[]): Promise<string | undefined> {
  for (const path of paths) {
    if (await isProgram(path)) {
      return path;
    }
  }
  return undefined;
}

/** Where pip puts programs: of this Python, and of this person. */
async function foldersOfPip(): Promise<string[]> {
  const ask = "import sysconfig, site, os; print(sysconfig.get_path('scripts')); print(os.path.join(site.USER_BASE, 'bin'))";
  for (const python of ["python3", "python", "py"]) {
    try {
      const { stdout } = await run(python, ["-c", ask], { timeout: 5000 });
      return stdout.split(/\r?\n/).filter((line) => line !== "");
    } catch {
      // the next one
    }
  }
  return [];
}

/** The program that a setting names, else the one on the PATH, else the one that pip installed. */
export async function find(setting: string, folder: string | undefined): Promise<string | undefined> {
  if (setting !== "") {
    const path = setting.replace(/^~(?=[\\/])/, homedir());
    return first([isAbsolute(path) ? path : join(folder ?? "", path)]);
  }
  const folders = (process.env["PATH"] ?? "").split(delimiter).filter((one) => one !== "");
  const known = [...folders, join(homedir(), ".cargo", "bin"), join(homedir(), ".local", "bin")];
  const found = await first(known.map((one) => join(one, NAME)));
  return found ?? first((await foldersOfPip()).map((one) => join(one, NAME)));
}
