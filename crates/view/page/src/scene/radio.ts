// Radio: links as lines that fade with their signal, packets as pulses from the sender to those who hear it.

import { fixed } from "../core/format";
import type { Link, Packet } from "../wire";
import { SCALES, colourOf, table } from "./colours";
import type { Frames } from "./frames";
import type { Shared } from "./light";
import { Lines } from "./lines";
import { clamp } from "./math";

/** What is drawn as no signal and as a full one, dBm. */
const WEAK_DBM = -95;
const STRONG_DBM = -45;
const MOST_LINKS = 12_000;
const SIGNAL = table(SCALES.signal);
const SIGNAL_DARK = table(SCALES.signalDark);
/** How long a pulse is under way, wall s; the second where time runs slowly. */
const PULSE_S = 0.35;
const SLOW_PULSE_S = 1;
/** It lives so many times as long as a picture takes, up to this: one that is never drawn is none. */
const PULSE_PICTURES = 4.5;
const LONGEST_PULSE_S = 4;
const PULSE = "#d9006c";
const PULSE_DARK = "#ffd166";
const MOST_PULSES = 4096;
/** Of one packet so many receivers are shown. */
const MOST_RECEIVERS = 40;
/** In one go so many pulses begin. */
const MOST_AT_ONCE = 700;

/** The colours of links from the weakest signal to the strongest, as CSS, and which these are. */
export function linkScale(dark: boolean): { stops: string[]; low: string; high: string } {
  const colours = dark ? SCALES.signalDark : SCALES.signal;
  const stops = colours.map((colour, at) => {
    const [r, g, b] = colourOf(colour);
    return `rgb(${r} ${g} ${b} / ${opacity(at / (colours.length - 1)).toFixed(2)})`;
  });
  return { stops, low: fixed(WEAK_DBM, 0), high: `${fixed(STRONG_DBM, 0)}\u00a0dBm` };
}

/** How opaque a link of this strength is, where there is none beside it and all frames arrive. */
function opacity(strength: number): number {
  return 0.16 + 0.84 * strength;
}

/** 0 (weak) to 1 (strong). */
export function strength(rssi_dbm: number): number {
  return Number.isFinite(rssi_dbm) ? clamp((rssi_dbm - WEAK_DBM) / (STRONG_DBM - WEAK_DBM), 0, 1) : 0.5;
}

export class Radio {
  readonly links: Lines;
  readonly pulses: Lines;
  /** What is drawn. */
  shown: Link[] = [];
  private until = 0;
  private dark = false;
  private last: [Link[], number] = [[], 0];
  private rgba = new Uint8Array(4);

  constructor(frames: Frames, shared: Shared) {
    this.links = new Lines(MOST_LINKS, frames, shared, { width_px: 1.5, order: 12 });
    this.pulses = new Lines(MOST_PULSES, frames, shared, { width_px: 3.4, pulse: true, order: 14 });
  }

  setDark(dark: boolean): void {
    this.dark = dark;
    this.setLinks(...this.last);
  }

  setLinks(list: Link[], count: number): void {
    this.last = [list, count];
    const colours = this.dark ? SIGNAL_DARK : SIGNAL;
    this.links.clear();
    const whole = list.filter((link) => link[0] < count && link[1] < count && link[0] >= 0 && link[1] >= 0);
    // The strongest, if there are too many; and the more there are, the fainter each.
    const shown = whole.length > MOST_LINKS ? [...whole].sort((a, b) => b[2] - a[2]).slice(0, MOST_LINKS) : whole;
    const crowd = clamp(1.2 - 0.15 * Math.log10(Math.max(shown.length, 1)), 0.3, 1);
    for (const link of shown) {
      const s = strength(link[2]);
      const opaque = opacity(s) * (0.35 + 0.65 * clamp(link[3], 0, 1)) * crowd;
      const at = 3 * Math.round(255 * s);
      for (let k = 0; k < 3; k++) this.rgba[k] = colours[at + k]!;
      this.rgba[3] = Math.round(255 * opaque);
      this.links.add(link[0], link[1], this.rgba);
    }
    this.shown = shown;
    this.links.set("uWidth", shown.length < 200 ? 1 : 0.65);
    this.links.flush();
  }

  /** `now`: wall s; `picture_s`: how long a picture takes. */
  addPackets(list: Packet[], count: number, now: number, speed: number, picture_s: number): void {
    const usual = speed > 0 ? clamp(PULSE_S / speed, PULSE_S, SLOW_PULSE_S) : SLOW_PULSE_S;
    const lasts = Math.max(usual, Math.min(PULSE_PICTURES * picture_s, LONGEST_PULSE_S));
    let left = MOST_AT_ONCE;
    const each = Math.max(1, Math.min(MOST_RECEIVERS, Math.floor(left / Math.max(list.length, 1))));
    const rgb = colourOf(this.dark ? PULSE_DARK : PULSE);
    let first = -1;
    let added = 0;
    for (const packet of list) {
      if (packet.from >= count) continue;
      const step = Math.max(1, Math.ceil(packet.to.length / each));
      for (let i = 0; i < packet.to.length && left > 0; i += step) {
        const [to, rssi] = packet.to[i]!;
        if (to >= count) continue;
        const s = strength(rssi);
        this.rgba.set(rgb);
        this.rgba[3] = 120 + 135 * s;
        const slot = this.pulses.add(packet.from, to, this.rgba, now, lasts);
        if (first < 0) first = slot;
        added++;
        left--;
      }
    }
    if (added > 0) {
      this.pulses.flush(first, added);
      this.until = Math.max(this.until, now + lasts);
    }
  }

  /** Whether pulses are under way. */
  busy(now: number): boolean {
    return now <= this.until + 0.05;
  }

  dispose(): void {
    this.links.dispose();
    this.pulses.dispose();
  }
}
