// What a chart is made of but its picture: how numbers of a series are shown, means over short times, and the
// labels and ends of axes.

import type { Line } from "./series";
import { fixed, number, time, unitWords } from "./format";

/** How the numbers of a series are shown: times a factor, with a unit. */
export interface Measure {
  times: number;
  unit: string;
  /** Where the numbers lie, if that is known: the whole of a share. */
  range: [number, number] | null;
}

/** Shares: of a whole, which is always in sight. */
const SHARE = /(^|\/)(delivery|soc)(\/mean)?$/;

export function measureOf({ about }: Line): Measure {
  if (about.name === "speed" && about.vehicle === null) return { times: 1, unit: "×", range: null };
  if (SHARE.test(about.name) && about.unit === "1") return { times: 100, unit: "%", range: [0, 100] };
  return { times: 1, unit: unitWords(about.unit), range: null };
}

/** A number of a series with its unit; without a number there is no unit. */
export function told(value: number | null, { unit }: Measure): string {
  if (value === null) return "–";
  const text = unit === "×" || unit === "%" ? fixed(value, value !== 0 && Math.abs(value) < 10 ? 2 : 1).replace(/\.0+$/, "") : number(value);
  return unit === "" ? text : `${text}\u00a0${unit}`;
}

/** The mean of each value and those less than a time before it. */
export function meanOver(times_s: number[], values: (number | null)[], span_s: number): (number | null)[] {
  let first = 0;
  return values.map((value, at) => {
    while (times_s[first]! <= times_s[at]! - span_s + 1e-9) first += 1;
    if (value === null) return null;
    // Summed anew each time: what is taken away from a sum again leaves crumbs behind.
    let sum = 0;
    let known = 0;
    for (let from = first; from <= at; from += 1) {
      const one = values[from];
      if (one === null || one === undefined) continue;
      sum += one;
      known += 1;
    }
    return sum / known;
  });
}

/** Decimals that tell steps of an axis apart. */
export function decimalsOf(step: number): number {
  for (let decimals = 0; decimals < 6; decimals += 1) {
    if (Math.abs(step * 10 ** decimals - Math.round(step * 10 ** decimals)) < 1e-6) return decimals;
  }
  return 6;
}

/** A label of an axis with as many digits as tell it from the next. */
export function labelOf(x: number, step: number): string {
  if (Math.abs(x) < step * 1e-6) return "0";
  if (step < 1e-4) return number(x, Math.min(Math.max(1, Math.ceil(Math.log10(Math.abs(x) / step)) + 1), 6));
  if (Math.abs(x) < 1000) return fixed(x, decimalsOf(step));
  // Thousands that tell the labels apart are short enough for the margin.
  if (step % 1000 === 0 && Math.abs(x) < 1e6) return `${fixed(x / 1000, 0)} k`;
  return number(x, Math.min(Math.max(3, Math.ceil(Math.log10(Math.abs(x) / step)) + 1), 9));
}

export function timeLabel(t_s: number, step_s: number): string {
  return time(t_s, Math.min(decimalsOf(step_s), 3));
}

/** Steps of a scale of time that people count in. */
export const timeSteps = [1e-4, 2e-4, 5e-4, 1e-3, 2e-3, 5e-3, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10, 15, 20, 30, 60, 120, 300, 600, 900, 1800, 3600, 7200, 14_400, 21_600, 43_200, 86_400, 172_800, 432_000, 864_000];

/** From the beginning of the run, if the first value is not long after it. */
export function timeRange(first_s: number | null, last_s: number | null): [number, number] {
  if (first_s === null || last_s === null) return [0, 1];
  return [first_s < 0.1 * last_s ? 0 : first_s, Math.max(last_s, first_s + 1e-3)];
}

/** More than the rest by this factor, and the rest would be a line at zero. */
const FLAT = 5;

/** The least and the greatest; what happened in the first moment only if it does not make flat all that came after. */
export function extentOf(times_s: number[], values: (number | null)[], first_s: number): [number | null, number | null] {
  const begun_s = (times_s[0] ?? 0) + first_s;
  let [low, high, later, count] = [Infinity, -Infinity, -Infinity, 0];
  values.forEach((value, at) => {
    if (value === null) return;
    low = Math.min(low, value);
    high = Math.max(high, value);
    if (times_s[at]! < begun_s) return;
    later = Math.max(later, value);
    count += 1;
  });
  if (low > high) return [null, null];
  return [low, count > 1 && later > 0 && high > FLAT * later ? later : high];
}

/** From zero, if that does not make the line flat; with some air above and below. */
export function rangeOf(low: number | null, high: number | null): [number, number] {
  if (low === null || high === null) return [0, 1];
  if (low === high) return low === 0 ? [0, 1] : low > 0 ? [0, low * 1.25] : [low * 1.25, 0];
  const air = (high - low) * 0.08;
  const bottom = low >= 0 && low < 0.6 * high ? 0 : low - air;
  const top = high <= 0 && high > 0.6 * low ? 0 : high + air;
  return [bottom, top];
}
