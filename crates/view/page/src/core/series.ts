// Numbers over time: what the program has said of them, kept for charts and thinned when they become long.

import { Signal } from "./signal";
import type { Series, Values } from "../wire";

/** A series keeps between half of this and this many points. */
const MOST_POINTS = 4000;

export class Line {
  times: number[] = [];
  values: (number | null)[] = [];
  /** Counts changes: who draws it sees whether there is anything new. */
  version = 0;
  /** All that was before this page came is here, or was asked for. */
  asked = false;
  /** Shortest time between two points, s: grows when the line is thinned. */
  private spacing_s = 0;

  constructor(readonly about: Series) {}

  get last(): number | null {
    return this.values.at(-1) ?? null;
  }

  /** The number of the newest point at or before `t_s`; -1 if there is none. */
  pointAt(t_s: number): number {
    let low = 0;
    let high = this.times.length;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (this.times[middle]! <= t_s) low = middle + 1;
      else high = middle;
    }
    return low - 1;
  }

  /** The newest value at or before `t_s`. */
  at(t_s: number): number | null {
    return this.values[this.pointAt(t_s)] ?? null;
  }

  /** Whether there is more to it than zeros. */
  get speaks(): boolean {
    return this.values.some((value) => value !== null && value !== 0);
  }

  push(t_s: number, value: number): void {
    const point = Number.isFinite(value) ? value : null;
    const count = this.times.length;
    const newest = count > 0 ? this.times[count - 1]! : -Infinity;
    if (t_s < newest) return;
    this.version += 1;
    const before = count > 1 ? this.times[count - 2]! : -Infinity;
    if (t_s === newest || newest - before < this.spacing_s) {
      // The newest point always is the newest value; it stays only if it is far enough from the one before.
      this.times[count - 1] = t_s;
      this.values[count - 1] = point;
      return;
    }
    this.times.push(t_s);
    this.values.push(point);
    if (count + 1 > MOST_POINTS) this.thin();
  }

  /** What was before goes in front of what has come since. */
  fill(times: number[], values: (number | null)[]): void {
    const end = times.length > 0 ? times[times.length - 1]! : -Infinity;
    const from = this.times.findIndex((t_s) => t_s > end);
    const newer = from < 0 ? this.times.length : from;
    this.times = [...times, ...this.times.slice(newer)];
    this.values = [...values, ...this.values.slice(newer)];
    this.asked = true;
    this.version += 1;
    while (this.times.length > MOST_POINTS) this.thin();
  }

  private thin(): void {
    const keep = (_: unknown, index: number) => index % 2 === 0;
    this.times = this.times.filter(keep);
    this.values = this.values.filter(keep);
    const span_s = this.times.at(-1)! - this.times[0]!;
    this.spacing_s = span_s / MOST_POINTS;
  }
}

export class SeriesStore {
  readonly lines = new Map<number, Line>();
  /** Counts new series and new histories; values only change the lines' own versions. */
  readonly known = new Signal(0);
  private changes = 0;

  declare(list: Series[]): void {
    for (const about of list) if (!this.lines.has(about.id)) this.lines.set(about.id, new Line(about));
    this.known.value = ++this.changes;
  }

  fill(id: number, times: number[], values: (number | null)[]): void {
    this.lines.get(id)?.fill(times, values);
    this.known.value = ++this.changes;
  }

  push(values: Values): void {
    for (let at = 0; at < values.ids.length; at += 1) {
      this.lines.get(values.ids[at]!)?.push(values.time, values.values[at]!);
    }
  }

  find(name: string, vehicle: number | null): Line | undefined {
    for (const line of this.lines.values()) {
      if (line.about.name === name && line.about.vehicle === vehicle) return line;
    }
    return undefined;
  }

  /** Names of the run's own series, in the order they came. */
  ofRun(): Line[] {
    return [...this.lines.values()].filter((line) => line.about.vehicle === null);
  }

  /** Names and units of what single vehicles have, for colours and charts. */
  ofVehicles(): Map<string, string> {
    const found = new Map<string, string>();
    for (const { about } of this.lines.values()) {
      if (about.vehicle !== null) found.set(about.name, about.unit);
      // The run has a mean of every number that vehicles have; nobody's own is known before one is selected.
      else if (about.name.endsWith("/mean")) found.set(about.name.slice(0, -"/mean".length), about.unit);
    }
    return found;
  }
}
