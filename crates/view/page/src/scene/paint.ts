// The colours of vehicles: by kind, or by a number that they have at this instant, and the legend for it.

import type { ColourBy, Legend } from "./index";
import type { Frame, Hello } from "../wire";
import { GREY, KINDS, SCALES, colourOf, css, robustRange, steadyRange, table, type Rgb } from "./colours";

export class Paint {
  /** Red, green, blue, opacity of each vehicle. */
  readonly bytes: Uint8Array;
  private by: ColourBy = "kind";
  private title = "";
  private unit = "";
  private kindsPainted = false;
  private range: [number, number] | null = null;
  private tables = { value: table(SCALES.value), speed: table(SCALES.speed), battery: table(SCALES.battery) };
  private speeds: Float32Array;
  private told = "";
  private kinds: { colours: Rgb[]; names: [string, string][] };

  constructor(
    hello: Hello,
    private count: number,
    private onLegend: (legend: Legend | null) => void,
  ) {
    this.bytes = new Uint8Array(count * 4).fill(255);
    this.speeds = new Float32Array(count);
    this.kinds = coloursOfKinds(hello);
  }

  set(by: ColourBy, title: string, unit: string): void {
    this.by = by;
    this.title = title;
    this.unit = unit;
    this.range = null;
    this.kindsPainted = false;
  }

  colour(i: number): [number, number, number] {
    return [this.bytes[4 * i]!, this.bytes[4 * i + 1]!, this.bytes[4 * i + 2]!];
  }

  /** Paints for a frame; null: before the first. Whether there is anything new: kinds stay what they are. */
  update(frame: Frame | null): boolean {
    if (this.by === "kind" || !frame) {
      if (this.kindsPainted) return false;
      this.kindsPainted = this.by === "kind";
      this.kinds.colours.forEach((c, i) => this.bytes.set(c, 4 * i));
      this.tell({ title: this.by === "kind" ? this.title || "kind" : this.title, unit: "", low: 0, high: 0, stops: [], names: this.kinds.names });
      return true;
    }
    const values = this.by === "speed" ? this.speedsOf(frame) : frame.values;
    if (this.by === "battery") this.range = [0, 1];
    else this.range = steadyRange(this.range, values && robustRange(values));
    const [low, high] = this.range ?? [0, 1];
    const colours = this.tables[this.by];
    const n = Math.min(frame.n, this.count);
    const to = this.bytes;
    const gain = high > low ? 255 / (high - low) : 0;
    for (let i = 0; i < n; i++) {
      const x = values ? values[i]! : NaN;
      // NaN fails both comparisons.
      const at = (x - low) * gain;
      if (at >= 0 || at < 0) {
        const k = 3 * (at < 0 ? 0 : at > 255 ? 255 : at | 0);
        to[4 * i] = colours[k]!;
        to[4 * i + 1] = colours[k + 1]!;
        to[4 * i + 2] = colours[k + 2]!;
      } else {
        to[4 * i] = GREY[0];
        to[4 * i + 1] = GREY[1];
        to[4 * i + 2] = GREY[2];
      }
    }
    this.tell({ title: this.title || this.by, unit: this.unit || (this.by === "speed" ? "m/s" : ""), low, high, stops: [...SCALES[this.by]] });
    return true;
  }

  private speedsOf(frame: Frame): Float32Array | null {
    const v = frame.velocities;
    if (!v) return null;
    const n = Math.min(frame.n, this.count);
    for (let i = 0; i < n; i++) this.speeds[i] = Math.hypot(v[3 * i]!, v[3 * i + 1]!, v[3 * i + 2]!);
    return this.speeds;
  }

  private tell(legend: Legend): void {
    const text = JSON.stringify(legend);
    if (text === this.told) return;
    this.told = text;
    this.onLegend(legend);
  }
}

/**
 * The colours that the run gives its vehicles, as far as they tell kinds apart: the first kind of a colour keeps it,
 * the others get one that can be told from those.
 */
export function coloursOfKinds(hello: Pick<Hello, "vehicles">): { colours: Rgb[]; names: [string, string][] } {
  const { kinds, colors } = hello.vehicles;
  const own = new Map<string, Set<string>>();
  kinds.forEach((kind, i) => {
    const text = css(colourOf(colors[i] ?? ""));
    const set = own.get(kind);
    if (set) set.add(text);
    else own.set(kind, new Set([text]));
  });
  const taken = new Set<string>();
  const others: string[] = [];
  for (const [kind, set] of own) {
    if ([...set].some((c) => taken.has(c))) others.push(kind);
    else for (const c of set) taken.add(c);
  }
  const palette = new Map<string, string>();
  for (const kind of others) {
    const free = KINDS.find((c) => [...taken].every((t) => apart(c, t))) ?? KINDS[palette.size % KINDS.length]!;
    taken.add(free);
    palette.set(kind, free);
  }
  const colours: Rgb[] = [];
  const names = new Map<string, [string, string]>();
  kinds.forEach((kind, i) => {
    const text = palette.get(kind) ?? css(colourOf(colors[i] ?? ""));
    const [r, g, b] = colourOf(text);
    colours.push([r, g, b]);
    const key = `${kind} ${text}`;
    if (!names.has(key) && names.size < 12) names.set(key, [kind, text]);
  });
  return { colours, names: [...names.values()] };
}

/** Whether two colours can be told apart at a glance. */
function apart(a: string, b: string): boolean {
  const [x, y] = [colourOf(a), colourOf(b)];
  return Math.hypot(x[0] - y[0], x[1] - y[1], x[2] - y[2]) > 70;
}
