// Sensors of the selected vehicle: what each reads, what is true, and how both went lately.

import { button, h, say, show } from "../core/dom";
import { number, time } from "../core/format";
import type { Details, SensorDetails } from "../wire";

/** Values of one sensor that are listed; a camera has more than anybody reads. */
const MOST_VALUES = 6;
const MOST_LINES = 8;
/** Lines that can be unfolded. */
const MOST_UNFOLDED = 1024;
const POINTS = 120;

interface Row {
  element: HTMLElement;
  update(sensor: SensorDetails): void;
}

/** `recorded`: the path of the vehicle in a recording; null: the run is live. */
export function sensorRows(details: Details, recorded: string | null): { element: HTMLElement; update(details: Details): void } {
  const rows = details.sensors.map((sensor) => sensorRow(sensor, recorded !== null));
  const hint = recorded === null ? null : recorderHint("Readings are in a recording whose recorder has", "readings", recorded);
  return {
    element: h("section", { id: "sensors" }, title(), ...rows.map((row) => row.element), hint),
    update({ sensors }) {
      sensors.forEach((sensor, at) => rows[at]?.update(sensor));
      if (hint) show(hint, sensors.some((sensor) => sensor.t === null));
    },
  };
}

/** What to write into a scenario so that the next recording has it. */
export function recorderHint(words: string, parameter: string, path: string): HTMLElement {
  const line = `${parameter} = ["${path}/*"]`;
  return h("p", { class: "faint hint", title: `[[component]]\nuse = "recorder"\n${line}` }, `${words} `, h("code", { text: line }), ".");
}

/** What the columns below are. */
function title(): HTMLElement {
  return h(
    "table",
    { class: "facts values heading" },
    h(
      "tr",
      {},
      h("th", {}, h("h3", { text: "Sensors" })),
      h("td", { class: "figure faint", text: "reads" }),
      h("td", { class: "figure faint", text: "true" }),
      h("td"),
    ),
  );
}

/** A sensor with several readings at once, a ring of range finders: a line each, and what is true of the last value. */
function matrix(first: SensorDetails, length: number): { element: HTMLElement; rows: HTMLElement[]; update(sensor: SensorDetails): void } {
  const columns = first.columns.length;
  const shown = Math.min(Math.ceil(length / columns), MOST_UNFOLDED);
  const lines = Array.from({ length: shown }, () => Array.from({ length: columns + 1 }, (_, at) => h("td", { class: at < columns ? "figure" : "figure faint" })));
  const title = ([name, of]: [string, string]) => h("td", { class: "figure faint", text: of === "1" || of === "" ? name : `${name}, ${of}` });
  const rows = lines.map((cells) => h("tr", {}, ...cells));
  return {
    rows,
    element: h(
      "table",
      { class: "facts matrix" },
      h("tr", {}, ...first.columns.map(title), h("td", { class: "figure faint", text: "true" })),
      ...rows,
    ),
    update(sensor) {
      lines.forEach((cells, line) => {
        cells.forEach((cell, at) => {
          const from = at < columns ? sensor.reading : sensor.truth;
          say(cell, number(from?.[line * columns + Math.min(at, columns - 1)]));
        });
      });
    },
  };
}

/** Shows the rows that are too many at first, and hides them again. */
function unfold(rows: HTMLElement[], values: number): HTMLElement {
  let open = false;
  const toggle = button("All values", null, "", () => set(!open), { class: "name-link" });
  const set = (now: boolean) => {
    open = now;
    for (const row of rows) show(row, open);
    const rest = rows.length >= MOST_UNFOLDED - MOST_LINES ? " (the first of them)" : "";
    say(toggle, open ? "fewer values" : `and ${values} more values${rest}`);
    toggle.setAttribute("aria-expanded", String(open));
  };
  set(false);
  return toggle;
}

