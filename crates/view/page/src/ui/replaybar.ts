// The bar below a recording: play, speed, steps, and the time line.

import { button, h, say } from "../core/dom";
import { factor } from "../core/format";
import { icon } from "../core/icons";
import type { Settings } from "../core/settings";
import type { ReplayPlayer } from "../player/replay";
import type { Run } from "../run";
import { timeLine } from "./timeline";

export interface ReplayActions {
  toggle(): void;
  step(by: 1 | -1): void;
  faster(by: 1 | -1): void;
  setSpeed(speed: number): void;
}

export function replayActions(run: Run, replay: ReplayPlayer): ReplayActions {
  const then = (act: () => void) => {
    act();
    run.onBusy();
  };
  return {
    toggle: () => then(() => replay.play(!replay.playing.value)),
    step: (by) => then(() => replay.stepTick(by)),
    faster: (by) => then(() => replay.faster(by)),
    setSpeed: (speed) => then(() => (replay.speed.value = speed)),
  };
}

export function replayBar(run: Run, replay: ReplayPlayer, settings: Settings, act: ReplayActions): HTMLElement {
  const toggle = button("Play", "Space", icon("play"), act.toggle, { class: "tool main", id: "play" });
  replay.playing.now((playing) => {
    toggle.replaceChildren(icon(playing ? "pause" : "play"));
    toggle.title = playing ? "Pause (Space)" : "Play (Space)";
    toggle.setAttribute("aria-label", playing ? "Pause" : "Play");
  });
  const speed = h("output", { class: "pace", id: "speed", "aria-label": "speed" });
  replay.speed.now((value) => say(speed, factor(value)));
  const toMark: HTMLElement[] = [
    button("Mark before", "[", icon("lastMark"), () => run.seekMark(-1), { class: "tool", id: "previous-mark" }),
    button("Next mark", "]", icon("nextMark"), () => run.seekMark(1), { class: "tool", id: "next-mark" }),
  ];
  toMark.splice(1, 0, h("span", { class: "faint", text: "mark" }));
  run.marked.now(() => {
    for (const it of toMark) it.hidden = run.marks.length === 0;
  });
  return h(
    "footer",
    { class: "bar bottom replay", "aria-label": "control of the replay" },
    toggle,
    button("One tick back", ",", icon("back"), () => act.step(-1), { class: "tool", id: "tick-back" }),
    button("One tick on", ".", icon("step"), () => act.step(1), { class: "tool", id: "tick-on" }),
    h("span", { class: "gap" }),
    h("span", { class: "faint wide", text: "Speed" }),
    button("Slower", "-", icon("slower"), () => act.faster(-1), { class: "tool", id: "slower" }),
    speed,
    button("Faster", "+", icon("faster"), () => act.faster(1), { class: "tool", id: "faster" }),
    h("span", { class: "gap" }),
    ...toMark,
    timeLine(run, replay, settings),
  );
}
