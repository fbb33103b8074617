// What the page has to say: short words that go again, and a line that stays while the program is not there.

import { button, h, say, show } from "../core/dom";
import { icon } from "../core/icons";
import type { Signal } from "../core/signal";
import type { Link } from "../connection";
import type { Settings } from "../core/settings";
import type { Notice, Run } from "../run";
import { waits } from "./livebar";

const GOOD_MS = 4000;
const BAD_MS = 12_000;

export function noticeBox(notice: Signal<Notice | null>): HTMLElement {
  const text = h("span", {});
  const box = h("div", { class: "notice", hidden: true }, text, button("Close", null, icon("close"), () => (notice.value = null), { class: "tool small" }));
  let timer: ReturnType<typeof setTimeout> | undefined;
  notice.now((now) => {
    clearTimeout(timer);
    show(box, now !== null);
    if (!now) return;
    box.classList.toggle("bad", now.bad);
    box.setAttribute("role", now.bad ? "alert" : "status");
    say(text, now.text);
    timer = setTimeout(() => (notice.value = null), now.bad ? BAD_MS : GOOD_MS);
  });
  return box;
}

/** Says that the program is gone, and why if that is known. */
export function lostLine(link: Signal<Link>, run: () => Run | null, retry: () => void): HTMLElement {
  const text = h("span", {});
  const line = h("div", { class: "lost", id: "lost", role: "alert", hidden: true }, text, button("Try now", null, "Try now", retry, { class: "tool plain" }));
  link.now((state) => {
    const now = run();
    const ended = now?.state.value?.ended;
    say(
      text,
      ended
        ? `The program has closed after the run had ended (${ended}). What you see is how it was.`
        : now
          ? "The program is gone: it was stopped, or the connection broke. The page goes on trying."
          : "The program does not answer. Is it still running? The page goes on trying.",
    );
    line.classList.toggle("calm", Boolean(ended));
    // A connection that is being made anew is not yet one.
    if (state === "lost") show(line, true);
    else if (state === "open") show(line, false);
  });
  return line;
}

/** A run that was started paused waits for somebody: say so where nobody can miss it. */
export function waitingCard(run: Run, start: () => void): HTMLElement {
  const begin = button("Start the run", "Space", h("span", { text: "Start" }), start, { class: "tool start", id: "start" });
  begin.prepend(icon("play"));
  const card = h(
    "div",
    { class: "card waiting", id: "waiting", role: "region", "aria-label": "the run waits", hidden: true },
    h("p", { class: "strong", text: "The run is ready, and waits for you." }),
    begin,
    h("p", { class: "faint" }, "or press ", h("kbd", { text: "Space" }), "; ", h("kbd", { text: "." }), " goes one instant on"),
  );
  run.state.now(() => show(card, waits(run)));
  return card;
}

/** What one can do with the picture, until somebody has done it. */
export function firstSteps(settings: Settings, host: HTMLElement, gone: AbortSignal): HTMLElement {
  const touch = matchMedia("(pointer: coarse)").matches;
  const text = touch
    ? "Drag to turn, two fingers to move and zoom. Tap a vehicle to look at it closely."
    : "Drag to turn, right button to move, wheel to zoom. Click a vehicle to look at it closely.";
  const box = h(
    "div",
    { class: "firststeps", id: "first-steps" },
    h("span", { text }),
    !touch && h("span", {}, h("kbd", { text: "?" }), " for all keys"),
    button("Understood", null, icon("close"), () => (settings.newcomer.value = false), { class: "tool small" }),
  );
  gone.addEventListener("abort", settings.newcomer.now((newcomer) => show(box, newcomer)));
  for (const event of ["pointerup", "wheel"]) {
    host.addEventListener(event, () => (settings.newcomer.value = false), { signal: gone, passive: true });
  }
  return box;
}
