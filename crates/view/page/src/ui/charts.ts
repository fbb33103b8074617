// Charts of numbers over time: of the run, and of the vehicle that is selected. All have one cursor; in a
// recording they show where one is, and a click goes there.

import uPlot from "uplot";
import { button, h, say, show } from "../core/dom";
import { fixed, number, time, unit, words } from "../core/format";
import { icon } from "../core/icons";
import type { ChartKey } from "../core/place";
import type { Line } from "../core/series";
import type { Settings } from "../core/settings";
import { throttled } from "../core/signal";
import type { Run } from "../run";
import { batteryName } from "../run";

/** Charts that are there before anybody chose any. */
const USUAL = ["speed", "contacts", "energy", "packets/received", "packets/delivery", "packets/sent"];
const MOST_USUAL = 4;
const PERIOD_MS = 250;
const SYNC = "time";
/** What is counted is told of short times: a mean over this is what people read. */
const MEAN_S = 1;

export function chartsPanel(run: Run, settings: Settings): HTMLElement {
  const row = h("div", { class: "charts", id: "chart-row" });
  const add = h("select", { id: "add-chart", "aria-label": "add a chart", title: "Add a chart" });
  const empty = h("p", { class: "empty faint", text: "No numbers yet." });
  const charts = new Map<string, Chart>();

  const arrange = () => {
    const keys = chosen(run);
    const names = new Set(keys.map(nameOf));
    for (const [name, chart] of charts) {
      if (names.has(name)) continue;
      chart.dispose();
      charts.delete(name);
    }
    for (const key of keys) {
      if (!charts.has(nameOf(key))) charts.set(nameOf(key), new Chart(run, key, () => remove(key)));
    }
    const elements = keys.map((key) => charts.get(nameOf(key))!.element);
    if (elements.some((element, at) => row.children[at] !== element) || row.children.length !== elements.length) {
      row.replaceChildren(...elements);
    }
    show(empty, keys.length === 0);
    offer(keys);
    for (const chart of charts.values()) chart.update();
  };
  const remove = (key: ChartKey) => {
    run.charts.value = chosen(run).filter((other) => nameOf(other) !== nameOf(key));
  };
  const offer = (keys: ChartKey[]) => {
    const there = new Set(keys.map(nameOf));
    const option = (key: ChartKey, of: string) =>
      h("option", { value: nameOf(key), text: `${words(key.name)}${of === "1" || of === "" ? "" : `, ${of}`}` });
    const ofRun = run.series.ofRun().map(({ about }) => ({ key: { name: about.name, own: false }, of: about.unit }));
    const own = [...run.series.ofVehicles()].map(([name, of]) => ({ key: { name, own: true }, of }));
    const group = (label: string, list: { key: ChartKey; of: string }[]) => {
      const free = list.filter(({ key }) => !there.has(nameOf(key)));
      return free.length > 0 && h("optgroup", { label }, ...free.map(({ key, of }) => option(key, of)));
    };
    const groups = [group("of the run", ofRun), group("of the selected vehicle", own)].filter((it) => it !== false);
    const wanted = groups.flatMap((it) => [...it.children].map((child) => (child as HTMLOptionElement).value)).join("\n");
    if (add.dataset.wanted !== wanted) {
      add.dataset.wanted = wanted;
      add.replaceChildren(h("option", { value: "", text: "+", "aria-label": "add a chart" }), ...groups);
    }
    show(add, groups.length > 0);
  };
  add.addEventListener("change", () => {
    if (add.value !== "") run.charts.value = [...chosen(run), keyOf(add.value)];
    add.value = "";
  });

  const arrangeSoon = throttled(PERIOD_MS, arrange);
  run.series.known.now(arrangeSoon);
  run.charts.on(arrange);
  run.selected.on(arrange);
  const redraw = throttled(PERIOD_MS, () => {
    // A series that was all zero until now is worth a chart from now on.
    if (run.charts.value === null && nameList(chosen(run)) !== [...charts.keys()].join("\n")) arrange();
    else for (const chart of charts.values()) chart.update();
  });
  run.time.on(redraw);
  run.state.on(redraw);
  const endTheme = settings.dark.on(() => {
    for (const chart of charts.values()) chart.rebuild();
  });
  const endText = settings.large.on(() => {
    for (const chart of charts.values()) chart.rebuild();
  });
  run.gone.signal.addEventListener("abort", () => {
    endTheme();
    endText();
    for (const chart of charts.values()) chart.dispose();
  });
  return h("section", { class: "panel below", id: "charts", "aria-label": "charts" }, row, h("div", { class: "charttools" }, empty, add));
}

function nameOf(key: ChartKey): string {
  return (key.own ? "own:" : "") + key.name;
}

function keyOf(name: string): ChartKey {
  return name.startsWith("own:") ? { name: name.slice(4), own: true } : { name, own: false };
}

function nameList(keys: ChartKey[]): string {
  return keys.map(nameOf).join("\n");
}

