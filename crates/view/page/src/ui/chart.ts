// A chart of one number over time. All charts have one cursor; in a recording they show where one is, and a
// click goes there.

import uPlot from "uplot";
import { extentOf, labelOf, meanOver, measureOf, rangeOf, timeLabel, timeRange, timeSteps, told } from "../core/axis";
import { button, h, say } from "../core/dom";
import { time, words } from "../core/format";
import { icon } from "../core/icons";
import type { ChartKey } from "../core/place";
import type { Line } from "../core/series";
import type { Run } from "../run";

const SYNC = "time";
/** What is counted is told of short times: a mean over this is what people read. */
const MEAN_S = 1;

export function nameOf(key: ChartKey): string {
  return (key.own ? "own:" : "") + key.name;
}

/** What a chart shows, in words. */
export function titleOf(key: ChartKey): string {
  return !key.own && key.name === "speed" ? "speed of the run" : words(key.name);
}

export class Chart {
  readonly element: HTMLElement;
  private readonly field = h("div", { class: "field" });
  private readonly value = h("output", { class: "figure" });
  private readonly of = h("span", { class: "faint cut" });
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
    const title = titleOf(key);
    this.element = h(
      "figure",
      { class: "chart", "data-series": nameOf(key) },
      h(
        "figcaption",
        {},
        h("span", { class: "cut", text: title, title }),
        button(`Remove the chart of ${title}`, null, icon("close"), remove, { class: "tool small" }),
      ),
      h("div", { class: "reading" }, this.value, this.of),
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
      this.values = [];
      say(this.value, "–");
      say(this.of, this.key.own ? (this.run.selected.value === null ? "select a vehicle" : this.whose()) : "");
      this.plot?.setData([[], []]);
      this.drawn = { line: null, version: -1, now_s };
      return;
    }
    if (!line.asked && line.about.vehicle !== null) {
      line.asked = true;
      this.run.send({ type: "history", id: line.about.id });
    }
    if (!this.plot) this.build();
    if (!this.plot) return;
    if (this.drawn.line !== line || this.drawn.version !== line.version) {
      const { times } = measureOf(line);
      const values = line.about.unit === "1/s" ? meanOver(line.times, line.values, MEAN_S) : line.values;
      this.values = times === 1 ? values : values.map((value) => value && times * value);
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

  private whose(): string {
    const vehicle = this.run.selected.value;
    return this.key.own && vehicle !== null ? `of ${this.run.path(vehicle)}` : "";
  }

  /** The value under the cursor; without one: now. */
  private tell(plot: uPlot): void {
    const line = this.line();
    if (!line) return;
    const under = plot.cursor.idx;
    const there = plot.cursor.left !== undefined && plot.cursor.left >= 0 && under !== null && under !== undefined;
    const at = there ? under : this.run.replay ? line.pointAt(this.run.time.value) : this.values.length - 1;
    say(this.value, told(this.values[at] ?? null, measureOf(line)));
    say(this.of, there ? `at ${time(line.times[under] ?? 0)}` : this.whose());
  }

  private build(): void {
    const line = this.line();
    const width = this.field.clientWidth;
    const height = this.field.clientHeight;
    if (!line || width < 40 || height < 30) return;
    const { range } = measureOf(line);
    const style = getComputedStyle(this.element);
    const colour = (name: string) => style.getPropertyValue(name).trim();
    const size_px = Number.parseFloat(style.fontSize) * 0.85;
    const font = `${size_px}px ${style.fontFamily}`;
    const axis = (text: (x: number, step: number) => string): uPlot.Axis => ({
      stroke: colour("--faint"),
      font,
      gap: 3,
      grid: { stroke: colour("--grid"), width: 1 },
      ticks: { show: false },
      values: (_, splits) => splits.map((x) => text(x, splits.length > 1 ? splits[1]! - splits[0]! : 1)),
    });
    /** As wide as its labels. */
    const margin = (plot: uPlot, labels: string[] | null): number => {
      plot.ctx.save();
      plot.ctx.font = font;
      const widths = (labels ?? []).map((label) => plot.ctx.measureText(label).width);
      plot.ctx.restore();
      return Math.ceil(Math.max(size_px, ...widths)) + 6;
    };
    const { replay } = this.run;
    this.plot = new uPlot(
      {
        width,
        height,
        padding: [size_px * 0.6, size_px * 1.6, 0, 0],
        legend: { show: false },
        scales: {
          x: replay ? { time: false, range: [replay.span.from_s, Math.max(replay.span.to_s, replay.span.from_s + 1e-3)] } : { time: false, range: (_, first, last) => timeRange(first, last) },
          y: { range: range ?? ((_, low, high) => (line.about.unit === "1/s" ? rangeOf(...extentOf(this.line()?.times ?? [], this.values, MEAN_S)) : rangeOf(low, high))) },
        },
        axes: [
          { ...axis(timeLabel), size: size_px * 1.7, space: size_px * 3.8, incrs: timeSteps },
          { ...axis(labelOf), size: margin, space: size_px * 2 },
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
