// What plays: a run as it goes on, or a recording.

import type { Frame, Packet } from "../wire";

/** What is to be drawn: the swarm at fraction `f` from `a` to `b`. */
export interface Moment {
  a: Frame;
  b: Frame;
  f: number;
  /** Virtual time, s. */
  t_s: number;
  /** Time did not flow to here. */
  jumped: boolean;
  /** Where everybody was before, in the order of time, where trails are to be drawn anew. */
  past: Frame[] | null;
  /** Packets on the air since the moment before. */
  packets: Packet[];
}

export interface Player {
  /** The frame that is nearest to what is shown. */
  readonly frame: Frame | null;
  /** What to draw at wall time `now_ms`; `null` if nothing has changed. */
  advance(now_ms: number): Moment | null;
  /** Whether `advance` will soon have more. */
  readonly busy: boolean;
  /** Colours of another number are to come: those of the frames that are here are none any more. */
  dropValues(): void;
}
