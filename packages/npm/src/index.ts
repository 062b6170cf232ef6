// The types of both entry points: node.ts and browser.ts.

export { Postform, PostformError } from "./postform.js";
export type { Finding, Options, Program, Text } from "./postform.js";

import type { Postform } from "./postform.js";

/** Loads postform. */
export declare function load(): Promise<Postform>;
