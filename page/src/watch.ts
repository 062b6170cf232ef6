// The page of `postform watch`.

import { Editor } from "./editor.ts";
import { Server } from "./host.ts";
import { Page } from "./main.ts";

const page = new Page(new Server(), new Editor(true));
Object.assign(window, { page });
void page.load();
