// Which flyers are near enough to be seen as they are: those whose radius on the screen is large enough, and of too
// many the largest.

/** From this radius on the screen on a flyer is seen as it is, CSS pixels. */
export const NEAR_PX = 9;
/** So many at most are drawn with all their details. */
export const MOST_NEAR = 500;
/** Beyond the edge of the picture, in halves of it. */
const MARGIN = 1.15;

/** What is looked through: places of two frames as they come from the program. */
export interface Swarm {
  a: { positions: ArrayLike<number>; n: number };
  b: { positions: ArrayLike<number>; n: number };
  f: number;
}

/**
 * Writes the numbers of the near ones of `who` to `out`, and returns how many there are. `view` is the column-major
 * view-projection; a radius of one metre at clip depth 1 is `scale` CSS pixels. Makes no garbage.
 */
export function findNear(swarm: Swarm, who: ArrayLike<number>, radii: ArrayLike<number>, view: ArrayLike<number>, scale: number, least_px: number, out: Float32Array): number {
  const { a, b, f } = swarm;
  const [p, q] = [a.positions, b.positions];
  const n = Math.min(a.n, b.n);
  const [x0, x1, x2, x3] = [view[0]!, view[4]!, view[8]!, view[12]!];
  const [y0, y1, y2, y3] = [view[1]!, view[5]!, view[9]!, view[13]!];
  const [w0, w1, w2, w3] = [view[3]!, view[7]!, view[11]!, view[15]!];
  let count = 0;
  for (let k = 0; k < who.length; k++) {
    const i = who[k]!;
    if (i >= n) continue;
    const x = p[3 * i]! + (q[3 * i]! - p[3 * i]!) * f;
    const y = p[3 * i + 1]! + (q[3 * i + 1]! - p[3 * i + 1]!) * f;
    const z = p[3 * i + 2]! + (q[3 * i + 2]! - p[3 * i + 2]!) * f;
    const w = w0 * x + w1 * y + w2 * z + w3;
    // NaN fails both.
    if (!(w > 0 && radii[i]! * scale >= least_px * w)) continue;
    if (Math.abs(x0 * x + x1 * y + x2 * z + x3) > MARGIN * w || Math.abs(y0 * x + y1 * y + y2 * z + y3) > MARGIN * w) continue;
    if (count < out.length) out[count] = i;
    count++;
  }
  return count;
}
