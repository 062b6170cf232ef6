// The page of `postform watch`.

import { FormSide } from "./form.ts";
import { Server } from "./host.ts";
import { Page } from "./main.ts";
import { takeDrops } from "./opening.ts";

const page = new Page(new Server(), new FormSide());
Object.assign(window, { page });
takeDrops("drop jobs (.json, .jsonl, .cl, .apt, .nci, .FCStd, .nc)", (files) => void page.addJobs(files));
void page.load();
