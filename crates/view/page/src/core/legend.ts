// What colours mean, in words: for the panel, and for a saved picture.

import { count, fixed, number, unitWords } from "./format";
import type { ColourBy, Legend } from "../scene/index";

/** Kinds that a legend names; a list of more helps nobody. */
const MOST_NAMES = 12;

/** The ends of a scale, and its unit. */
export interface Ends {
  low: string;
  of: string;
  high: string;
}

/** Each kind with its colour and the number of its vehicles, and how many kinds are left out. */
export function kindsOf(legend: Legend, kinds: string[]): { list: { name: string; colour: string; times: string }[]; more: number } {
  const counts = new Map<string, number>();
  for (const kind of kinds) counts.set(kind, (counts.get(kind) ?? 0) + 1);
  const names = legend.names ?? [];
  const list = names.slice(0, MOST_NAMES).map(([name, colour]) => ({ name, colour, times: count(counts.get(name) ?? 0) }));
  return { list, more: Math.max(names.length - MOST_NAMES, 0) };
}

export function endsOf(legend: Legend, by: ColourBy): Ends {
  // A charge is a share of the whole.
  const share = by === "battery";
  const near = Math.max(Math.abs(legend.low), Math.abs(legend.high)) < 1000;
  const span = legend.high - legend.low;
  const end = (value: number) => (share ? `${fixed(100 * value, 0)} %` : near && span > 0 ? fixed(value, Math.max(0, 2 - Math.floor(Math.log10(span)))) : number(value));
  return { low: end(legend.low), of: share ? "charge" : unitWords(legend.unit), high: end(legend.high) };
}
