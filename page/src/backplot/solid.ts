// The stock of a path: only a page with a job has tools with diameters that cut it.

import { drawRelief } from "./relief.ts";
import { Size } from "./size.ts";
import { blockOf, Stock } from "./stock.ts";

export const solid = { Stock, Size, blockOf, drawRelief };
export type Solid = typeof solid;
