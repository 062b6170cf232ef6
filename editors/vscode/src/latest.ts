// One thing at a time.

/** Does something whenever it is asked to, never twice at once: what is asked for meanwhile is done once more, behind it. */
export class Latest {
  private running: Promise<void> | undefined;
  private again = false;

  /** `act` is told whether it is outdated already: then there is no use in saying what came of it. */
  constructor(private readonly act: (isOutdated: () => boolean) => Promise<void>) {}

  /** Until it was done as of now. */
  ask(): Promise<void> {
    this.again = true;
    this.running ??= this.all().finally(() => (this.running = undefined));
    return this.running;
  }

  private async all(): Promise<void> {
    while (this.again) {
      this.again = false;
      await this.act(() => this.again);
    }
  }
}
