// The time line of a recording: where one is, what is loaded, where something happened. Dragging scrubs.

import { h, say, show } from "../core/dom";
import { count, time } from "../core/format";
import type { Settings } from "../core/settings";
import { throttled } from "../core/signal";
import type { ReplayPlayer } from "../player/replay";
import type { Run } from "../run";
import type { Mark } from "../wire";
import { markColour } from "./marks";

/** A mark so near to the pointer is told of. */
const NEAR_PX = 3;

export function timeLine(run: Run, replay: ReplayPlayer, settings: Settings): HTMLElement {
  const { from_s, to_s } = replay.span;
  const span_s = Math.max(to_s - from_s, 1e-9);
  const canvas = h("canvas", { "aria-hidden": "true" });
  const hint = h("span", { class: "hint", hidden: true });
  const line = h(
    "div",
    {
      class: "timeline",
      id: "timeline",
      role: "slider",
      tabindex: "0",
      "aria-label": "time",
      "aria-valuemin": String(from_s),
      "aria-valuemax": String(to_s),
    },
    canvas,
    hint,
  );
  const edge = () => 6;
  const xOf = (t_s: number) => edge() + ((t_s - from_s) / span_s) * (line.clientWidth - 2 * edge());
  const timeOf = (event: PointerEvent) => {
    const box = line.getBoundingClientRect();
    const share = (event.clientX - box.left - edge()) / Math.max(1, box.width - 2 * edge());
    return from_s + Math.min(1, Math.max(0, share)) * span_s;
  };

  const draw = () => paint(canvas, line, run, replay, xOf);
  const drawSoon = throttled(30, draw);
  new ResizeObserver(drawSoon).observe(line);
  run.marked.on(drawSoon);
  run.markKind.on(drawSoon);
  run.ownMarks.on(drawSoon);
  run.selected.on(drawSoon);
  run.time.now((t_s) => {
    line.setAttribute("aria-valuenow", t_s.toFixed(3));
    line.setAttribute("aria-valuetext", time(t_s));
    drawSoon();
  });
  const loaded = setInterval(drawSoon, 500);
  const endTheme = settings.dark.on(drawSoon);
  run.gone.signal.addEventListener("abort", () => {
    clearInterval(loaded);
    endTheme();
  });

  let playedOn = false;
  line.addEventListener("pointerdown", (event) => {
    if (event.button !== 0) return;
    line.setPointerCapture(event.pointerId);
    playedOn = replay.playing.value;
    replay.play(false);
    run.seek(timeOf(event));
    line.focus();
    event.preventDefault();
  });
  line.addEventListener("pointermove", (event) => {
    const t_s = timeOf(event);
    say(hint, wordsAt(run, t_s, (span_s * NEAR_PX) / line.clientWidth));
    show(hint, true);
    const half = hint.offsetWidth / 2;
    hint.style.left = `${Math.min(Math.max(xOf(t_s), half), line.clientWidth - half)}px`;
    if (line.hasPointerCapture(event.pointerId)) run.seek(t_s);
  });
  line.addEventListener("pointerup", (event) => {
    if (!line.hasPointerCapture(event.pointerId)) return;
    line.releasePointerCapture(event.pointerId);
    if (playedOn) replay.play(true);
    run.onBusy();
  });
  line.addEventListener("pointerleave", () => show(hint, false));
  line.addEventListener("keydown", (event) => {
    const big_s = span_s / 20;
    const here = replay.time_s;
    const to: { [key: string]: number } = { PageUp: here - big_s, PageDown: here + big_s, Home: from_s, End: to_s };
    const t_s = to[event.key];
    if (t_s === undefined) return;
    run.seek(t_s);
    event.preventDefault();
    event.stopPropagation();
  });
  return line;
}

