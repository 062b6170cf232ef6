// What files are called in little room.

/** Without its folders. */
export function base(name: string): string {
  return name.split(/[/\\]/).pop() ?? name;
}

/** A job is often called job.json: its folder says more. */
export function jobName(path: string): string {
  const parts = path.split(/[/\\]/);
  const name = parts[parts.length - 1].replace(/\.[^.]*$/, "");
  return name === "job" && parts.length > 1 ? parts[parts.length - 2] : name;
}
