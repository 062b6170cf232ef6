// The extension: a language client, and commands that ask the server. Everything that decides is in postform.

import * as vscode from "vscode";
import { LanguageClient, type LanguageClientOptions, type ServerOptions } from "vscode-languageclient/node";
import * as commands from "./commands";
import { Latest } from "./latest";
import { Printed, SCHEME } from "./printed";
import { find } from "./program";

let client: LanguageClient | undefined;
let path: string | undefined;

function settings(): Record<string, unknown> {
  const said = vscode.workspace.getConfiguration("postform");
  return { control: said.get("control"), job: said.get("job"), inlayHints: said.get("inlayHints") };
}

/** Milliseconds that settings may come late: a VS Code in a browser starts the extension before it has read those of the machine. */
const LATE = 2000;

const server = new Latest(async (isOutdated) => {
  await stop();
  await start(isOutdated);
});

/** What is wrong, with what to do: say where the program is, or try again when it was installed. */
async function failed(text: string): Promise<void> {
  const choice = await vscode.window.showErrorMessage(text, "Say where", "Try again");
  if (choice === "Say where") {
    await vscode.commands.executeCommand("workbench.action.openSettings", "postform.path");
  } else if (choice === "Try again") {
    await server.ask();
  }
}

async function start(isOutdated: () => boolean): Promise<void> {
  const folder = vscode.workspace.workspaceFolders?.[0]?.uri.fsPath;
  const setting = vscode.workspace.getConfiguration("postform").get<string>("path", "");
  path = await find(setting, folder);
  if (path === undefined) {
    await new Promise((later) => setTimeout(later, LATE));
    if (isOutdated()) {
      return;
    }
    const where = setting === "" ? "on the PATH or installed by pip" : `at ${setting}, where the setting postform.path says`;
    void failed(`postform is not ${where}. Install it with \`pip install postform\` or \`cargo install postform-cli\`, or say where it is.`);
    return;
  }
  const run: ServerOptions = { command: path, args: ["lsp"] };
  const options: LanguageClientOptions = {
    documentSelector: [
      { language: "postform" },
      { language: "nc", scheme: "file" },
      { language: "nc", scheme: SCHEME },
      { scheme: "file", pattern: "**/postform.toml" },
      { scheme: "file", pattern: "**/*.{json,jsonl,ndjson,cl,apt,aptsource,ncl,cls,cldata,as,nci}" },
    ],
    initializationOptions: { ...settings(), virtualPrograms: true },
  };
  const started = new LanguageClient("postform", "POSTFORM", run, options);
  try {
    await started.start();
    client = started;
  } catch (error) {
    await started.dispose().catch(() => undefined);
    void failed(`${path} does not start as a language server: ${error instanceof Error ? error.message : String(error)}`);
  }
}

async function stop(): Promise<void> {
  const old = client;
  client = undefined;
  await old?.stop();
}

export async function activate(context: vscode.ExtensionContext): Promise<void> {
  const printed = new Printed(() => client);
  const asking = (ask: (client: LanguageClient) => Promise<void>) => async () => {
    if (client !== undefined) {
      await ask(client);
    } else {
      void failed("postform does not run: its language server was not found, or did not start.");
    }
  };
  context.subscriptions.push(
    vscode.workspace.registerTextDocumentContentProvider(SCHEME, printed),
    vscode.workspace.onDidChangeTextDocument(({ document }) => {
      if (document.languageId === "postform") {
        printed.changed(document.uri);
      }
    }),
    vscode.workspace.onDidChangeConfiguration(async (change) => {
      if (change.affectsConfiguration("postform.path")) {
        await server.ask();
      } else if (change.affectsConfiguration("postform")) {
        await client?.sendNotification("workspace/didChangeConfiguration", { settings: { postform: settings() } });
      }
    }),
    vscode.commands.registerCommand("postform.render", asking(() => commands.render())),
    vscode.commands.registerCommand("postform.verify", asking(commands.verify)),
    vscode.commands.registerCommand("postform.diff", asking(() => commands.diff(printed))),
    vscode.commands.registerCommand("postform.page", asking((client) => commands.page(client, path ?? "postform", context))),
    vscode.commands.registerCommand("postform.restart", () => server.ask()),
  );
  await server.ask();
}

export async function deactivate(): Promise<void> {
  await stop();
}
