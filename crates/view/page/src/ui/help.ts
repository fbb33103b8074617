// The sheet of keys, and a word on the mouse.

import { button, h } from "../core/dom";
import { icon } from "../core/icons";
import type { Run } from "../run";
import type { Key } from "./keys";

const pointer: [string, string][] = [
  ["drag", "orbit"],
  ["right drag, or two fingers", "move sideways"],
  ["wheel, or pinch", "nearer and farther"],
  ["click", "select a vehicle"],
];

export function helpSheet(run: Run, table: Key[]): { element: HTMLDialogElement; toggle(): void } {
  const groups = new Map<string, Key[]>();
  for (const key of table) groups.set(key.group, [...(groups.get(key.group) ?? []), key]);
  const row = (keys: string[], does: string) =>
    h("tr", {}, h("th", { scope: "row" }, ...keys.flatMap((key, at) => [at > 0 && " ", h("kbd", { text: shown(key) })])), h("td", { text: does }));
  const block = (title: string, rows: HTMLElement[]) => h("section", {}, h("h3", { text: title }), h("table", {}, ...rows));
  const element = h("dialog", { class: "sheet", id: "help", "aria-labelledby": "help-title" });
  element.append(
    h(
      "div",
      { class: "head" },
      h("h2", { id: "help-title", text: "Keys" }),
      button("Close", "Escape", icon("close"), () => element.close(), { class: "tool" }),
    ),
    h(
      "div",
      { class: "columns" },
      ...[...groups].map(([title, keys]) => block(title, keys.map((key) => row(key.keys, key.does)))),
      block("Mouse and touch", pointer.map(([what, does]) => h("tr", {}, h("th", { scope: "row", text: what }), h("td", { text: does })))),
    ),
    ...(run.replay ? [h("p", { class: "faint", text: "Wind is shown of a live run only: a recording has none." })] : []),
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

function shown(key: string): string {
  const names: { [key: string]: string } = { ArrowLeft: "←", ArrowRight: "→", Escape: "Esc", Space: "Space" };
  return names[key] ?? key.replace("Shift+", "Shift ");
}
