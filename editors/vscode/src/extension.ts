// The extension: a language client, and commands that ask the server. Everything that decides is in postform.

import * as vscode from "vscode";
import { LanguageClient, type LanguageClientOptions, type ServerOptions } from "vscode-languageclient/node";
import * as commands from "./commands";
import { Printed, SCHEME } from "./printed";
import { find } from "./program";

let client: LanguageClient | undefined;
let path: string | undefined;

function settings(): Record<string, unknown> {
  const said = vscode.workspace.getConfiguration("postform");
  return { control: said.get("control"), job: said.get("job"), inlayHints: said.get("inlayHints") };
}

async function start(): Promise<void> {
  const folder = vscode.workspace.workspaceFolders?.[0]?.uri.fsPath;
  const setting = vscode.workspace.getConfiguration("postform").get<string>("path", "");
  path = await find(setting, folder);
  if (path === undefined) {
    const where = setting === "" ? "on the PATH or installed by pip" : `at ${setting}`;
    const choice = await vscode.window.showErrorMessage(
      `postform is not ${where}. Install it with \`pip install postform\` or \`cargo install postform\`, or say where it is.`,
      "Say where",
    );
    if (choice !== undefined) {
      await vscode.commands.executeCommand("workbench.action.openSettings", "postform.path");
    }
    return;
  }
  const server: ServerOptions = { command: path, args: ["lsp"] };
  const options: LanguageClientOptions = {
    documentSelector: [
      { language: "postform" },
      { language: "nc", scheme: "file" },
      { language: "nc", scheme: SCHEME },
      { scheme: "file", pattern: "**/postform.toml" },
      { scheme: "file", pattern: "**/*.{json,jsonl,cl,apt,aptsource,ncl,cls}" },
    ],
    initializationOptions: { ...settings(), virtualPrograms: true },
  };
  client = new LanguageClient("postform", "POSTFORM", server, options);
  await client.start();
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
        await stop();
        await start();
      } else if (change.affectsConfiguration("postform")) {
        await client?.sendNotification("workspace/didChangeConfiguration", { settings: { postform: settings() } });
      }
    }),
    vscode.commands.registerCommand("postform.render", asking(() => commands.render())),
    vscode.commands.registerCommand("postform.verify", asking(commands.verify)),
    vscode.commands.registerCommand("postform.diff", asking(() => commands.diff(printed))),
    vscode.commands.registerCommand("postform.page", asking((client) => commands.page(client, path ?? "postform", context))),
    vscode.commands.registerCommand("postform.restart", async () => {
      await stop();
      await start();
    }),
  );
  await start();
}

export async function deactivate(): Promise<void> {
  await stop();
}
