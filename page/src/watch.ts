// The page of `postform watch`.

import { FormSide } from "./form.ts";
import { Server } from "./host.ts";
import { JobTabs } from "./jobs.ts";
import { Page } from "./main.ts";
import { takeDrops } from "./opening.ts";

const host = new Server();
const page = new Page(host, new FormSide());
const jobs = new JobTabs(page, host);
Object.assign(window, { page });
takeDrops("drop jobs (.json, .jsonl, .cl, .apt, .nci, .FCStd, .nc)", (files) => void jobs.open(files));
void page.load();
