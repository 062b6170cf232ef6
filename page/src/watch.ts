// The page of `postform watch`.

import { FormSide } from "./form.ts";
import { Server } from "./host.ts";
import { Page } from "./main.ts";

const page = new Page(new Server(), new FormSide());
Object.assign(window, { page });
void page.load();
