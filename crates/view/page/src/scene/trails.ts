// Where vehicles have been: the last seconds of each, fading.

import type { Frame } from "../wire";
import type { Frames } from "./frames";
import type { Shared } from "./light";
import { Lines } from "./lines";

/** Above so many vehicles only the selected one leaves a trail. */
const MOST_VEHICLES = 500;
/** How long a trail is, virtual s; longer if the frames are far apart. */
const SECONDS = 10;
const LEAST_POINTS = 30;
const MOST_POINTS = 75;

export class Trails {
  readonly lines: Lines;
  /** From the last point of each trail to where its vehicle is now. */
  readonly heads: Lines;
  private own: Lines;
  private ownHead: Lines;
  private who: number[];
  private last: Float64Array;
  private lastTime = NaN;
  private period = 0;
  private selected: number | null = null;
  private selectedLast: [number, number, number, number] | null = null;

  constructor(
    private frames: Frames,
    shared: Shared,
    private colourOf: (vehicle: number) => [number, number, number],
  ) {
    const n = frames.count;
    this.who = n <= MOST_VEHICLES ? Array.from({ length: n }, (_, i) => i) : [];
    const width_px = n <= 50 ? 2.6 : n <= 150 ? 2 : 1.4;
    this.lines = new Lines(Math.max(1, this.who.length * (MOST_POINTS + 2)), frames, shared, { width_px, fade_s: SECONDS, order: 8 });
    this.heads = new Lines(Math.max(1, this.who.length), frames, shared, { width_px, fade_s: SECONDS, order: 8 });
    this.own = new Lines(4000, frames, shared, { width_px: 3.4, fade_s: SECONDS, order: 9 });
    this.ownHead = new Lines(1, frames, shared, { width_px: 3.4, fade_s: SECONDS, order: 9 });
    this.last = new Float64Array(this.who.length * 4);
  }

  meshes(): Lines["mesh"][] {
    return [this.lines, this.heads, this.own, this.ownHead].map((l) => l.mesh);
  }

  clear(): void {
    for (const l of [this.lines, this.heads, this.own, this.ownHead]) l.clear();
    this.lastTime = NaN;
    this.selectedLast = null;
  }

  select(vehicle: number | null): void {
    if (vehicle === this.selected) return;
    this.selected = vehicle;
    this.own.clear();
    this.ownHead.clear();
    this.selectedLast = null;
  }

  /** After frames have changed: `a` has been passed. */
  passed(a: Frame): void {
    if (a.time < this.lastTime) this.clear();
    if (a.time === this.lastTime) return;
    const first = Number.isNaN(this.lastTime);
    if (!first) this.period = a.time - this.lastTime;
    if (!first && this.period < this.seconds() / MOST_POINTS) return;
    this.lastTime = a.time;
    let start = -1;
    let added = 0;
    for (let k = 0; k < this.who.length; k++) {
      const i = this.who[k]!;
      const p = this.pointOf(a, i);
      if (!p) continue;
      if (!first && this.last[4 * k + 3]! > 0) {
        const slot = this.lines.add(this.last.subarray(4 * k, 4 * k + 3), p, this.rgba(i), this.last[4 * k + 3]! - 1, a.time);
        if (start < 0) start = slot;
        added++;
      }
      this.last.set([...p, a.time + 1], 4 * k);
    }
    if (added > 0) this.lines.flush(start, added);
    const head = this.who.length > 0;
    if (head) {
      this.heads.clear();
      this.who.forEach((i, k) => this.heads.add(this.last.subarray(4 * k, 4 * k + 3), i, this.rgba(i), a.time, a.time + this.period));
      this.heads.flush();
    }
    this.ownPassed(a);
  }

  /** Before each picture. */
  update(): void {
    const now = this.frames.time();
    for (const l of [this.lines, this.heads, this.own, this.ownHead]) {
      l.set("uNow", now);
      l.set("uFade", this.seconds());
    }
    // The head ends where the vehicle is: its time is now, whatever the picture's fraction.
    this.heads.set("uNow", this.lastTime + this.period);
    this.ownHead.set("uNow", this.lastTime + this.period);
  }

  dispose(): void {
    for (const l of [this.lines, this.heads, this.own, this.ownHead]) l.dispose();
  }

  private ownPassed(a: Frame): void {
    const i = this.selected;
    const p = i === null ? null : this.pointOf(a, i);
    if (i === null || !p) return;
    const before = this.selectedLast;
    if (before) {
      const slot = this.own.add(before.slice(0, 3), p, [...this.colourOf(i), 255], before[3], a.time);
      this.own.flush(slot, 1);
    }
    this.selectedLast = [p[0], p[1], p[2], a.time];
    this.ownHead.clear();
    this.ownHead.add(p, i, [...this.colourOf(i), 255], a.time, a.time + this.period);
    this.ownHead.flush();
  }

  private seconds(): number {
    return Math.max(SECONDS, LEAST_POINTS * this.period);
  }

  private rgba(i: number): number[] {
    return [...this.colourOf(i), 215];
  }

  private pointOf(a: Frame, i: number): [number, number, number] | null {
    if (i >= a.n) return null;
    const p: [number, number, number] = [a.positions[3 * i]!, a.positions[3 * i + 1]!, a.positions[3 * i + 2]!];
    return p.every(Number.isFinite) ? p : null;
  }
}
