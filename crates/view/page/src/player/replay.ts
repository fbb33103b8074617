// A recording: frames are fetched where they are looked at and some way ahead, and stay in a cache. A jump
// shows at once the nearest frame that is here, then the one that was meant.

import { Signal } from "../core/signal";
import type { Frame, Packet, PageMessage } from "../wire";
import { FrameCache } from "./cache";
import type { Moment, Player } from "./index";

export interface Span {
  from_s: number;
  to_s: number;
  ticks_s: number[];
  period_s: number;
}

interface Fetch {
  id: number;
  why: "now" | "ahead" | "overview" | "behind";
  from_s: number;
  to_s: number;
  step_s: number;
  sent_ms: number;
}

/** Pictures a second that are worth fetching. */
const PICTURES_PER_S = 30;
/** How far ahead of the picture frames are fetched, in seconds of the wall clock. */
const AHEAD_S = 3;
/** Frames of the first look at the whole recording. */
const OVERVIEW = 40;
/** Links are told once a second or so. */
const AIR_S = 1.1;
const PATIENCE_MS = 15_000;
const MOST_PACKETS = 100_000;

export const speeds = [0.05, 0.1, 0.25, 0.5, 1, 2, 5, 10, 20, 50, 100];

function nameOf({ from_s, to_s, step_s }: Pick<Fetch, "from_s" | "to_s" | "step_s">): string {
  return `${from_s}/${to_s}/${step_s}`;
}

export class ReplayPlayer implements Player {
  readonly playing = new Signal(false);
  readonly speed = new Signal(1);
  /** The picture waits for frames. */
  readonly waiting = new Signal(false);
  readonly cache: FrameCache;
  private t_s: number;
  private shown: { a: Frame; b: Frame; f: number } | null = null;
  private dirty = true;
  private jumped = true;
  private last_ms: number | null = null;
  private fetch: Fetch | null = null;
  private fetches = 0;
  /** What the running fetch has brought; a fetch that brought nothing is not asked for again. */
  private brought = 0;
  private barren = "";
  private overview = false;
  /** Packets and links of this span are here. */
  private air = { from_s: Infinity, to_s: -Infinity };
  /** How much of the past is shown, by trails, s, and the time between two frames of it. */
  private past = { seconds: 0, step_s: 0 };
  /** It is shown as it was; the last of it that was fetched. */
  private traced = false;
  private behind = "";
  private packets: Packet[] = [];
  private packetsTo_s: number;

  constructor(
    readonly span: Span,
    vehicles: number,
    private readonly send: (message: PageMessage) => boolean,
  ) {
    this.cache = new FrameCache(span.ticks_s, vehicles);
    this.t_s = span.from_s;
    this.packetsTo_s = span.from_s;
  }

  get time_s(): number {
    return this.t_s;
  }

  get frame(): Frame | null {
    return this.shown ? (this.shown.f < 0.5 ? this.shown.a : this.shown.b) : null;
  }

  get busy(): boolean {
    return this.playing.value || this.dirty || this.waiting.value;
  }

  /** Frames are on their way, or are to be asked for. */
  get fetching(): boolean {
    return this.fetch !== null;
  }

  get atEnd(): boolean {
    return this.t_s >= this.span.to_s;
  }

  play(on: boolean): void {
    if (on && this.atEnd) this.seek(this.span.from_s);
    this.last_ms = null;
    this.playing.value = on && this.span.to_s > this.span.from_s;
    this.dirty = true;
    this.plan();
  }

  seek(t_s: number): void {
    const to_s = Math.min(Math.max(t_s, this.span.from_s), this.span.to_s);
    this.last_ms = null;
    this.traced &&= !this.playing.value && to_s === this.t_s;
    this.jumped ||= to_s < this.t_s || to_s > this.t_s + 2 * this.span.period_s;
    this.t_s = to_s;
    this.packetsTo_s = to_s - (this.jumped ? this.span.period_s : 0);
    this.dirty = true;
    this.plan();
  }

