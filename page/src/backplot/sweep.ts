// The lowest height of a moving tool over a point.

/** Each narrowing shortens the interval by a third: 20 narrowings leave 1/3000 of the part of the path over a point. */
const NARROWINGS = 20;

/** Height of a tool's surface above its tip, at a distance from its axis of at most the radius. */
function rise(radius: number, corner: number, away: number): number {
  const beyond = away - (radius - corner);
  return beyond <= 0 ? 0 : corner - Math.sqrt(Math.max(0, corner * corner - beyond * beyond));
}

/**
 * The lowest height of a tool over a point, while its tip moves straight by (dx, dy, dz) from the height `from`; Infinity if the tool is never
 * over the point. `x` and `y`: the point relative to the start of the tip. `Shape::lowest` of src/stock/sweep.rs computes the same.
 */
export function lowest(radius: number, corner: number, x: number, y: number, from: number, dx: number, dy: number, dz: number): number {
  const length = dx * dx + dy * dy;
  if (length === 0) {
    const away = Math.hypot(x, y);
    return away <= radius ? from + Math.min(0, dz) + rise(radius, corner, away) : Infinity;
  }
  const nearest = (x * dx + y * dy) / length;
  const ox = x - nearest * dx;
  const oy = y - nearest * dy;
  const room = radius * radius - ox * ox - oy * oy;
  if (room < 0) return Infinity;
  // the part of the move during which the tool is over the point
  const reach = Math.sqrt(room / length);
  const first = nearest > reach ? nearest - reach : 0;
  const last = nearest + reach < 1 ? nearest + reach : 1;
  if (first > last) return Infinity;
  if (corner <= 0) return from + dz * (dz < 0 ? last : first);
  return lowestRounded(radius, corner, x, y, from, dx, dy, dz, nearest, first, last);
}

/** The lowest height of a tool with a rounded corner, between two fractions of the move. This is a separate function, because its closure would slow
 * down the calculation for other tools, too. */
function lowestRounded(radius: number, corner: number, x: number, y: number, from: number, dx: number, dy: number, dz: number, nearest: number, first: number, last: number): number {
  const height = (part: number) => from + dz * part + rise(radius, corner, Math.min(radius, Math.hypot(x - part * dx, y - part * dy)));
  if (dz === 0) return height(Math.max(first, Math.min(last, nearest)));
  // the height is a convex function of the fraction: the sum of a line and a rounded corner
  let low = first;
  let high = last;
  for (let i = 0; i < NARROWINGS; i++) {
    const third = (high - low) / 3;
    if (height(low + third) <= height(high - third)) high -= third;
    else low += third;
  }
  return Math.min(height((low + high) / 2), height(first), height(last));
}