function sensorRow(first: SensorDetails, recorded: boolean): Row {
  const length = first.reading?.length ?? first.truth?.length ?? 0;
  const columns = Math.max(first.columns.length, 1);
  const grid = columns > 1 && length > columns ? matrix(first, length) : null;
  const state = h("span", { class: "faint figure" });
  const spark = h("canvas", { class: "spark", "aria-hidden": "true" });
  const cells = Array.from({ length: grid ? 0 : Math.min(length, MOST_UNFOLDED) }, (_, at) => {
    const [column, of] = first.columns[at % columns] ?? ["", ""];
    const name = length > columns ? `${column} ${at + 1}` : column;
    const reading = h("td", { class: "figure" });
    const truth = h("td", { class: "figure faint" });
    const row = h("tr", {}, h("th", { scope: "row", text: name.trim() }), reading, truth, h("td", { class: "faint", text: of === "1" ? "" : of }));
    return { row, reading, truth };
  });
  const folded = grid ? grid.rows.slice(MOST_LINES) : cells.slice(MOST_VALUES).map((cell) => cell.row);
  const more = folded.length > 0 ? unfold(folded, grid ? length - MOST_LINES * columns : length - MOST_VALUES) : null;
  const table = grid ? grid.element : h("table", { class: "facts values" }, ...cells.map((cell) => cell.row));
  const past: { t: number; reading: number | null; truth: number | null }[] = [];
  return {
    element: h("div", { class: "sensor" }, h("div", { class: "first" }, h("strong", { class: "cut", text: first.name }), spark, state), table, more),
    update(sensor) {
      say(state, sensor.lost ? "lost" : sensor.t === null ? (recorded ? "not recorded" : "not read yet") : time(sensor.t));
      state.classList.toggle("warn", sensor.lost);
      grid?.update(sensor);
      cells.forEach((cell, at) => {
        say(cell.reading, number(sensor.reading?.[at], 4));
        say(cell.truth, number(sensor.truth?.[at], 4));
      });
      if (sensor.t !== null && sensor.t !== past.at(-1)?.t) {
        // Somebody went back in a recording: what came later is no past.
        if (sensor.t < (past.at(-1)?.t ?? -Infinity)) past.length = 0;
        past.push({ t: sensor.t, reading: sensor.reading?.[0] ?? null, truth: sensor.truth?.[0] ?? null });
        if (past.length > POINTS) past.shift();
      }
      show(spark, past.length > 2 && !grid);
      if (past.length > 2 && !grid) drawSpark(spark, past);
    },
  };
}

/** The first value lately: what it read over what was true. */
function drawSpark(canvas: HTMLCanvasElement, past: { t: number; reading: number | null; truth: number | null }[]): void {
  const width = canvas.clientWidth || 64;
  const height = canvas.clientHeight || 16;
  const ratio = devicePixelRatio || 1;
  canvas.width = width * ratio;
  canvas.height = height * ratio;
  const c = canvas.getContext("2d");
  const all = past.flatMap((point) => [point.reading, point.truth]).filter((x): x is number => x !== null && Number.isFinite(x));
  if (!c || all.length === 0) return;
  c.scale(ratio, ratio);
  const low = Math.min(...all);
  const span = Math.max(...all) - low || 1;
  const from_s = past[0]!.t;
  const span_s = past.at(-1)!.t - from_s || 1;
  const style = getComputedStyle(canvas);
  const line = (pick: "reading" | "truth", colour: string, thick: number) => {
    c.beginPath();
    let drawing = false;
    for (const point of past) {
      const value = point[pick];
      if (value === null || !Number.isFinite(value)) {
        drawing = false;
        continue;
      }
      const x = 1 + ((point.t - from_s) / span_s) * (width - 2);
      const y = height - 2 - ((value - low) / span) * (height - 4);
      if (drawing) c.lineTo(x, y);
      else c.moveTo(x, y);
      drawing = true;
    }
    c.strokeStyle = style.getPropertyValue(colour).trim();
    c.lineWidth = thick;
    c.stroke();
  };
  line("truth", "--line-strong", 1);
  line("reading", "--accent", 1.25);
}