  /** Shows so many seconds before the time that is shown, from now on and now once more. */
  trace(seconds: number, step_s: number): void {
    this.past = { seconds, step_s: step_s > 1.5 * this.span.period_s ? step_s : 0 };
    this.traced = false;
    this.dirty = true;
    this.plan();
  }

  /** To the next tick, or the one before. */
  stepTick(by: 1 | -1): void {
    this.playing.value = false;
    const ticks = this.span.ticks_s;
    const here = this.cache.tickAt(this.t_s);
    const between = this.t_s > ticks[here]! + 1e-9;
    const next = by > 0 ? here + 1 : between ? here : here - 1;
    this.seek(ticks[Math.min(Math.max(next, 0), ticks.length - 1)] ?? this.t_s);
  }

  faster(by: 1 | -1): void {
    const now = this.speed.value;
    const next = by > 0 ? speeds.find((speed) => speed > now) : speeds.findLast((speed) => speed < now);
    if (next !== undefined) this.speed.value = next;
    this.plan();
  }

  /** All that is here was coloured by something else. */
  forget(): void {
    this.cache.clear();
    this.fetch = null;
    this.overview = false;
    this.behind = "";
    this.dirty = true;
    this.plan();
  }

  dropValues(): void {
    this.cache.dropValues();
  }

  take(frame: Frame): void {
    this.brought += 1;
    this.cache.put(frame, this.cache.tickAt(this.t_s), this.fetch?.why === "overview");
    this.dirty = true;
  }

  hear(list: Packet[]): void {
    if (list.length === 0) return;
    const newest_s = this.packets.at(-1)?.t ?? -Infinity;
    if (list[0]!.t > newest_s) this.packets.push(...list);
    else {
      // Fetched again, or from before: once each, in order.
      const known = new Set(this.packets.map((packet) => `${packet.t}/${packet.from}`));
      this.packets.push(...list.filter((packet) => !known.has(`${packet.t}/${packet.from}`)));
      this.packets.sort((x, y) => x.t - y.t);
    }
    if (this.packets.length > MOST_PACKETS) {
      const here = this.t_s;
      this.packets = this.packets.filter((packet) => Math.abs(packet.t - here) < 10 * this.span.period_s + 5);
    }
  }

  fetched(id: number): void {
    if (this.fetch?.id !== id) return;
    if (this.fetch.why === "overview") this.overview = true;
    else this.airIsHere(this.fetch);
    if (this.fetch.why === "behind") this.behind = nameOf(this.fetch);
    this.barren = this.brought > 0 ? "" : nameOf(this.fetch);
    this.fetch = null;
    this.dirty = true;
    this.plan();
  }

  /** The program could not do something: what was asked for may never come, and is not asked for again as it is. */
  failed(): void {
    if (!this.fetch) return;
    if (this.fetch.why === "overview") this.overview = true;
    if (this.fetch.why === "behind") this.behind = nameOf(this.fetch);
    this.barren = nameOf(this.fetch);
    this.fetch = null;
    this.dirty = true;
  }

  private airIsHere({ from_s, to_s }: Fetch): void {
    if (to_s <= from_s) return;
    const { air } = this;
    const meets = from_s <= air.to_s + 1e-9 && to_s >= air.from_s - 1e-9;
    this.air = meets ? { from_s: Math.min(from_s, air.from_s), to_s: Math.max(to_s, air.to_s) } : { from_s, to_s };
  }

  advance(now_ms: number): Moment | null {
    if (this.playing.value) this.walk(now_ms);
    if (!this.dirty) return null;
    const pair = this.pair();
    this.waiting.value = !pair?.exact;
    this.dirty = false;
    this.plan();
    if (!pair) return null;
    this.shown = pair;
    const moment = { ...pair, t_s: this.t_s, jumped: this.jumped, past: pair.exact ? this.pastToShow() : null, packets: this.packetsUntil(this.t_s) };
    this.jumped = false;
    return moment;
  }

