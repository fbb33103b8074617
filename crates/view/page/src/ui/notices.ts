// What the page has to say: short words that go again, and a line that stays while the program is not there.

import { button, h, say, show } from "../core/dom";
import { icon } from "../core/icons";
import type { Signal } from "../core/signal";
import type { Link } from "../connection";
import type { Notice, Run } from "../run";

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
    // A connection that is being made anew is not yet one.
    if (state === "lost") show(line, true);
    else if (state === "open") show(line, false);
  });
  return line;
}

/** A run that was started paused waits for somebody: say so where nobody can miss it. */
export function waitingCard(run: Run, start: () => void): HTMLElement {
  const card = h(
    "div",
    { class: "card waiting", id: "waiting", hidden: true },
    h("p", { text: "This run waits for you." }),
    button("Start", "Space", "Start", start, { class: "tool start" }),
  );
  // A step does not always take time, but something happens in it.
  let before: number | null = null;
  const tell = () => {
    const state = run.state.value;
    before ??= state?.events ?? null;
    show(card, state !== null && state.paused && state.ended === null && state.time_s === 0 && state.events === before);
  };
  run.state.now(tell);
  return card;
}
