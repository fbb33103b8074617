// The bar on top: which run, how it stands, and what can be done with the page itself.

import { button, h, say, show } from "../core/dom";
import { count, number, time } from "../core/format";
import { icon, type Icon } from "../core/icons";
import type { Settings } from "../core/settings";
import type { Run } from "../run";
import type { Layout, Panel } from "./layout";
import { waits } from "./livebar";

export interface PageActions {
  savePicture(): void;
  copyLink(): void;
  help(): void;
  fullScreen(): void;
}

export function topBar(run: Run, settings: Settings, layout: Layout, act: PageActions): HTMLElement {
  const { hello } = run;
  const badge = h("span", { class: "badge", id: "run-state" });
  const clock = h("output", { class: "clock", id: "clock", "aria-label": "virtual time" });
  const end = h("span", { class: "faint wide", text: hello.end_s === null ? "" : `of ${time(hello.end_s, 0)}` });
  const viewers = h("span", { class: "fact faint wide", id: "viewers", title: "pages that look at this run" });

  const panelButton = (panel: Panel, label: string, key: string, image: Icon) => {
    const word = panel[0]!.toUpperCase() + panel.slice(1);
    const it = labelled(word, button(label, key, icon(image), () => layout.toggle(panel), { class: "tool", id: `show-${panel}` }));
    run.gone.signal.addEventListener(
      "abort",
      layout.open.now((open) => it.setAttribute("aria-pressed", String(open.has(panel)))),
    );
    return it;
  };
  const theme = button("Theme", "d", icon("auto"), () => settings.nextTheme(), { class: "tool wide", id: "theme" });
  const themeEnd = settings.theme.now((chosen) => {
    theme.replaceChildren(icon(chosen));
    theme.title = `Theme: ${chosen} (d)`;
    theme.setAttribute("aria-label", `Theme: ${chosen}`);
  });
  const text = button("Large text", "z", icon("text"), () => (settings.large.value = !settings.large.value), {
    class: "tool wide",
    id: "large-text",
  });
  const textEnd = settings.large.now((large) => text.setAttribute("aria-pressed", String(large)));
  run.gone.signal.addEventListener("abort", () => {
    themeEnd();
    textEnd();
  });

  run.time.now((t_s) => say(clock, time(t_s)));
  const tell = () => {
    const state = run.state.value;
    const [word, kind] = standing(run);
    say(badge, word);
    badge.dataset.kind = kind;
    badge.title = state?.ended ? `The run has ended: ${state.ended}` : "";
    if (state) {
      say(viewers, `${number(state.viewers)} viewers`);
    }
    show(viewers, state !== null && state.viewers > 1);
  };
  run.state.now(tell);
  run.replay?.playing.on(tell);
  run.replay?.waiting.on(tell);

  return h(
    "header",
    { class: "bar top", "aria-label": "run" },
    h("h1", { class: "name", text: run.name, title: `${hello.name}\nSimbeeotic ${hello.version}` }),
    h("span", { class: "fact faint wide", text: `seed ${hello.seed}` }),
    h("span", {
      class: "fact faint wide",
      id: "vehicle-count",
      text: run.count === 1 ? "1 vehicle" : `${count(run.count)} vehicles`,
    }),
    badge,
    clock,
    end,
    viewers,
    h("span", { class: "stretch" }),
    panelButton("layers", "Layers and colours", "l", "layers"),
    panelButton("vehicles", "Vehicles and marks", "v", "list"),
    panelButton("charts", "Charts", "c", "chart"),
    h("span", { class: "gap" }),
    labelled("Picture", button("Save a picture (PNG)", "i", icon("camera"), act.savePicture, { class: "tool", id: "save-picture" })),
    labelled("Link", button("Copy a link to this view", "y", icon("link"), act.copyLink, { class: "tool", id: "copy-link" })),
    h("span", { class: "gap" }),
    theme,
    text,
    button("Full screen", "Shift+F", icon("full"), act.fullScreen, { class: "tool wide" }),
    labelled("Help", button("Keys and help", "?", icon("help"), act.help, { class: "tool", id: "help-button" })),
  );
}

/** Where there is room, a word beside the icon. */
function labelled(word: string, it: HTMLButtonElement): HTMLButtonElement {
  it.append(h("span", { class: "label", text: word }));
  return it;
}

/** How the run stands, in a word, and for the eye. */
function standing(run: Run): [word: string, kind: string] {
  if (run.replay) {
    if (run.replay.waiting.value) return ["loading", "wait"];
    return run.replay.playing.value ? ["replay", "run"] : ["replay, paused", "hold"];
  }
  const state = run.state.value;
  if (!state) return ["live", "hold"];
  if (state.ended) return ["ended", "end"];
  if (waits(run)) return ["waits for start", "hold"];
  return state.paused ? ["live, paused", "hold"] : ["live", "run"];
}
