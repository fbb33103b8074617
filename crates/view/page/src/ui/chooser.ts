// Which numbers have a chart: a list of all that there are, to search and tick.

import { button, h, show } from "../core/dom";
import { unitWords } from "../core/format";
import type { ChartKey } from "../core/place";
import type { Run } from "../run";
import { nameOf, titleOf } from "./chart";

export interface Chooser {
  element: HTMLElement;
  toggle(): void;
  /** What is ticked may be something else now. */
  update(): void;
}

interface Row {
  element: HTMLElement;
  box: HTMLInputElement;
  name: string;
  words: string;
}

/** Opens over `anchor`, which says so by its own `popovertarget`. */
export function chooser(run: Run, chosen: () => ChartKey[], anchor: HTMLElement): Chooser {
  const input = h("input", { type: "search", id: "find-chart", placeholder: "Find a number", "aria-label": "find a number by name", autocomplete: "off", spellcheck: "false", autofocus: true });
  const list = h("div", { class: "choices" });
  const none = h("p", { class: "empty faint" });
  const usual = button("The usual charts", null, "The usual charts", () => (run.charts.value = null), { class: "tool plain", id: "usual-charts" });
  const element = h(
    "div",
    { class: "chooser", id: "chart-chooser", role: "dialog", "aria-label": "choose charts", popover: "auto" },
    input,
    list,
    none,
    usual,
  );
  let rows: Row[] = [];
  let groups: { element: HTMLElement; rows: Row[] }[] = [];
  let offered = "";

  const row = (key: ChartKey, of: string): Row => {
    const box = h("input", { type: "checkbox", value: nameOf(key) });
    box.addEventListener("change", () => {
      const rest = chosen().filter((other) => nameOf(other) !== nameOf(key));
      run.charts.value = box.checked ? [...rest, key] : rest;
    });
    const words = titleOf(key);
    const line = h("label", { class: "check" }, box, h("span", { class: "cut", text: words, title: key.name }), h("span", { class: "faint end", text: unitWords(of) }));
    return { element: line, box, name: nameOf(key), words: `${words} ${key.name}`.toLowerCase() };
  };
  const fill = () => {
    const ofRun = run.series.ofRun().map(({ about }) => [{ name: about.name, own: false }, about.unit] as const);
    const over = ([key]: readonly [ChartKey, string]) => /\/(sum|mean)$/.test(key.name);
    const own = [...run.series.ofVehicles()].map(([name, of]) => [{ name, own: true }, of] as const);
    const parts = [
      ["Of the run", ofRun.filter((it) => !over(it))],
      ["Of the selected vehicle", own],
      ["Over all vehicles", ofRun.filter(over)],
    ] as const;
    const now = JSON.stringify(parts);
    if (now === offered) return;
    offered = now;
    groups = parts
      .filter(([, keys]) => keys.length > 0)
      .map(([title, keys]) => {
        const own = keys.map(([key, of]) => row(key, of));
        return { rows: own, element: h("fieldset", {}, h("legend", { text: title }), ...own.map((it) => it.element)) };
      });
    rows = groups.flatMap((group) => group.rows);
    list.replaceChildren(...groups.map((group) => group.element));
  };
  const search = () => {
    const parts = input.value.trim().toLowerCase().split(/\s+/).filter(Boolean);
    for (const { element, words } of rows) show(element, parts.every((part) => words.includes(part)));
    for (const group of groups) show(group.element, group.rows.some((it) => !it.element.hidden));
    none.textContent = rows.length === 0 ? "This run has published no numbers yet." : `No number is called “${input.value.trim()}”.`;
    show(none, rows.every((it) => it.element.hidden));
  };
  const refresh = () => {
    fill();
    const ticked = new Set(chosen().map(nameOf));
    for (const { box, name } of rows) box.checked = ticked.has(name);
    usual.disabled = run.charts.value === null;
    search();
  };
  const update = () => {
    if (element.matches(":popover-open")) refresh();
  };
  input.addEventListener("input", search);
  // At once, and not for anybody else: the browser's own closing comes some time later.
  element.addEventListener("keydown", (event) => {
    if (event.key !== "Escape") return;
    element.hidePopover();
    event.preventDefault();
    event.stopPropagation();
  });
  element.addEventListener("beforetoggle", (event) => {
    if (event.newState !== "open") return;
    // Before it is seen: somebody may click at once.
    input.value = "";
    refresh();
    const box = anchor.getBoundingClientRect();
    element.style.right = `${Math.max(8, innerWidth - box.right)}px`;
    element.style.bottom = `${Math.max(8, innerHeight - box.top + 4)}px`;
    element.style.maxHeight = `${Math.max(120, box.top - 60)}px`;
  });
  return {
    element,
    update,
    toggle: () => void element.togglePopover(),
  };
}
