// The sheet of keys, and a word on the mouse.

import { button, h } from "../core/dom";
import { icon } from "../core/icons";
import type { Run } from "../run";
import type { Key } from "./keys";

const pointer: [string, string][] = [
  ["drag", "turn around the middle; seen flat: move"],
  ["right drag, Shift drag", "move; seen flat: turn"],
  ["wheel", "nearer and farther"],
  ["click", "select a vehicle"],
  ["double click", "look there"],
  ["one finger, two fingers", "turn; move and zoom"],
];

export function helpSheet(run: Run, table: Key[]): { element: HTMLDialogElement; toggle(): void } {
  const groups = new Map<string, Key[]>();
  for (const key of table) groups.set(key.group, [...(groups.get(key.group) ?? []), key]);
  const row = (keys: string[], does: string) =>
    h("tr", {}, h("th", { scope: "row" }, ...keys.flatMap((key, at) => [at > 0 && " ", h("kbd", { text: shown(key) })])), h("td", { text: does }));
  const block = (title: string, rows: HTMLElement[]) => h("section", {}, h("h3", { text: title }), h("table", {}, ...rows));
  const keys = (title: string) => block(title, (groups.get(title) ?? []).map((key) => row(key.keys, key.does)));
  const mouse = block("Mouse and touch", pointer.map(([what, does]) => h("tr", {}, h("th", { scope: "row", text: what }), h("td", { text: does }))));
  const element = h("dialog", { class: "sheet", id: "help", "aria-labelledby": "help-title" });
  element.append(
    h(
      "div",
      { class: "head" },
      h("h2", { id: "help-title", text: "Keys and mouse" }),
      button("Close", "Escape", icon("close"), () => element.close(), { class: "tool" }),
    ),
    h(
      "div",
      { class: "columns" },
      h("div", {}, mouse, keys(run.live ? "Run" : "Time")),
      h("div", {}, keys("View"), keys("Page")),
      h("div", {}, keys("Show"), links()),
    ),
    h("p", { class: "faint", text: `Simbeeotic ${run.hello.version}` }),
  );
  element.addEventListener("click", (event) => {
    if (event.target === element) element.close();
  });
  return {
    element,
    toggle() {
      if (element.open) element.close();
      else element.showModal();
    },
  };
}

/** What does not say of itself what it is. */
function links(): HTMLElement {
  const line = (word: string, text: string) => h("p", {}, h("strong", { text: word }), ` ${text}`);
  return h(
    "section",
    { class: "words" },
    h("h3", { text: "Words" }),
    line("Marks", "are contacts, events of models and lines of the log."),
    line("An instant", "is a time at which something happens; several events may share one."),
    line("Reads, true:", "what a sensor measured, and what it would have measured without error."),
    line("A link", "keeps camera, time, selection, layers, colours and charts. It works as long as this address does."),
  );
}

function shown(key: string): string {
  const names: { [key: string]: string } = { ArrowLeft: "←", ArrowRight: "→", Escape: "Esc", Space: "Space" };
  return names[key] ?? key.replace("Shift+", "Shift ");
}
