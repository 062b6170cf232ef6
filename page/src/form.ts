// The parts of the page for a form and a job: the editor, the properties, the posts for an empty form, the stock, the times of the machine.

import "./form.css";
import { explain, layOut } from "./asked.ts";
import { solid } from "./backplot/solid.ts";
import { Editor } from "./editor.ts";
import { sourcesOf } from "./formats.ts";
import { Kit } from "./kit.ts";
import { Properties } from "./properties.ts";
import { takeTimes } from "./times.ts";

export class FormSide {
  readonly editor = new Editor(true);
  readonly properties = new Properties();
  readonly kit = new Kit();
  readonly sourcesOf = sourcesOf;
  readonly solid = solid;
  readonly takeTimes = takeTimes;
  readonly layOut = layOut;
  readonly explain = explain;

  constructor() {
    const { root } = this.editor;
    root.querySelector("h2")!.append(this.properties.button);
    root.querySelector(".editor")!.before(this.properties.root, this.kit.root);
  }
}
