// The bar below a live run: it holds the run, steps it, and sets its pace.

import { button, h, say, show } from "../core/dom";
import { factor, time } from "../core/format";
import { icon } from "../core/icons";
import type { Run } from "../run";

export const paces = [0.01, 0.02, 0.05, 0.1, 0.25, 0.5, 1, 2, 5, 10, 20, 50, 100];

export interface LiveActions {
  toggle(): void;
  instant(): void;
  tenth(): void;
  pace(by: 1 | -1): void;
  setPace(factor: number | null): void;
}

export function liveActions(run: Run): LiveActions {
  const open = () => {
    const ended = run.state.value?.ended;
    if (ended) run.say(`The run has ended: ${ended}.`);
    return !ended;
  };
  return {
    toggle() {
      if (open()) run.send({ type: run.state.value?.paused ? "resume" : "pause" });
    },
    instant() {
      if (open()) run.send({ type: "step", instants: 1 });
    },
    tenth() {
      if (open()) run.send({ type: "step", seconds: 0.1 });
    },
    pace(by) {
      if (!open()) return;
      // As fast as possible has no next; slower than that is a little below what it was measured to be.
      const now = run.state.value?.factor ?? (by < 0 ? (run.state.value?.speed ?? 1) : null);
      if (now === null) return;
      const next = by > 0 ? paces.find((pace) => pace > now * 1.001) : paces.findLast((pace) => pace < now * 0.999);
      if (next !== undefined) run.send({ type: "pace", factor: next });
      else if (by > 0) run.send({ type: "pace", factor: null });
    },
    setPace(factor) {
      if (open()) run.send({ type: "pace", factor });
    },
  };
}

export function liveBar(run: Run, act: LiveActions): HTMLElement {
  const toggle = button("Pause", "Space", icon("pause"), act.toggle, { class: "tool main", id: "pause" });
  const pace = h("output", { class: "pace", id: "pace", "aria-label": "pace asked for" });
  const measured = h("span", { class: "fact faint", id: "measured" });
  const line = h("div", { class: "progress", role: "progressbar", "aria-label": "share of the run" });
  const done = h("div", { class: "done" });
  line.append(done);
  const ended = h("span", { class: "fact", id: "ended" });
  const tenth = button("Step 0.1 s", ">", h("span", {}, "0.1 s"), act.tenth, { class: "tool", id: "step-tenth" });
  tenth.prepend(icon("step"));
  const controls = [
    toggle,
    button("Step one instant", ".", icon("step"), act.instant, { class: "tool", id: "step-instant" }),
    tenth,
    h("span", { class: "gap" }),
    button("Slower", "-", icon("slower"), () => act.pace(-1), { class: "tool", id: "slower" }),
    pace,
    button("Faster", "+", icon("faster"), () => act.pace(1), { class: "tool", id: "faster" }),
    button("As time on the wall (1 ×)", "0", "1 ×", () => act.setPace(1), { class: "tool", id: "real-time" }),
    button("As fast as possible", "9", "max", () => act.setPace(null), { class: "tool", id: "max-pace" }),
  ];
  run.state.now((state) => {
    const paused = state?.paused ?? false;
    toggle.replaceChildren(icon(paused ? "play" : "pause"));
    toggle.title = paused ? "Resume (Space)" : "Pause (Space)";
    toggle.setAttribute("aria-label", paused ? "Resume" : "Pause");
    say(pace, state === null ? "–" : state.factor === null ? "max" : factor(state.factor));
    say(measured, state && !paused && !state.ended ? `measured ${factor(Math.round(state.speed * 100) / 100)}` : "");
    for (const control of controls) show(control, !state?.ended);
    show(measured, !state?.ended);
    say(ended, state?.ended ? `The run has ended at ${time(state.time_s)}: ${state.ended}.` : "");
  });
  run.time.now((t_s) => {
    const end_s = run.hello.end_s;
    const share = end_s ? Math.min(1, t_s / end_s) : 0;
    done.style.width = `${100 * share}%`;
    line.setAttribute("aria-valuenow", String(Math.round(100 * share)));
  });
  show(line, run.hello.end_s !== null);
  return h(
    "footer",
    { class: "bar bottom live", "aria-label": "control of the run" },
    ...controls,
    measured,
    ended,
    h("span", { class: "stretch" }),
    line,
  );
}
