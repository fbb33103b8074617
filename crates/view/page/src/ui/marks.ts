// What has happened: contacts, events, log lines. A click goes there, or selects who it happened to.

import { h, show } from "../core/dom";
import { count, time } from "../core/format";
import { throttled } from "../core/signal";
import type { Mark } from "../wire";
import type { Run } from "../run";
import { virtualList } from "./virtual";

export function marksList(run: Run): HTMLElement {
  let listed: Mark[] = [];
  const kind = h("select", { id: "mark-kind", "aria-label": "which marks" });
  const own = h("input", { type: "checkbox", id: "mark-own" });
  const ownRow = h("label", { class: "check" }, own, h("span", { text: "of the selected vehicle" }));
  const none = h("p", { class: "empty faint" });
  const dropped = h("p", { class: "empty faint" });
  const list = virtualList("marks", 3.1, (index) => {
    const mark = listed[index]!;
    const names = mark.who.slice(0, 3).map((vehicle) => run.path(vehicle));
    if (mark.who.length > 3) names.push(`and ${mark.who.length - 3} more`);
    const mine = run.selected.value !== null && mark.who.includes(run.selected.value);
    return h(
      "button",
      { type: "button", role: "listitem", class: mine ? "row two mine" : "row two", on: { click: () => go(mark) } },
      h("span", { class: "first" },
        h("span", { class: "cut", text: names.join(", ") || mark.kind }),
        h("span", { class: "faint end figure", text: time(mark.t, 3) })),
      h("span", { class: "faint cut second", text: [names.length > 0 ? mark.kind : "", mark.text].filter(Boolean).join(": ") }),
    );
  });
  const go = (mark: Mark) => {
    if (mark.who.length > 0 && (run.selected.value === null || !mark.who.includes(run.selected.value))) {
      run.select(mark.who[0]!);
    }
    if (run.replay) {
      run.replay.play(false);
      run.seek(mark.t);
    }
  };
  const fill = () => {
    const kinds = [...new Set(run.marks.map((mark) => mark.kind))].sort();
    const options = ["", ...kinds];
    if (options.join("\n") !== [...kind.options].map((it) => it.value).join("\n")) {
      const chosen = kind.value;
      kind.replaceChildren(...options.map((value) => h("option", { value, text: value || "all marks" })));
      kind.value = options.includes(chosen) ? chosen : "";
    }
    const vehicle = run.selected.value;
    show(ownRow, vehicle !== null);
    listed = run.marks.filter(
      (mark) =>
        (kind.value === "" || mark.kind === kind.value) &&
        (!own.checked || vehicle === null || mark.who.includes(vehicle)),
    );
    // The newest of a live run are on top, where one looks; a recording is read from its beginning.
    if (!run.replay) listed.reverse();
    none.textContent = run.marks.length === 0 ? "Nothing has happened yet: no contact, no event, no log line." : "No such mark.";
    show(none, listed.length === 0);
    dropped.textContent = `${count(run.marksDropped)} more were too many to show.`;
    show(dropped, run.marksDropped > 0);
    list.update(listed.length);
  };
  const fillSoon = throttled(250, fill);
  kind.addEventListener("change", fill);
  own.addEventListener("change", fill);
  run.marked.on(fillSoon);
  run.selected.on(fill);
  fill();
  return h("div", { class: "marks" }, h("div", { class: "filters" }, kind, ownRow), list.element, none, dropped);
}
