// Commands: render, verify, diff, the page.

import { execFile, spawn } from "node:child_process";
import { basename, dirname } from "node:path";
import { promisify } from "node:util";
import * as vscode from "vscode";
import type { LanguageClient } from "vscode-languageclient/node";
import { Printed, jobs, program } from "./printed";

const run = promisify(execFile);

/** The form in front. */
function form(): vscode.Uri | undefined {
  const editor = vscode.window.activeTextEditor;
  if (editor?.document.languageId === "postform") {
    return editor.document.uri;
  }
  void vscode.window.showErrorMessage("Open a form (.pf) first.");
  return undefined;
}

/** The program of the current job beside the form, printed again as the form changes. */
export async function render(): Promise<void> {
  const uri = form();
  if (uri === undefined) {
    return;
  }
  const document = await vscode.workspace.openTextDocument(Printed.uri(uri, 0));
  await vscode.languages.setTextDocumentLanguage(document, "nc");
  await vscode.window.showTextDocument(document, { viewColumn: vscode.ViewColumn.Beside, preserveFocus: true });
}

/** The verdict of each job of the form. */
export async function verify(client: LanguageClient): Promise<void> {
  const uri = form();
  if (uri === undefined) {
    return;
  }
  const outcomes: string[] = [];
  // without a job of its own a form prints the built-in one
  const count = Math.max((await jobs(client, uri)).length, 1);
  for (let job = 0; job < count; job++) {
    const found = await program(client, uri, job);
    if (found !== undefined) {
      outcomes.push(`${found.name}: ${found.outcome}`);
    }
  }
  const text = outcomes.length > 0 ? outcomes.join("\n") : `${basename(uri.path)} prints nothing: look at its findings.`;
  const proven = outcomes.length > 0 && outcomes.every((outcome) => outcome.endsWith(", proven"));
  await (proven ? vscode.window.showInformationMessage(text) : vscode.window.showWarningMessage(text));
}

/** What the form as it is prints, beside what the committed one printed. */
export async function diff(printed: Printed): Promise<void> {
  const uri = form();
  if (uri === undefined) {
    return;
  }
  let committed: string;
  try {
    const where = { cwd: dirname(uri.fsPath), maxBuffer: 1 << 24 };
    committed = (await run("git", ["show", `HEAD:./${basename(uri.fsPath)}`], where)).stdout;
  } catch (error) {
    void vscode.window.showErrorMessage(`git has no committed ${basename(uri.fsPath)}: ${String(error).split("\n")[0]}`);
    return;
  }
  const before = printed.other(uri, 0, "HEAD", committed);
  const title = `${basename(uri.fsPath)}: last commit ↔ now`;
  await vscode.commands.executeCommand("vscode.diff", before, Printed.uri(uri, 0), title);
}

/** The page of the form, in the browser: `postform watch` says its address in its first line. */
export async function page(client: LanguageClient, path: string, context: vscode.ExtensionContext): Promise<void> {
  const uri = form();
  if (uri === undefined) {
    return;
  }
  let shown = await jobs(client, uri);
  if (shown.length === 0) {
    shown = (await vscode.window.showOpenDialog({ title: "A job for the page", canSelectMany: true })) ?? [];
  }
  if (shown.length === 0) {
    return;
  }
  const args = ["watch", uri.fsPath, "--no-open", ...shown.flatMap((job) => ["--job", job.fsPath])];
  const child = spawn(path, args, { cwd: vscode.workspace.getWorkspaceFolder(uri)?.uri.fsPath ?? dirname(uri.fsPath) });
  context.subscriptions.push({ dispose: () => void child.kill() });
  let said = "";
  let open = false;
  child.stderr.on("data", (data: Buffer) => (said += data.toString()));
  child.stdout.on("data", (data: Buffer) => {
    const address = /^https?:\S+/m.exec(data.toString())?.[0];
    if (!open && address !== undefined) {
      open = true;
      void vscode.env.openExternal(vscode.Uri.parse(address, true));
    }
  });
  child.on("error", (error) => void vscode.window.showErrorMessage(`postform watch can't be started: ${error.message}`));
  child.on("exit", (code) => {
    if (!open && code !== 0) {
      void vscode.window.showErrorMessage(`postform watch: ${said.trim() || `exit status ${code}`}`);
    }
  });
}
