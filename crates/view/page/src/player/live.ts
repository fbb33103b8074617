// A run as it goes on: the two newest frames, and between them by the wall clock. What is shown is thus one
// frame behind, and moves evenly although frames come ten or thirty times a second.

import type { Frame, Packet, PageMessage } from "../wire";
import type { Moment, Player } from "./index";

/** Frames that come later than this are a new beginning, not the next step of a motion. */
const LONGEST_STRIDE_MS = 1000;
const USUAL_STRIDE_MS = 33;

export class LivePlayer implements Player {
  private a: Frame | null = null;
  private b: Frame | null = null;
  private arrived_ms = 0;
  private stride_ms = USUAL_STRIDE_MS;
  private drawn = true;
  private jumped = false;
  private toThank: number[] = [];
  private packets: Packet[] = [];

  constructor(private readonly send: (message: PageMessage) => void) {}

  get frame(): Frame | null {
    return this.b;
  }

  get busy(): boolean {
    return !this.drawn;
  }

  take(frame: Frame, now_ms: number): void {
    const since_ms = now_ms - this.arrived_ms;
    if (since_ms > LONGEST_STRIDE_MS) {
      this.stride_ms = USUAL_STRIDE_MS;
    } else {
      // A mean of the last few: the network and the garbage collector make single frames late.
      this.stride_ms += 0.2 * (Math.max(since_ms, 1) - this.stride_ms);
    }
    if (this.b && (frame.time < this.b.time || frame.n !== this.b.n)) this.jumped = true;
    this.a = this.b && !this.jumped ? this.b : frame;
    this.b = frame;
    this.arrived_ms = now_ms;
    this.drawn = false;
    this.toThank.push(frame.time);
  }

  hear(list: Packet[]): void {
    this.packets.push(...list);
  }

  advance(now_ms: number): Moment | null {
    if (!this.a || !this.b || this.drawn) return null;
    const f = Math.min(1, (now_ms - this.arrived_ms) / this.stride_ms);
    this.drawn = f >= 1;
    const moment = {
      a: this.a,
      b: this.b,
      f,
      t_s: this.a.time + f * (this.b.time - this.a.time),
      jumped: this.jumped,
      packets: this.packets,
    };
    this.jumped = false;
    this.packets = [];
    // Only what was drawn is answered: a page in the background is sent no more.
    for (const time_s of this.toThank) this.send({ type: "got", time_s });
    this.toThank = [];
    return moment;
  }
}
