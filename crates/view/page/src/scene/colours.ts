// Colours for kinds and for numbers: palettes that people with any colour vision can tell apart.

import { clamp, niceBelow } from "./math";

/** Red, green, blue, 0 to 255 each. */
export type Rgb = [number, number, number];

/** What cannot be coloured: NaN, no value. */
export const GREY: Rgb = [148, 148, 148];

/** Kinds, in the order in which they come: after Okabe and Ito, made to stand out on grass and on night. */
export const KINDS: readonly string[] = [
  "#ffb000", "#3da5ff", "#ff5c4d", "#00c2a0", "#e06bd0", "#fff27a", "#8f7bff", "#ff9ec0", "#a3e635", "#c8c8d0",
];

const VIRIDIS = ["#440154", "#472d7b", "#3b528b", "#2c728e", "#21918c", "#28ae80", "#5ec962", "#addc30", "#fde725"];
const PLASMA = ["#3b0f9b", "#6a00a8", "#900da4", "#b12a90", "#cc4778", "#e16462", "#f2844b", "#fca636", "#fcce25", "#f0f921"];
const CHARGE = ["#c1121f", "#e8590c", "#f9a03f", "#fde2a0", "#a8d5e5", "#5fa8d3", "#1d6fb8"];
const SIGNAL = ["#8a7f9e", "#6a66b8", "#3f4fd0", "#0b2bd0"];
const SIGNAL_DARK = ["#7d88a8", "#86b4e0", "#a5e6ff", "#f2fdff"];

/** Colours from low to high. */
export const SCALES = {
  value: VIRIDIS,
  speed: PLASMA,
  battery: CHARGE,
  /** Radio, before light and before dark. */
  signal: SIGNAL,
  signalDark: SIGNAL_DARK,
} as const;

/** `#rrggbb` or `#rrggbbaa` as red, green, blue, opacity, 0 to 255 each; null if it is neither. */
export function parseColour(text: string): [number, number, number, number] | null {
  if (!/^#([0-9a-f]{6}|[0-9a-f]{8})$/i.test(text)) return null;
  const n = (at: number): number => parseInt(text.slice(at, at + 2), 16);
  return [n(1), n(3), n(5), text.length === 9 ? n(7) : 255];
}

/** As `parseColour`, and grey for what is no colour. */
export function colourOf(text: string): [number, number, number, number] {
  return parseColour(text) ?? [GREY[0], GREY[1], GREY[2], 255];
}

/** The colour of a number between 0 and 1; below and above are as the ends, NaN is grey. */
export function sample(stops: readonly string[], x: number): Rgb {
  if (!Number.isFinite(x)) return GREY;
  const at = clamp(x, 0, 1) * (stops.length - 1);
  const i = Math.min(Math.floor(at), stops.length - 2);
  const a = colourOf(stops[i]!);
  const b = colourOf(stops[i + 1]!);
  const f = at - i;
  return [0, 1, 2].map((c) => Math.round(a[c]! + (b[c]! - a[c]!) * f)) as Rgb;
}

/** 256 colours of a scale, red, green, blue each: a table for many vehicles. */
export function table(stops: readonly string[]): Uint8Array {
  const out = new Uint8Array(256 * 3);
  for (let i = 0; i < 256; i++) out.set(sample(stops, i / 255), i * 3);
  return out;
}

/**
 * Where most of the finite values lie: from the 2nd to the 98th percentile, rounded outward to round numbers so that
 * a legend does not flicker. Null if there are none.
 */
export function robustRange(values: ArrayLike<number>): [number, number] | null {
  const step = Math.max(1, Math.floor(values.length / 4000));
  const some: number[] = [];
  for (let i = 0; i < values.length; i += step) if (Number.isFinite(values[i]!)) some.push(values[i]!);
  if (some.length === 0) return null;
  some.sort((a, b) => a - b);
  const last = some.length - 1;
  let low = some[Math.floor(0.02 * last)]!;
  let high = some[Math.ceil(0.98 * last)]!;
  if (!(high > low)) {
    const half = Math.max(Math.abs(low) * 0.05, 1e-9);
    low -= half;
    high += half;
  }
  const unit = niceBelow((high - low) / 4);
  // Round off what binary fractions add: 0.30000000000000004 is no number for a legend.
  const neat = (x: number): number => Number(x.toPrecision(12));
  return [neat(Math.floor(low / unit + 1e-9) * unit), neat(Math.ceil(high / unit - 1e-9) * unit)];
}

/**
 * A range that grows at once and shrinks only when less than half of it is in use, so that colours keep their meaning
 * while a run goes on.
 */
export function steadyRange(old: [number, number] | null, now: [number, number] | null): [number, number] | null {
  if (!now) return old;
  if (!old) return now;
  const used = (now[1] - now[0]) / (old[1] - old[0]);
  if (now[0] >= old[0] && now[1] <= old[1] && used >= 0.5) return old;
  if (now[1] < old[0] || now[0] > old[1] || used < 0.5) return now;
  return [Math.min(old[0], now[0]), Math.max(old[1], now[1])];
}

/** sRGB to light, 0 to 1, as shaders have it. */
export function linear(byte: number): number {
  return (byte / 255) ** 2;
}

/** How colourful a colour is: 0 grey, 1 pure. */
export function saturation(rgb: readonly number[]): number {
  const high = Math.max(rgb[0]!, rgb[1]!, rgb[2]!);
  const low = Math.min(rgb[0]!, rgb[1]!, rgb[2]!);
  return high > 0 ? (high - low) / high : 0;
}

export function css(rgb: readonly number[]): string {
  return "#" + rgb.slice(0, 3).map((c) => clamp(Math.round(c), 0, 255).toString(16).padStart(2, "0")).join("");
}
