// Programs that forms print, as documents that are in no file.

import * as vscode from "vscode";
import type { LanguageClient } from "vscode-languageclient/node";

export const SCHEME = "postform-program";

/** What the server says of a program. */
export interface Program {
  name: string;
  text: string;
  outcome: string;
}

/** The program of a form: of one of its jobs, or of another text of the form. */
export async function program(client: LanguageClient, form: vscode.Uri, job?: number, text?: string): Promise<Program | undefined> {
  const params = { uri: client.code2ProtocolConverter.asUri(form), job, text };
  return (await client.sendRequest<Program | null>("postform/program", params)) ?? undefined;
}

/** The files of the jobs that a form prints; none: it is the built-in one. */
export async function jobs(client: LanguageClient, form: vscode.Uri): Promise<vscode.Uri[]> {
  const params = { textDocument: { uri: client.code2ProtocolConverter.asUri(form) } };
  return (await client.sendRequest<string[]>("postform/jobs", params)).map((uri) => vscode.Uri.parse(uri));
}

/** Documents of programs: `postform-program:/shop/my.pf.nc?0`, and `?0,HEAD` for what the committed form prints. */
export class Printed implements vscode.TextDocumentContentProvider {
  private readonly change = new vscode.EventEmitter<vscode.Uri>();
  readonly onDidChange = this.change.event;
  /** Texts of forms that programs are printed with, where it is not the open one. */
  private readonly texts = new Map<string, string>();

  constructor(private readonly client: () => LanguageClient | undefined) {}

  static uri(form: vscode.Uri, job: number, of = ""): vscode.Uri {
    const query = of === "" ? `${job}` : `${job},${of}`;
    return form.with({ scheme: SCHEME, path: `${form.path}.nc`, query });
  }

  /** The form of a program's document. */
  static form(uri: vscode.Uri): vscode.Uri {
    return uri.with({ scheme: "file", path: uri.path.replace(/\.nc$/, ""), query: "" });
  }

  /** A document of the program that another text of the form prints. */
  other(form: vscode.Uri, job: number, of: string, text: string): vscode.Uri {
    const uri = Printed.uri(form, job, of);
    this.texts.set(uri.toString(), text);
    return uri;
  }

  async provideTextDocumentContent(uri: vscode.Uri): Promise<string> {
    const client = this.client();
    if (client === undefined) {
      return "";
    }
    const job = Number.parseInt(uri.query, 10) || 0;
    const found = await program(client, Printed.form(uri), job, this.texts.get(uri.toString()));
    return found?.text ?? "(the form prints no program: look at its findings)\n";
  }

  /** A form changed: its programs are asked for again. */
  changed(form: vscode.Uri): void {
    for (const document of vscode.workspace.textDocuments) {
      if (document.uri.scheme === SCHEME && Printed.form(document.uri).path === form.path) {
        this.change.fire(document.uri);
      }
    }
  }
}
