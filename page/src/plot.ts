// A page of `postform plot`: one file that contains its scene.

import { Page } from "./main.ts";
import { Scene } from "./scene.ts";

const text = document.getElementById("scene")!.textContent!.trim();
const bytes = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
const page = new Page(null, null);
Object.assign(window, { page });
page.show(new Scene(bytes.buffer));