/** The charts that were chosen; before anybody did, those of the run that have something to show. */
export function chosen(run: Run): ChartKey[] {
  if (run.charts.value !== null) return run.charts.value;
  const speaks = (line: Line | undefined) => line !== undefined && line.values.some((value) => value !== null && value !== 0);
  const usual = USUAL.filter((name) => speaks(run.series.find(name, null)));
  const rest = run.series.ofRun().map((line) => line.about.name).filter((name) => name.endsWith("/mean") && speaks(run.series.find(name, null)));
  const keys = [...usual, ...rest].slice(0, MOST_USUAL).map((name) => ({ name, own: false }));
  const battery = batteryName(run.series);
  const vehicle = run.selected.value;
  if (battery && vehicle !== null && speaks(run.series.find(battery, vehicle))) keys.push({ name: battery, own: true });
  return keys;
}

class Chart {
  readonly element: HTMLElement;
  private readonly field = h("div", { class: "field" });
  private readonly value = h("output", { class: "figure" });
  private readonly title: HTMLElement;
  /** As it is drawn. */
  private values: (number | null)[] = [];
  private plot: uPlot | null = null;
  private drawn = { line: null as Line | null, version: -1, now_s: NaN };
  private readonly sizes: ResizeObserver;

  constructor(
    private readonly run: Run,
    private readonly key: ChartKey,
    remove: () => void,
  ) {
    const label = words(key.name);
    this.title = h("span", { class: "cut", text: label });
    this.element = h(
      "figure",
      { class: "chart", "data-series": nameOf(key) },
      h(
        "figcaption",
        {},
        this.title,
        key.own && h("span", { class: "own", title: "of the selected vehicle" }),
        this.value,
        button(`Remove the chart of ${label}`, null, icon("close"), remove, { class: "tool small" }),
      ),
      this.field,
    );
    this.sizes = new ResizeObserver(() => this.resize());
    this.sizes.observe(this.field);
  }

  dispose(): void {
    this.sizes.disconnect();
    this.plot?.destroy();
  }

  rebuild(): void {
    this.plot?.destroy();
    this.plot = null;
    this.drawn.version = -1;
    this.update();
  }

  update(): void {
    const line = this.line();
    const now_s = this.run.time.value;
    if (!line) {
      say(this.value, this.key.own && this.run.selected.value === null ? "select a vehicle" : "–");
      this.plot?.setData([[], []]);
      this.drawn = { line: null, version: -1, now_s };
      return;
    }
    if (!line.asked && line.about.vehicle !== null) {
      line.asked = true;
      this.run.send({ type: "history", id: line.about.id });
    }
    const label = `${words(this.key.name)}${unitOf(line) === "" ? "" : `, ${unitOf(line)}`}`;
    say(this.title, label);
    this.title.title = this.key.own ? `${label}, of the selected vehicle` : label;
    if (!this.plot) this.build();
    if (!this.plot) return;
    if (this.drawn.line !== line || this.drawn.version !== line.version) {
      this.values = line.about.unit === "1/s" ? meanOver(line.times, line.values, MEAN_S) : line.values;
      this.plot.setData([line.times, this.values]);
    } else if (this.run.replay && this.drawn.now_s !== now_s) {
      this.plot.redraw(false, false);
    }
    this.drawn = { line, version: line.version, now_s };
    this.tell(this.plot);
  }

  private line(): Line | undefined {
    const { selected, series } = this.run;
    if (!this.key.own) return series.find(this.key.name, null);
    return selected.value === null ? undefined : series.find(this.key.name, selected.value);
  }

  /** The value under the cursor; without one: now. */
  private tell(plot: uPlot): void {
    const line = this.line();
    if (!line) return;
    const under = plot.cursor.idx;
    const there = plot.cursor.left !== undefined && plot.cursor.left >= 0 && under !== null && under !== undefined;
    const value = there ? (this.values[under] ?? null) : this.run.replay || this.values.length === 0 ? (this.run.replay ? line.at(this.run.time.value) : line.last) : (this.values.at(-1) ?? null);
    const at = there ? ` at ${time(line.times[under] ?? 0)}` : "";
    say(this.value, `${number(value)}${unit(unitOf(line))}${at}`);
  }

