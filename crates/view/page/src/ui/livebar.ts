// The bar below a live run: it holds the run, steps it, and sets its speed.

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
  const setPace = (factor: number | null) => {
    if (!open()) return;
    run.send({ type: "pace", factor });
    run.expect({ factor });
  };
  return {
    toggle() {
      if (!open()) return;
      const paused = !run.state.value?.paused;
      run.send({ type: paused ? "pause" : "resume" });
      run.expect({ paused });
    },
    instant() {
      if (open()) run.send({ type: "step", instants: 1 });
    },
    tenth() {
      if (open()) run.send({ type: "step", seconds: 0.1 });
    },
    pace(by) {
      // As fast as possible has no next; slower than that is a little below what it was measured to be.
      const now = run.state.value?.factor ?? (by < 0 ? (run.state.value?.speed ?? 1) : null);
      if (now === null) return;
      const next = by > 0 ? paces.find((pace) => pace > now * 1.001) : paces.findLast((pace) => pace < now * 0.999);
      if (next !== undefined) setPace(next);
      else if (by > 0) setPace(null);
    },
    setPace,
  };
}

export function liveBar(run: Run, act: LiveActions): HTMLElement {
  const toggle = button("Pause", "Space", icon("pause"), act.toggle, { class: "tool main", id: "pause" });
  const measured = h("span", { class: "fact faint measured", id: "measured", title: "virtual seconds per second of the wall clock" });
  const line = h("div", { class: "progress", role: "progressbar", "aria-label": "share of the run" });
  const done = h("div", { class: "done" });
  line.append(done);
  const why = h("strong", {});
  const ended = h("p", { class: "cut", id: "ended", role: "status" }, why, h("span", { class: "faint" }, " What was recorded can be seen again: ", h("code", { text: "simbeeotic view RECORDING" })));
  const step = (label: string, key: string, text: string, run: () => void, id: string) => {
    const it = button(label, key, h("span", { text }), run, { class: "tool plain", id });
    it.prepend(icon("step"));
    return it;
  };
  const pace = paceChoice(run, act);
  const controls = [
    toggle,
    h("span", { class: "gap" }),
    h("span", { class: "faint wide", text: "Step" }),
    step("Step one instant: to the next event", ".", "instant", act.instant, "step-instant"),
    step("Step 0.1 s of virtual time", ">", "0.1 s", act.tenth, "step-tenth"),
    h("span", { class: "gap" }),
    h("span", { class: "faint wide", text: "Speed" }),
    button("Slower", "-", icon("slower"), () => act.pace(-1), { class: "tool", id: "slower" }),
    pace,
    button("Faster", "+", icon("faster"), () => act.pace(1), { class: "tool", id: "faster" }),
    measured,
  ];
  run.state.now((state) => {
    const paused = state?.paused ?? false;
    const word = state && waits(run) ? "Start" : paused ? "Resume" : "Pause";
    toggle.replaceChildren(icon(paused ? "play" : "pause"));
    toggle.title = `${word} (Space)`;
    toggle.setAttribute("aria-label", word);
    toggle.classList.toggle("waits", state !== null && waits(run));
    say(measured, state && !paused && !state.ended ? `runs at ${factor(Math.round(state.speed * 100) / 100)}` : "");
    for (const control of controls) show(control, !state?.ended);
    say(why, state?.ended ? `The run has ended at ${time(state.time_s)}: ${state.ended}.` : "");
    ended.title = ended.textContent ?? "";
    show(ended, Boolean(state?.ended));
  });
  run.time.now((t_s) => {
    const end_s = run.hello.end_s;
    const share = end_s ? Math.min(1, t_s / end_s) : 0;
    done.style.width = `${100 * share}%`;
    line.setAttribute("aria-valuenow", String(Math.round(100 * share)));
    line.title = `${Math.round(100 * share)} % of the run`;
  });
  show(line, run.hello.end_s !== null);
  return h("footer", { class: "bar bottom live", "aria-label": "control of the run" }, ...controls, ended, line);
}

/** Whether the run stands before its first event, until somebody lets it go. */
export function waits(run: Run): boolean {
  const state = run.state.value;
  return state !== null && state.paused && state.ended === null && state.time_s === 0 && state.events === run.firstEvents;
}

/** Speeds to choose from, and the one that somebody else has chosen. */
function paceChoice(run: Run, act: LiveActions): HTMLSelectElement {
  const choice = h("select", { id: "pace", "aria-label": "speed of the run", title: "Virtual seconds per second of the wall clock" });
  const option = (pace: number | null) => h("option", { value: String(pace), text: pace === null ? "as fast as possible" : pace === 1 ? "1 × (real time)" : factor(pace) });
  choice.replaceChildren(...paces.map(option), option(null));
  choice.addEventListener("change", () => act.setPace(choice.value === "null" ? null : Number(choice.value)));
  run.state.now((state) => {
    if (!state) return;
    const value = String(state.factor);
    if (![...choice.options].some((it) => it.value === value)) {
      const after = [...choice.options].find((it) => it.value === "null" || Number(it.value) > (state.factor ?? Infinity));
      choice.insertBefore(option(state.factor), after ?? null);
    }
    if (choice.value !== value) choice.value = value;
  });
  return choice;
}
