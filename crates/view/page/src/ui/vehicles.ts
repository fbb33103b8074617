// The panel on the right: find a vehicle, look at it closely, or read what has happened.

import { button, h, show } from "../core/dom";
import { count } from "../core/format";
import { icon } from "../core/icons";
import type { Run } from "../run";
import { css } from "../scene/colours";
import { coloursOfKinds } from "../scene/paint";
import { inspector } from "./inspector";
import type { Layout, Tab } from "./layout";
import { marksList } from "./marks";
import { virtualList } from "./virtual";

export interface VehiclesPanel {
  element: HTMLElement;
  /** The cursor goes to the search box, with `text` in it. */
  search(text?: string): void;
}

export function vehiclesPanel(run: Run, layout: Layout): VehiclesPanel {
  const finder = finderBox(run);
  const inspect = inspector(run);
  const marks = marksList(run);
  const tab = (name: Tab, label: string, key: string) => {
    const it = h("button", {
      type: "button",
      role: "tab",
      class: "tab",
      id: `tab-${name}`,
      text: label,
      title: `${label} (${key})`,
      "aria-controls": `panel-${name}`,
      on: { click: () => (layout.tab.value = name) },
    });
    return it;
  };
  const tabs: { [name in Tab]: HTMLButtonElement } = {
    vehicles: tab("vehicles", "Vehicles", "v"),
    marks: tab("marks", "Marks", "m"),
  };
  const pages: { [name in Tab]: HTMLElement } = {
    vehicles: h(
      "div",
      { class: "tabpage", id: "panel-vehicles", role: "tabpanel", "aria-labelledby": "tab-vehicles" },
      finder.box,
      finder.list,
      inspect,
    ),
    marks: h(
      "div",
      { class: "tabpage", id: "panel-marks", role: "tabpanel", "aria-labelledby": "tab-marks" },
      marks,
    ),
  };
  const arrange = () => {
    for (const name of ["vehicles", "marks"] as const) {
      tabs[name].setAttribute("aria-selected", String(layout.tab.value === name));
      show(pages[name], layout.tab.value === name);
    }
    const listed = run.selected.value === null || finder.wanted();
    show(finder.list, listed);
    show(inspect, !listed);
  };
  finder.onWanted(arrange);
  run.selected.on(arrange);
  run.gone.signal.addEventListener("abort", layout.tab.on(arrange));
  run.marked.now(() => {
    tabs.marks.textContent = run.marks.length > 0 ? `Marks ${count(run.marks.length)}` : "Marks";
  });
  arrange();
  return {
    element: h(
      "section",
      { class: "panel right", id: "vehicles", "aria-label": "vehicles and marks" },
      h("div", { class: "tabs", role: "tablist" }, tabs.vehicles, tabs.marks),
      pages.vehicles,
      pages.marks,
    ),
    search(text) {
      layout.tab.value = "vehicles";
      layout.set("vehicles", true);
      finder.focus(text);
    },
  };
}

interface Finder {
  box: HTMLElement;
  list: HTMLElement;
  /** Somebody looks for something. */
  wanted(): boolean;
  onWanted(then: () => void): void;
  focus(text?: string): void;
}

function finderBox(run: Run): Finder {
  const { paths, kinds } = run.hello.vehicles;
  const colours = coloursOfKinds(run.hello).colours.map(css);
  const lower = paths.map((path, vehicle) => `${path} ${kinds[vehicle] ?? ""}`.toLowerCase());
  const all = paths.map((_, vehicle) => vehicle);
  let found = all;
  let at = 0;
  let then = () => {};
  const input = h("input", {
    type: "search",
    id: "search",
    placeholder: paths.length === 1 ? "1 vehicle" : `Find among ${count(paths.length)}, by name or kind`,
    "aria-label": "find a vehicle by name or kind",
    "aria-keyshortcuts": "/",
    autocomplete: "off",
    spellcheck: "false",
  });
  const clear = button("Clear", "Escape", icon("close"), () => leave(), { class: "tool small" });
  const box = h("div", { class: "search" }, icon("search"), input, clear);
  const none = h("p", { class: "empty faint" });
  const list = virtualList("vehicles", 2, (index) => {
    const vehicle = found[index]!;
    const dot = h("span", { class: "dot" });
    dot.style.background = colours[vehicle] ?? "#888888";
    return h(
      "button",
      {
        type: "button",
        class: index === at && input.value !== "" ? "row at" : "row",
        "aria-current": vehicle === run.selected.value ? "true" : undefined,
        on: { click: () => choose(vehicle) },
      },
      dot,
      h("span", { class: "cut", text: paths[vehicle]! }),
      h("span", { class: "faint cut end", text: kinds[vehicle] ?? "" }),
    );
  });
  const body = h("div", { class: "found" }, none, list.element);
  const wanted = () => input.value.trim() !== "";
  const search = () => {
    const parts = input.value.trim().toLowerCase().split(/\s+/).filter(Boolean);
    found = parts.length === 0 ? all : all.filter((vehicle) => parts.every((part) => lower[vehicle]!.includes(part)));
    at = 0;
    show(none, found.length === 0);
    none.textContent = paths.length === 0 ? "This run has no vehicles." : `No vehicle is called “${input.value.trim()}”.`;
    show(clear, input.value !== "");
    list.element.scrollTop = 0;
    then();
    list.update(found.length);
  };
  const leave = () => {
    input.value = "";
    search();
  };
  const choose = (vehicle: number) => {
    run.select(vehicle);
    leave();
    // Keys are keys again.
    input.blur();
  };
  const move = (by: number) => {
    at = Math.min(Math.max(at + by, 0), found.length - 1);
    list.reveal(at);
    list.update(found.length);
  };
  input.addEventListener("input", search);
  input.addEventListener("keydown", (event) => {
    const steps: { [key: string]: number } = { ArrowDown: 1, ArrowUp: -1, PageDown: 10, PageUp: -10 };
    if (event.key === "Enter" && found[at] !== undefined) choose(found[at]!);
    else if (event.key === "Escape") {
      if (input.value !== "") leave();
      else input.blur();
    } else if (steps[event.key] !== undefined && found.length > 0) move(steps[event.key]!);
    else return;
    event.preventDefault();
    event.stopPropagation();
  });
  run.selected.on(() => list.update(found.length));
  search();
  return {
    box,
    list: body,
    wanted,
    onWanted(next) {
      then = next;
    },
    focus(text) {
      if (text !== undefined) {
        input.value = text;
        search();
      }
      input.focus();
      input.select();
    },
  };
}
