// Short file names.

/** The name without its folders. */
export function base(name: string): string {
  return name.split(/[/\\]/).pop() ?? name;
}

/** The display name of a job: for a file called job.json, its folder. */
export function jobName(path: string): string {
  const parts = path.split(/[/\\]/);
  const name = parts[parts.length - 1].replace(/\.[^.]*$/, "");
  return name === "job" && parts.length > 1 ? parts[parts.length - 2] : name;
}
