// What has happened: contacts, events, log lines. A click goes there, or selects who it happened to.

import { h, show } from "../core/dom";
import { count, time } from "../core/format";
import { throttled } from "../core/signal";
import type { Mark } from "../wire";
import type { Run } from "../run";
import { virtualList } from "./virtual";

/** The colour of a kind of mark, here and on the time line. */
export function markColour(kind: string): string {
  return kind === "contact" ? "--contact" : kind === "log" ? "--mark" : "--event";
}

export function marksList(run: Run): HTMLElement {
  let listed: Mark[] = [];
  const kind = h("select", { id: "mark-kind", "aria-label": "which marks" });
  const own = h("input", { type: "checkbox", id: "mark-own" });
  const ownRow = h("label", { class: "check" }, own, h("span", { text: "of the selected vehicle" }));
  const filters = h("div", { class: "filters" }, kind, ownRow);
  const none = h("p", { class: "empty faint" });
  const dropped = h("p", { class: "empty faint" });
  const list = virtualList("marks", 3.1, (index) => {
    const mark = listed[index]!;
    const names = mark.who.slice(0, 3).map((vehicle) => run.path(vehicle));
    if (mark.who.length > 3) names.push(`and ${mark.who.length - 3} more`);
    const mine = run.selected.value !== null && mark.who.includes(run.selected.value);
    const dot = h("span", { class: "dot" });
    dot.style.background = `var(${markColour(mark.kind)})`;
    return h(
      "button",
      { type: "button", class: mine ? "row two mine" : "row two", "aria-current": mark === run.soughtMark.value ? "true" : undefined, on: { click: () => go(mark) } },
      h("span", { class: "first" },
        dot,
        h("span", { class: "cut", text: names.join(", ") || mark.kind }),
        h("span", { class: "faint end figure", text: time(mark.t, 3) })),
      h("span", { class: "faint cut second", text: [names.length > 0 ? mark.kind : "", mark.text].filter(Boolean).join(": ") }),
    );
  });
  const go = (mark: Mark) => {
    run.soughtMark.value = mark;
    if (mark.who.length > 0 && (run.selected.value === null || !mark.who.includes(run.selected.value))) {
      run.select(mark.who[0]!);
    }
    if (run.replay) {
      run.replay.play(false);
      run.seek(mark.t);
    }
  };
  const fill = () => {
    const kinds = new Map([["", run.marks.length]]);
    for (const mark of run.marks) kinds.set(mark.kind, (kinds.get(mark.kind) ?? 0) + 1);
    // A link may want a kind of which there is nothing yet.
    if (!kinds.has(run.markKind.value)) kinds.set(run.markKind.value, 0);
    const options = [...kinds].sort().map(([value, times]) => [value, `${value || "all kinds"} (${count(times)})`] as const);
    const wanted = JSON.stringify(options);
    // Not while somebody chooses: a list that is open closes when it changes.
    if (wanted !== kind.dataset.options && (document.activeElement !== kind || options.length !== kind.options.length)) {
      kind.dataset.options = wanted;
      kind.replaceChildren(...options.map(([value, text]) => h("option", { value, text })));
    }
    kind.value = run.markKind.value;
    const vehicle = run.selected.value;
    show(ownRow, vehicle !== null);
    listed = run.marksWanted();
    // The newest of a live run are on top, where one looks; a recording is read from its beginning.
    if (!run.replay) listed = listed.toReversed();
    none.textContent =
      run.marks.length > 0 ? "No such mark." : !run.read.value ? "The recording is still being read …" : run.replay ? "Nothing is marked in this recording: no contact, no event, no log line." : "Nothing has happened yet: no contact, no event, no log line.";
    show(none, listed.length === 0);
    show(list.element, listed.length > 0);
    show(filters, run.marks.length > 0);
    dropped.textContent = `${count(run.marksDropped)} more were too many to show.`;
    show(dropped, run.marksDropped > 0);
    list.update(listed.length);
  };
  const fillSoon = throttled(250, fill);
  kind.addEventListener("change", () => (run.markKind.value = kind.value));
  run.markKind.on(fill);
  own.addEventListener("change", () => (run.ownMarks.value = own.checked));
  run.ownMarks.on(fill);
  // Where a jump went.
  run.soughtMark.on((mark) => {
    const at = mark ? listed.indexOf(mark) : -1;
    if (at >= 0) list.reveal(at);
    list.update(listed.length);
  });
  run.marked.on(fillSoon);
  run.read.on(fill);
  run.selected.on(fill);
  fill();
  return h("div", { class: "marks" }, filters, list.element, none, dropped);
}