  private build(): void {
    const width = this.field.clientWidth;
    const height = this.field.clientHeight;
    if (width < 40 || height < 30) return;
    const style = getComputedStyle(this.element);
    const colour = (name: string) => style.getPropertyValue(name).trim();
    const size_px = Number.parseFloat(style.fontSize) * 0.8;
    const font = `${size_px}px ${style.fontFamily}`;
    const axis = (text: (x: number, step: number) => string, size: number): uPlot.Axis => ({
      stroke: colour("--faint"),
      font,
      size,
      gap: 3,
      space: size_px * 5,
      grid: { stroke: colour("--grid"), width: 1 },
      ticks: { show: false },
      values: (_, splits) => splits.map((x) => text(x, splits.length > 1 ? splits[1]! - splits[0]! : 1)),
    });
    const { replay } = this.run;
    this.plot = new uPlot(
      {
        width,
        height,
        padding: [6, size_px * 2.6, 0, 0],
        legend: { show: false },
        scales: {
          x: replay ? { time: false, range: [replay.span.from_s, Math.max(replay.span.to_s, replay.span.from_s + 1e-3)] } : { time: false },
          y: { range: RATIO.test(this.key.name) ? [0, 1] : rangeOf },
        },
        axes: [
          axis((x, step) => time(x, decimalsOf(step)), size_px * 1.8),
          { ...axis((x, step) => figureOf(x, step), size_px * 4), space: size_px * 2.2 },
        ],
        series: [{}, { stroke: colour("--accent"), width: 1.5, points: { show: false }, spanGaps: true }],
        cursor: { sync: { key: SYNC, setSeries: false }, drag: { x: false, y: false, setScale: false }, y: false, points: { size: 6 } },
        hooks: { draw: replay ? [(plot) => this.drawNow(plot, colour("--now"))] : [], setCursor: [(plot) => this.tell(plot)] },
      },
      [[], []],
      this.field,
    );
    if (replay) this.seekable(this.plot.over);
  }

  /** A click, or dragging, goes to the time under the pointer. */
  private seekable(over: HTMLElement): void {
    const go = (event: PointerEvent) => {
      if (!this.plot || !this.run.replay) return;
      const x = event.clientX - over.getBoundingClientRect().left;
      this.run.replay.play(false);
      this.run.seek(this.plot.posToVal(x, "x"));
    };
    over.addEventListener("pointerdown", (event) => {
      if (event.button !== 0) return;
      over.setPointerCapture(event.pointerId);
      go(event);
    });
    over.addEventListener("pointermove", (event) => {
      if (over.hasPointerCapture(event.pointerId)) go(event);
    });
  }

  private drawNow(plot: uPlot, colour: string): void {
    const x = Math.round(plot.valToPos(this.run.time.value, "x", true));
    const { left, top, width, height } = plot.bbox;
    if (x < left || x > left + width) return;
    const { ctx } = plot;
    ctx.save();
    ctx.fillStyle = colour;
    ctx.fillRect(x - devicePixelRatio / 2, top, Math.max(1, devicePixelRatio), height);
    ctx.restore();
  }

  private resize(): void {
    const width = this.field.clientWidth;
    const height = this.field.clientHeight;
    if (width < 40 || height < 30) return;
    if (this.plot) this.plot.setSize({ width, height });
    else this.update();
  }
}

/** Shares: of a whole, which is always in sight. */
const RATIO = /(^|\/)(delivery|soc)$/;

/** The unit of a series as people write it: a pace is a factor. */
function unitOf({ about }: Line): string {
  if (about.name === "speed" && about.vehicle === null) return "×";
  return about.unit === "1" ? "" : about.unit;
}

/** A label of an axis with as many digits as tell it from the next. */
function figureOf(x: number, step: number): string {
  if (x === 0) return "0";
  if (step < 1e-6) return x.toExponential(1).replace("-", "−");
  if (Math.abs(x) < 1000) return fixed(x, decimalsOf(step));
  return number(x, Math.min(Math.max(3, Math.ceil(Math.log10(Math.abs(x) / step)) + 1), 9));
}

/** The mean of each value and those less than a time before it. */
export function meanOver(times_s: number[], values: (number | null)[], span_s: number): (number | null)[] {
  let first = 0;
  let sum = 0;
  let known = 0;
  return values.map((value, at) => {
    if (value !== null) {
      sum += value;
      known += 1;
    }
    while (times_s[first]! <= times_s[at]! - span_s + 1e-9) {
      const old = values[first];
      if (old !== null && old !== undefined) {
        sum -= old;
        known -= 1;
      }
      first += 1;
    }
    // What is left of numbers that cancel is nothing.
    if (known === 0) sum = 0;
    const mean = Math.abs(sum) < 1e-9 ? 0 : sum / known;
    return value === null ? null : Math.max(mean, Math.min(0, value));
  });
}

/** Decimals that tell steps of an axis apart. */
function decimalsOf(step: number): number {
  for (let decimals = 0; decimals < 6; decimals += 1) {
    if (Math.abs(step * 10 ** decimals - Math.round(step * 10 ** decimals)) < 1e-6) return decimals;
  }
  return 6;
}

/** From zero, if that does not make the line flat; with some air above and below. */
function rangeOf(_: uPlot, low: number | null, high: number | null): [number, number] {
  if (low === null || high === null) return [0, 1];
  if (low === high) return low === 0 ? [0, 1] : low > 0 ? [0, low * 1.25] : [low * 1.25, 0];
  const air = (high - low) * 0.08;
  const bottom = low >= 0 && low < 0.6 * high ? 0 : low - air;
  const top = high <= 0 && high > 0.6 * low ? 0 : high + air;
  return [bottom, top];
}
