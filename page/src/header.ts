// The head of the page: the form's name, the verdict, whether the program fits its machine, the counts of lint, and a tab for each job.

import { element } from "./element.ts";
import { base, jobName } from "./names.ts";
import type { Finding, Head, Verdict } from "./scene.ts";

/** A text that is shown in place of a verdict. */
export function without(text: string): Verdict {
  return { kind: "none", text, line: 0, help: "", allowed: [], findings: [] };
}

export class Header {
  readonly root: HTMLElement;
  readonly verdict = element("button", { class: "verdict" });
  readonly fit = element("button", { class: "fit", hidden: "" });
  readonly lint = element("button", { class: "lint" });
  readonly saving = element("button", { class: "save", hidden: "" }, "save");
  private readonly title = element("h1", {});
  private readonly tabs = element("div", { class: "tabs", role: "tablist", "aria-label": "Jobs" });
  private names: string[] = [];
  onJob: (job: number) => void = () => {};
  /** Called with the names of the tabs and the shown tab. */
  onTabs: (names: string[], job: number) => void = () => {};

  constructor() {
    this.root = element("header", {}, this.title, this.saving, this.verdict, this.fit, this.lint, this.tabs);
  }

  get jobs(): number {
    return this.tabs.childElementCount;
  }

  /** Shows names, counts and tabs. Returns whether the tabs changed. */
  show(head: Head, job: number): boolean {
    const form = head.form?.files[0];
    const names = [form && base(form), head.job.name && base(head.job.name)].filter(Boolean);
    document.title = `${names.join(" · ")} · postform`;
    this.title.textContent = form ? base(form) : base(head.job.name);
    this.showLint(head);
    const jobs = head.jobs ?? [];
    const changed = this.jobs !== jobs.length || jobs.some((name, i) => name !== this.names[i]);
    this.names = jobs;
    if (changed) {
      this.tabs.replaceChildren(...jobs.map((name, i) => {
        const tab = element("button", { role: "tab", class: "tab", title: name }, jobName(name), element("span", {}));
        tab.onclick = () => this.onJob(i);
        return tab;
      }));
    }
    [...this.tabs.children].forEach((tab, i) => tab.setAttribute("aria-selected", String(i === job)));
    this.tabs.hidden = jobs.length < 1;
    this.onTabs(jobs, job);
    return changed;
  }

  /** Shows the number of findings, and the first finding. */
  private showLint({ form, notes: printed = [], picture }: Head): void {
    this.lint.hidden = !form;
    if (!form) return;
    // findings of the form, and findings of printing the job with the form
    const of = (severity: Finding["severity"], ofForm: number) => ofForm + printed.filter((found) => found.severity === severity).length;
    // a block that the control refuses counts as an error
    const refused = picture?.refused;
    const [errors, warnings, notes] = [of("error", form.errors) + (refused ? 1 : 0), of("warning", form.warnings), of("note", form.notes)];
    const count = (number: number, what: string) => `${number} ${what}${number === 1 ? "" : "s"}`;
    const worst = errors ? "error" : warnings ? "warning" : "note";
    const first = [...form.findings, ...printed].find((found) => found.severity === worst) ?? (worst === "error" ? refused : undefined);
    const counts = [count(errors, "error"), count(warnings, "warning"), ...(notes ? [count(notes, "note")] : [])];
    this.lint.textContent = `${counts.join(", ")}${first ? `: ${first.message}` : ""}`;
    this.lint.title = first?.help ?? "";
    this.lint.setAttribute("aria-label", `${this.lint.textContent}; show the next finding`);
    this.lint.className = errors ? "lint bad" : warnings ? "lint warn" : "lint";
  }

  /** Forgets the tabs. The next scene contains the tabs of the new jobs. */
  forgetJobs(): void {
    this.tabs.replaceChildren();
  }

  /** Sets the mark in the tab of a job. */
  mark(job: number, verdict: Verdict | undefined): void {
    const mark = this.tabs.children[job]?.querySelector("span");
    if (!mark) return;
    const kind = verdict?.kind ?? "none";
    [mark.textContent, mark.className] = { proven: ["✓", "ok"], unproven: ["?", "warn"], different: ["✗", "bad"], none: ["–", "dim"] }[kind];
    mark.setAttribute("aria-label", verdict?.text ?? "no verdict");
    this.tabs.children[job].setAttribute("title", verdict?.text ?? "");
  }

  /** Shows the verdict of the current job, or the reason why the job has no program. */
  tell(job: number, verdict: Verdict | undefined, stopped?: Head["stopped"]): void {
    const class_ = { proven: "ok", unproven: "warn", different: "bad", none: "dim" }[verdict?.kind ?? "none"];
    this.verdict.className = `verdict ${stopped ? "bad" : class_}`;
    this.verdict.textContent = this.words(verdict, stopped);
    this.verdict.title = stopped ? (stopped.findings[0]?.help ?? "") : [verdict?.allowed.join("\n"), verdict?.help].filter(Boolean).join("\n");
    this.mark(job, stopped ? undefined : verdict);
  }

  /** The text of the verdict. The counts of findings already show the errors of the form. */
  private words(verdict: Verdict | undefined, stopped?: Head["stopped"]): string {
    if (!stopped) return verdict?.text ?? "";
    return stopped.by === "form" ? "no program: the form has errors" : `no program: ${stopped.findings[0]?.message ?? stopped.message}`;
  }

  /** Shows whether the program fits its machine; null: unknown. */
  showFit(fit: Head["fit"] | null): void {
    this.fit.hidden = !fit;
    this.fit.className = `fit ${fit?.kind ?? "dim"}`;
    this.fit.textContent = fit?.text ?? "";
    this.fit.title = fit?.more.join("\n") ?? "";
  }
}