/** The time, and what is marked there. */
function wordsAt(run: Run, t_s: number, near_s: number): string {
  let nearest: Mark | null = null;
  let there = 0;
  for (const mark of run.marksWanted()) {
    const away_s = Math.abs(mark.t - t_s);
    if (away_s > near_s) continue;
    there += 1;
    if (!nearest || away_s < Math.abs(nearest.t - t_s)) nearest = mark;
  }
  if (!nearest) return time(t_s);
  const more = there > 1 ? ` and ${count(there - 1)} more` : "";
  const who = nearest.who.slice(0, 2).map((vehicle) => run.path(vehicle)).join(", ");
  return `${time(t_s)} · ${[nearest.kind, who].filter(Boolean).join(" ")}${more}`;
}

/** Round times between which about `most` marks of the scale fit. */
function scale(span_s: number, most: number): number {
  const steps = [1e-3, 2e-3, 5e-3, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10, 15, 30, 60, 120, 300, 600, 1800, 3600, 7200, 21600, 86400];
  return steps.find((step) => span_s / step <= most) ?? span_s;
}

function paint(canvas: HTMLCanvasElement, line: HTMLElement, run: Run, replay: ReplayPlayer, xOf: (t_s: number) => number): void {
  const width = line.clientWidth;
  const height = line.clientHeight;
  if (width < 20 || height < 10) return;
  const ratio = devicePixelRatio || 1;
  canvas.width = Math.round(width * ratio);
  canvas.height = Math.round(height * ratio);
  const c = canvas.getContext("2d");
  if (!c) return;
  c.scale(ratio, ratio);
  const style = getComputedStyle(line);
  const colour = (name: string) => style.getPropertyValue(name).trim();
  const { from_s, to_s } = replay.span;
  const font_px = Number.parseFloat(style.fontSize) * 0.85;
  const y = Math.round(height * 0.42);

  c.fillStyle = colour("--line");
  c.fillRect(xOf(from_s), y - 1.5, xOf(to_s) - xOf(from_s), 3);
  const cells = Math.max(1, Math.floor(width / 3));
  c.fillStyle = colour("--loaded");
  replay.cache.cover(cells).forEach((here, at) => {
    if (!here) return;
    const x = xOf(from_s + ((to_s - from_s) * at) / cells);
    c.fillRect(x, y - 1.5, width / cells + 0.5, 3);
  });

  c.font = `${font_px}px ${style.fontFamily}`;
  c.textBaseline = "bottom";
  c.textAlign = "center";
  const step_s = scale(to_s - from_s, Math.max(2, width / (font_px * 7)));
  const decimals = step_s < 0.01 ? 3 : step_s < 0.1 ? 2 : step_s < 1 ? 1 : 0;
  for (let k = Math.ceil(from_s / step_s - 1e-9); k * step_s <= to_s + 1e-9; k += 1) {
    const x = xOf(k * step_s);
    const text = time(k * step_s, decimals);
    const half = c.measureText(text).width / 2;
    if (x - half < 0 || x + half > width) continue;
    c.fillStyle = colour("--faint");
    c.fillText(text, x, height);
  }

  const vehicle = run.selected.value;
  const own: number[] = [];
  const before = new Map<string, number>();
  for (const mark of run.marksWanted()) {
    const x = Math.round(xOf(mark.t));
    if (vehicle !== null && mark.who.includes(vehicle)) own.push(x);
    // Marks of a kind in one place look like one.
    const name = markColour(mark.kind);
    if (x === before.get(name)) continue;
    before.set(name, x);
    c.fillStyle = colour(name);
    c.fillRect(x - 0.5, y - 8, 1.5, 6);
  }
  c.fillStyle = colour("--accent");
  for (const x of own) c.fillRect(x - 1, y - 12, 2.5, 10);

  const x = xOf(run.time.value);
  c.fillRect(xOf(from_s), y - 1.5, x - xOf(from_s), 3);
  c.beginPath();
  c.arc(x, y, 6, 0, 2 * Math.PI);
  c.fill();
  c.lineWidth = 2;
  c.strokeStyle = colour("--panel-solid");
  c.stroke();
}
