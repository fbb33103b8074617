// The row of charts: of the run, and of the vehicle that is selected.

import { button, h, show } from "../core/dom";
import { icon } from "../core/icons";
import type { ChartKey } from "../core/place";
import type { Settings } from "../core/settings";
import { throttled } from "../core/signal";
import type { Run } from "../run";
import { batteryName } from "../run";
import { Chart, nameOf } from "./chart";
import { chooser } from "./chooser";

/** What the program tells of every run, by how much people want to see it. */
const USUAL = ["speed", "packets/received", "packets/delivery", "energy", "contacts", "packets/sent"];
const MOST = 6;
/** Of these, such that models publish. */
const MOST_PUBLISHED = 2;
const PERIOD_MS = 250;
/** How narrow a chart may be, and the gap between two, in the page's text. */
const NARROWEST = 8.5;
const GAP = 1;

export interface ChartsPanel {
  element: HTMLElement;
  /** Which numbers there are, to choose from. */
  choose(): void;
}

export function chartsPanel(run: Run, settings: Settings): ChartsPanel {
  const row = h("div", { class: "charts", id: "chart-row" });
  const add = button("Choose charts", "g", icon("plus"), () => {}, {
    class: "tool plain",
    id: "choose-charts",
    "aria-haspopup": "dialog",
    popovertarget: "chart-chooser",
  });
  const choice = chooser(run, () => chosen(run), add);
  const empty = h("p", { class: "empty faint" });
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
      fit();
    }
    empty.textContent = run.charts.value === null ? "Numbers over time come here as soon as there are some." : "No chart is chosen.";
    show(empty, keys.length === 0);
    show(row, keys.length > 0);
    choice.update();
    for (const chart of charts.values()) chart.update();
  };
  const remove = (key: ChartKey) => {
    run.charts.value = chosen(run).filter((other) => nameOf(other) !== nameOf(key));
  };

  // Charts that are in sight are whole: as many as there is room for, and the others are scrolled to.
  const fit = () => row.style.setProperty("--columns", String(columnsOf(row.clientWidth, Number.parseFloat(getComputedStyle(document.documentElement).fontSize), row.children.length)));
  const sizes = new ResizeObserver(fit);
  sizes.observe(row);
  const arrangeSoon = throttled(PERIOD_MS, arrange);
  run.series.known.now(arrangeSoon);
  run.charts.on(arrange);
  run.selected.on(arrange);
  const redraw = throttled(PERIOD_MS, () => {
    // A series that was all zero until now is worth a chart from now on.
    if (run.charts.value === null && chosen(run).map(nameOf).join("\n") !== [...charts.keys()].join("\n")) arrange();
    else for (const chart of charts.values()) chart.update();
  });
  run.time.on(redraw);
  run.state.on(redraw);
  const rebuild = () => {
    for (const chart of charts.values()) chart.rebuild();
  };
  const ends = [settings.dark.on(rebuild), settings.large.on(rebuild)];
  run.gone.signal.addEventListener("abort", () => {
    for (const end of ends) end();
    sizes.disconnect();
    for (const chart of charts.values()) chart.dispose();
  });
  return {
    element: h("section", { class: "panel below", id: "charts", "aria-label": "charts" }, row, empty, h("div", { class: "charttools" }, add), choice.element),
    choose: choice.toggle,
  };
}

/** How many of so many charts stand side by side in a row of this width; `text_px` is the size of the page's text. */
export function columnsOf(row_px: number, text_px: number, charts: number): number {
  const fit = Math.floor((row_px / text_px + GAP) / (NARROWEST + GAP));
  return Math.max(1, Math.min(fit, charts));
}

/** The charts that were chosen; before anybody did, those that have something to show. */
export function chosen(run: Run): ChartKey[] {
  if (run.charts.value !== null) return run.charts.value;
  const lines = run.series.ofRun().filter((line) => line.speaks);
  const names = lines.map((line) => line.about.name);
  const usual = USUAL.filter((name) => names.includes(name));
  // What models say of the run itself; then means of what they say of vehicles.
  const published = names.filter((name) => !USUAL.includes(name) && !/\/(sum|mean)$/.test(name));
  // Of a battery its charge says enough.
  const means = names.filter((name) => name.endsWith("/mean") && !/^battery\/(voltage|current)\//.test(name));
  const own = [...published, ...means].slice(0, MOST_PUBLISHED);
  const keys = [...usual.slice(0, MOST - own.length), ...own].map((name) => ({ name, own: false }));
  const battery = batteryName(run.series);
  const vehicle = run.selected.value;
  if (battery && vehicle !== null && run.series.find(battery, vehicle)?.speaks) keys.push({ name: battery, own: true });
  return keys;
}
