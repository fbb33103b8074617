// A run as it goes on. Frames come ten or thirty times a second, some early, some late; what is shown runs evenly
// behind the newest, as far as they have lately been late, and never back. It has a clock of its own, which is only
// ever drawn towards where it ought to be.

import type { Frame, Packet, PageMessage } from "../wire";
import type { Moment, Player } from "./index";

/** Frames that come later than this are a new beginning, not the next step of a motion. */
const LONGEST_STRIDE_MS = 1000;
const USUAL_STRIDE_MS = 33;
/** Means are of the last few frames: each takes this part of the newest. */
const NEW = 0.15;
/** How soon the clock is where it ought to be. */
const SETTLE_MS = 250;
/** Farther behind than so many strides it does not catch up: it jumps. */
const FARTHEST_STRIDES = 6;

export class LivePlayer implements Player {
  /** In the order of time; what is shown lies between the first two, or at the last. */
  private queue: Frame[] = [];
  private shown_s = 0;
  private arrived_ms = 0;
  private advanced_ms = 0;
  /** Wall time between frames, how much single ones are off, and virtual time between them: means. */
  private stride_ms = USUAL_STRIDE_MS;
  private off_ms = 0;
  private stride_s = 0;
  private drawn = true;
  private jumped = false;
  private toThank: number[] = [];
  private packets: Packet[] = [];

  constructor(private readonly send: (message: PageMessage) => void) {}

  get frame(): Frame | null {
    return this.queue.at(-1) ?? null;
  }

  get busy(): boolean {
    return !this.drawn;
  }

  take(frame: Frame, now_ms: number): void {
    const before = this.frame;
    if (this.drawn || this.stride_s === 0) this.advanced_ms = now_ms;
    if (!before || frame.time < before.time || frame.n !== before.n) {
      this.jumped = before !== null;
      this.queue = [frame];
      this.shown_s = frame.time;
      this.stride_s = 0;
    } else if (frame.time === before.time) {
      // The same instant once more, in other colours.
      this.queue[this.queue.length - 1] = frame;
    } else {
      this.queue.push(frame);
      this.measure(frame.time - before.time, now_ms - this.arrived_ms);
    }
    this.arrived_ms = now_ms;
    this.drawn = false;
    this.toThank.push(frame.time);
  }

  dropValues(): void {
    for (const frame of this.queue) frame.values = null;
  }

  hear(list: Packet[]): void {
    this.packets.push(...list);
  }

  advance(now_ms: number): Moment | null {
    const newest = this.frame;
    if (!newest || this.drawn) return null;
    this.walk(newest, now_ms);
    const { queue, shown_s } = this;
    while (queue.length > 2 && queue[1]!.time <= shown_s) queue.shift();
    const a = queue[0]!;
    const b = queue[1] ?? a;
    this.drawn = shown_s >= newest.time;
    const f = b.time > a.time ? Math.min(1, (shown_s - a.time) / (b.time - a.time)) : 0;
    const moment = { a, b, f, t_s: shown_s, jumped: this.jumped, past: null, packets: this.packetsUntil(this.drawn ? Infinity : shown_s) };
    this.jumped = false;
    // Only what was drawn is answered: a page in the background is sent no more.
    for (const time_s of this.toThank) this.send({ type: "got", time_s });
    this.toThank.length = 0;
    return moment;
  }

  private measure(stride_s: number, since_ms: number): void {
    if (since_ms > LONGEST_STRIDE_MS || this.stride_s === 0) {
      // The first step after a rest is as long as steps usually are, however long the rest was.
      this.stride_s = stride_s;
      if (since_ms > LONGEST_STRIDE_MS) [this.stride_ms, this.off_ms] = [USUAL_STRIDE_MS, 0];
      return;
    }
    this.off_ms += NEW * (Math.abs(since_ms - this.stride_ms) - this.off_ms);
    this.stride_ms += NEW * (Math.max(since_ms, 1) - this.stride_ms);
    this.stride_s += NEW * (stride_s - this.stride_s);
  }

  /** Moves the clock of what is shown. */
  private walk(newest: Frame, now_ms: number): void {
    const passed_ms = Math.max(0, now_ms - this.advanced_ms);
    this.advanced_ms = now_ms;
    const rate = this.stride_s / this.stride_ms;
    // One stride behind, and as much more as frames have lately been off.
    const behind_ms = this.stride_ms + Math.min(2 * this.off_ms, 2 * this.stride_ms);
    const due_s = newest.time + rate * (now_ms - this.arrived_ms - behind_ms);
    let next_s = this.shown_s + rate * passed_ms;
    next_s += (due_s - next_s) * (1 - Math.exp(-passed_ms / SETTLE_MS));
    if (due_s - next_s > FARTHEST_STRIDES * this.stride_s) next_s = due_s;
    this.shown_s = Math.min(Math.max(next_s, this.shown_s), newest.time);
  }

  /** Packets are shown when their time has come. */
  private packetsUntil(t_s: number): Packet[] {
    if (this.packets.length === 0) return this.packets;
    const due = this.packets.filter((packet) => packet.t <= t_s);
    if (due.length > 0) this.packets = this.packets.filter((packet) => packet.t > t_s);
    return due;
  }
}