  /** Moves the time as the wall clock does, as far as frames are here. */
  private walk(now_ms: number): void {
    const passed_s = this.last_ms === null ? 0 : Math.min((now_ms - this.last_ms) / 1000, 0.5);
    this.last_ms = now_ms;
    const goal_s = Math.min(this.t_s + passed_s * this.speed.value, this.span.to_s);
    const here_s = this.readyTo();
    if (goal_s > this.t_s) {
      const to_s = Math.max(this.t_s, Math.min(goal_s, here_s));
      if (to_s > this.t_s) {
        this.t_s = to_s;
        this.dirty = true;
      }
    }
    this.waiting.value = here_s < goal_s;
    if (this.waiting.value) this.plan();
    if (this.atEnd) this.playing.value = false;
  }

  /** The last time up to which no frame is missing. */
  private readyTo(): number {
    const ticks = this.span.ticks_s;
    const first = this.cache.before(this.cache.tickAt(this.t_s));
    if (first < 0 || !this.near(first, this.cache.tickAt(this.t_s))) return this.t_s;
    let at = first;
    const far_s = this.t_s + AHEAD_S * this.speed.value;
    while (ticks[at]! < far_s) {
      const next = this.cache.after(at);
      if (next < 0 || !this.near(at, next)) break;
      at = next;
    }
    return Math.max(ticks[at]!, this.t_s);
  }

  /** Seconds between two frames worth fetching at this speed; 0 is all ticks. */
  private step(): number {
    if (!this.playing.value) return 0;
    const step_s = this.speed.value / PICTURES_PER_S;
    return step_s > 1.5 * this.span.period_s ? step_s : 0;
  }

  /** Whether nothing that is wanted lies between two ticks. */
  private near(a: number, b: number): boolean {
    const ticks = this.span.ticks_s;
    return b - a <= 1 || ticks[b]! - ticks[a]! <= 2 * this.step();
  }

  private pair(): { a: Frame; b: Frame; f: number; exact: boolean } | null {
    const ticks = this.span.ticks_s;
    const tick = this.cache.tickAt(this.t_s);
    const before = this.cache.before(tick);
    const after = this.cache.after(tick);
    const a = this.cache.get(before);
    const b = this.cache.get(after);
    const onTick = before === tick && Math.abs(ticks[tick]! - this.t_s) < 1e-9;
    const last = tick === ticks.length - 1;
    if (a && (onTick || (last && before === tick))) return { a, b: a, f: 0, exact: true };
    if (a && b && this.near(before, after)) {
      return { a, b, f: Math.max(0, (this.t_s - a.time) / (b.time - a.time)), exact: true };
    }
    if (!a && !b) return null;
    const nearest = a && (!b || this.t_s - a.time <= b.time - this.t_s) ? a : b!;
    return { a: nearest, b: nearest, f: 0, exact: false };
  }

  /** The frames of trails, once after a jump; what plays leaves its own. */
  private pastToShow(): Frame[] | null {
    if (this.traced || this.playing.value || this.past.seconds === 0 || this.wantBehind()) return null;
    this.traced = true;
    const first = this.cache.tickAt(this.t_s - this.past.seconds);
    const last = this.cache.tickAt(this.t_s);
    const frames: Frame[] = [];
    for (let tick = first; tick <= last; tick += 1) {
      const frame = this.cache.get(tick);
      if (frame) frames.push(frame);
    }
    return frames;
  }

  /** The past that trails need, if it is not here and has not been asked for. */
  private wantBehind(): Omit<Fetch, "id" | "sent_ms"> | null {
    const { seconds, step_s } = this.past;
    if (this.traced || seconds === 0) return null;
    const ticks = this.span.ticks_s;
    const last = this.cache.tickAt(this.t_s);
    let at = this.cache.tickAt(this.t_s - seconds);
    const want = { why: "behind" as const, from_s: ticks[at]!, to_s: ticks[last]!, step_s };
    if (at === last || nameOf(want) === this.behind) return null;
    const near = (tick: number) => tick >= 0 && (tick - at <= 1 || ticks[tick]! - ticks[at]! <= 2 * step_s);
    let whole = this.cache.get(at) !== undefined;
    while (whole && at < last) {
      const next = this.cache.after(at);
      whole = near(next);
      at = next;
    }
    return whole ? null : want;
  }

