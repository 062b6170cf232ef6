// Requests of the form pane to the host: the canonical layout, and the explanation of a code.

import type { Editor } from "./editor.ts";
import { element } from "./element.ts";
import type { Ask, Host } from "./host.ts";

/** Formats the form as `postform fmt` does. */
export async function layOut(editor: Editor, host: Host, ask: Ask): Promise<void> {
  const before = editor.text;
  const help = await host.help(ask, { file: editor.name, line: 0, column: 0, ask: "format" }).catch(() => null);
  // text that was typed in the meantime is not overwritten
  if (help?.text && editor.text === before) editor.layOut(help.text);
}

/** Shows the explanation of a code in a dialog. */
export async function explain(host: Host, job: number, code: string): Promise<void> {
  const help = await host.help({ job, texts: {} }, { file: code, line: 0, column: 0, ask: "explain" }).catch(() => null);
  const close = element("button", { autofocus: "" }, "close");
  const dialog = element("dialog", { "aria-label": `What ${code} means`, class: "explained" }, element("pre", {}, help?.text ?? `${code} has no explanation`), close);
  close.onclick = () => dialog.close();
  dialog.onclose = () => dialog.remove();
  document.body.append(dialog);
  dialog.showModal();
}
