// The frames of a recording that are here, by the number of their tick.

import type { Frame } from "../wire";

/** All frames together take about this much memory. */
const MOST_BYTES = 192 * 1024 * 1024;

export class FrameCache {
  private readonly frames: (Frame | undefined)[];
  private readonly pinned = new Set<number>();
  private held = 0;
  /** Most frames that are kept. */
  private readonly most: number;

  constructor(
    readonly ticks_s: ArrayLike<number>,
    vehicles: number,
  ) {
    this.frames = new Array<Frame | undefined>(ticks_s.length);
    this.most = Math.max(64, Math.floor(MOST_BYTES / (40 * Math.max(vehicles, 1) + 200)));
  }

  get size(): number {
    return this.held;
  }

  get(tick: number): Frame | undefined {
    return this.frames[tick];
  }

  /** The last tick at or before a time; 0 if there is none. */
  tickAt(t_s: number): number {
    let low = 0;
    let high = this.ticks_s.length;
    // Half a nanosecond: times are whole nanoseconds, and come as decimal fractions.
    const limit = t_s + 0.5e-9;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (this.ticks_s[middle]! <= limit) low = middle + 1;
      else high = middle;
    }
    return Math.max(0, low - 1);
  }

  /** Keeps a frame; those farthest from `near` make room for it. A pinned one stays. */
  put(frame: Frame, near: number, pin: boolean): number {
    const tick = this.tickAt(frame.time);
    if (!this.frames[tick]) this.held += 1;
    this.frames[tick] = frame;
    if (pin) this.pinned.add(tick);
    if (this.held > this.most) this.makeRoom(near);
    return tick;
  }

  /** Nearest tick that is here, at or before `tick`; -1 if none is. */
  before(tick: number): number {
    for (let at = tick; at >= 0; at -= 1) if (this.frames[at]) return at;
    return -1;
  }

  /** Nearest tick that is here, after `tick`; -1 if none is. */
  after(tick: number): number {
    for (let at = tick + 1; at < this.frames.length; at += 1) if (this.frames[at]) return at;
    return -1;
  }

  dropValues(): void {
    for (const frame of this.frames) if (frame) frame.values = null;
  }

  clear(): void {
    this.frames.fill(undefined);
    this.pinned.clear();
    this.held = 0;
  }

  /** Shares of the recording that are here, for the time line: true for each of `cells` equal parts. */
  cover(cells: number): boolean[] {
    const covered = new Array<boolean>(cells).fill(false);
    const count = this.frames.length;
    if (count === 0) return covered;
    const from_s = this.ticks_s[0]!;
    const span_s = this.ticks_s[count - 1]! - from_s || 1;
    for (let tick = 0; tick < count; tick += 1) {
      if (!this.frames[tick]) continue;
      const cell = Math.floor(((this.ticks_s[tick]! - from_s) / span_s) * cells);
      covered[Math.min(cell, cells - 1)] = true;
    }
    return covered;
  }

  private makeRoom(near: number): void {
    const loose: number[] = [];
    for (let tick = 0; tick < this.frames.length; tick += 1) {
      if (this.frames[tick] && !this.pinned.has(tick)) loose.push(tick);
    }
    loose.sort((x, y) => Math.abs(y - near) - Math.abs(x - near));
    for (const tick of loose.slice(0, Math.ceil(this.most / 8))) {
      this.frames[tick] = undefined;
      this.held -= 1;
    }
  }
}