  private packetsUntil(t_s: number): Packet[] {
    const from_s = this.packetsTo_s;
    this.packetsTo_s = t_s;
    if (t_s <= from_s) return [];
    return this.packets.filter((packet) => packet.t > from_s && packet.t <= t_s);
  }

  /** Fetches what is wanted most, one thing at a time. */
  plan(): void {
    const want = this.want();
    const running = this.fetch;
    if (!want) return;
    if (running && performance.now() - running.sent_ms < PATIENCE_MS) {
      // What plays goes before a look at the whole; a picture that somebody waits for before all that is
      // fetched ahead, unless that brings it too.
      const urgent = want.why === "now" || (want.why === "ahead" && running.why === "overview" && this.playing.value);
      if (!urgent || running.why === "now") return;
      if (running.why === "ahead" && running.from_s <= want.from_s && want.from_s <= running.to_s) return;
    }
    if (nameOf(want) === this.barren) return;
    const id = ++this.fetches;
    const { from_s, to_s, step_s } = want;
    if (this.send({ type: "fetch", id, from_s, to_s, step_s })) {
      this.fetch = { ...want, id, sent_ms: performance.now() };
      this.brought = 0;
    }
  }

  private want(): Omit<Fetch, "id" | "sent_ms"> | null {
    const ticks = this.span.ticks_s;
    if (ticks.length === 0) return null;
    const tick = this.cache.tickAt(this.t_s);
    const before = this.cache.before(tick);
    if (before < 0 || !this.near(before, tick)) {
      return { why: "now", from_s: ticks[tick]!, to_s: ticks[tick]!, step_s: 0 };
    }
    const step_s = this.step();
    if (!this.playing.value) {
      const next = tick + 1;
      if (this.t_s > ticks[tick]! + 1e-9 && next < ticks.length && !this.cache.get(next)) {
        return { why: "now", from_s: ticks[next]!, to_s: ticks[next]!, step_s: 0 };
      }
      if (!this.overview) {
        const span_s = this.span.to_s - this.span.from_s;
        return { why: "overview", from_s: this.span.from_s, to_s: this.span.to_s, step_s: span_s / OVERVIEW };
      }
    }
    if (!this.playing.value) {
      // Who talks to whom is told of spans of time: of that before the one that is shown.
      const from_s = Math.max(this.t_s - AIR_S, this.span.from_s);
      const to_s = ticks[Math.min(tick + 5, ticks.length - 1)]!;
      const behind = this.wantBehind();
      if (behind) return behind;
      const here = this.air.from_s <= from_s + 1e-9 && this.air.to_s >= this.t_s - 1e-9;
      if (!here && to_s > from_s) return { why: "ahead", from_s, to_s, step_s: 0 };
    }
    const ahead_s = this.playing.value ? AHEAD_S * this.speed.value : 5 * this.span.period_s;
    const end_s = Math.min(this.t_s + ahead_s, this.span.to_s);
    let at = before;
    while (ticks[at]! < end_s) {
      const next = this.cache.after(at);
      if (next < 0 || !this.near(at, next)) {
        // Not for each single frame anew: when half of what lies ahead is used up.
        if (this.playing.value && ticks[at]! - this.t_s > ahead_s / 2) return null;
        const from = Math.min(at + 1, ticks.length - 1);
        // The tick after a time between two may lie behind the end of what is looked ahead at.
        return from === at ? null : { why: "ahead", from_s: ticks[from]!, to_s: Math.max(end_s, ticks[from]!), step_s };
      }
      at = next;
    }
    return null;
  }
}
