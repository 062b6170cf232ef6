// The functions for the stock of a path. Only a page with a job has tool diameters, which the stock needs.

import { drawRelief } from "./relief.ts";
import { Size } from "./size.ts";
import { blockOf, Stock } from "./stock.ts";

export const solid = { Stock, Size, blockOf, drawRelief };
export type Solid = typeof solid;
