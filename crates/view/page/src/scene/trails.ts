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
/** Of a trail where it is newest, 0 to 255. */
const OPACITY = 215;

/** How long trails are where frames are so far apart, virtual s. */
export function trailSeconds(period_s: number): number {
  return Math.max(SECONDS, LEAST_POINTS * period_s);
}

/** The shortest time between two points of a trail that is so long, s. */
export function trailStep(seconds: number): number {
  return seconds / MOST_POINTS;
}

export class Trails {
  readonly lines: Lines;
  /** From the last point of each trail to where its vehicle is now. */
  readonly heads: Lines;
  private own: Lines;
  private ownHead: Lines;
  private who: number[];
  private all: Lines[];
  /** The last point of each trail, and when it was there, s; below 0: there is none. */
  private points: Float64Array[];
  private times: Float64Array;
  private lastTime = NaN;
  private period = 0;
  private selected: number | null = null;
  private ownLast = new Float64Array(3);
  private ownTime = -1;
  private spot = new Float64Array(3);
  private colour = new Uint8Array(4);

  constructor(
    private frames: Frames,
    shared: Shared,
    /** Red, green, blue, opacity of each vehicle, as it is painted now. */
    private colours: Uint8Array,
  ) {
    const n = frames.count;
    this.who = n <= MOST_VEHICLES ? Array.from({ length: n }, (_, i) => i) : [];
    const width_px = n <= 50 ? 2.6 : n <= 150 ? 2 : 1.4;
    this.lines = new Lines(Math.max(1, this.who.length * (MOST_POINTS + 2)), frames, shared, { width_px, fade_s: SECONDS, order: 8 });
    this.heads = new Lines(Math.max(1, this.who.length), frames, shared, { width_px, fade_s: SECONDS, order: 8 });
    this.own = new Lines(4000, frames, shared, { width_px: 3.4, fade_s: SECONDS, order: 9 });
    this.ownHead = new Lines(1, frames, shared, { width_px: 3.4, fade_s: SECONDS, order: 9 });
    this.all = [this.lines, this.heads, this.own, this.ownHead];
    this.points = this.who.map(() => new Float64Array(3));
    this.times = new Float64Array(this.who.length).fill(-1);
  }

  meshes(): Lines["mesh"][] {
    return this.all.map((l) => l.mesh);
  }

  clear(): void {
    for (const l of this.all) l.clear();
    this.times.fill(-1);
    this.lastTime = NaN;
    this.ownTime = -1;
  }

  select(vehicle: number | null): void {
    if (vehicle === this.selected) return;
    this.selected = vehicle;
    this.own.clear();
    this.ownHead.clear();
    this.ownTime = -1;
  }

  /** All of them anew: where everybody has been, up to now. */
  retrace(past: Frame[]): void {
    this.clear();
    for (const frame of past) this.passed(frame);
  }

  /** After frames have changed: `a` has been passed. */
  passed(a: Frame): void {
    if (a.time < this.lastTime) this.clear();
    if (a.time === this.lastTime) return;
    const first = Number.isNaN(this.lastTime);
    if (!first) this.period = a.time - this.lastTime;
    if (!first && this.period < trailStep(this.seconds())) return;
    this.lastTime = a.time;
    const { who, points, times, spot } = this;
    let start = -1;
    let added = 0;
    this.heads.clear();
    for (let k = 0; k < who.length; k++) {
      const i = who[k]!;
      if (!this.read(a, i)) continue;
      const before = points[k]!;
      this.rgba(i, OPACITY);
      if (!first && times[k]! >= 0) {
        const slot = this.lines.add(before, spot, this.colour, times[k]!, a.time);
        if (start < 0) start = slot;
        added++;
      }
      before.set(spot);
      times[k] = a.time;
      this.heads.add(before, i, this.colour, a.time, a.time + this.period);
    }
    if (added > 0) this.lines.flush(start, added);
    if (who.length > 0) this.heads.flush();
    this.ownPassed(a);
  }

  /** Before each picture. */
  update(): void {
    const now = this.frames.time();
    const fade = this.seconds();
    for (const l of this.all) {
      l.set("uNow", now);
      l.set("uFade", fade);
    }
    // The head ends where the vehicle is: its time is now, whatever the picture's fraction.
    this.heads.set("uNow", this.lastTime + this.period);
    this.ownHead.set("uNow", this.lastTime + this.period);
  }

  dispose(): void {
    for (const l of this.all) l.dispose();
  }

  private ownPassed(a: Frame): void {
    const i = this.selected;
    if (i === null || !this.read(a, i)) return;
    this.rgba(i, 255);
    const { spot, ownLast } = this;
    if (this.ownTime >= 0) this.own.flush(this.own.add(ownLast, spot, this.colour, this.ownTime, a.time), 1);
    ownLast.set(spot);
    this.ownTime = a.time;
    this.ownHead.clear();
    this.ownHead.add(ownLast, i, this.colour, a.time, a.time + this.period);
    this.ownHead.flush();
  }

  private seconds(): number {
    return trailSeconds(this.period);
  }

  private rgba(i: number, opacity: number): void {
    const c = this.colours;
    for (let k = 0; k < 3; k++) this.colour[k] = c[4 * i + k]!;
    this.colour[3] = opacity;
  }

  /** Writes the place to `spot`; whether there is one. */
  private read(a: Frame, i: number): boolean {
    if (i >= a.n) return false;
    const { spot } = this;
    for (let k = 0; k < 3; k++) spot[k] = a.positions[3 * i + k]!;
    return Number.isFinite(spot[0]! + spot[1]! + spot[2]!);
  }
}
