// What a saved picture says of itself: which run, when, and what its colours, lines and arrows mean.

import { count, fixed, words } from "../core/format";
import { endsOf, kindsOf } from "../core/legend";
import type { Run } from "../run";
import { GREY, css } from "../scene/colours";
import type { Caption } from "../scene/index";
import { linkScale } from "../scene/radio";
import { longest } from "../scene/wind";

export function captionOf(run: Pick<Run, "name" | "hello" | "time" | "legend" | "colour" | "layers" | "links" | "wind">, dark: boolean): Caption {
  const { hello } = run;
  const title = [run.name, `seed ${hello.seed}`, `${fixed(run.time.value, 2)}\u00a0s`].join(" · ");
  const rows: Caption["rows"] = [];
  const legend = run.legend.value;
  const { by, name } = run.colour.value;
  if (legend?.names) {
    const { list, more } = kindsOf(legend, hello.vehicles.kinds);
    for (const kind of list) rows.push({ dot: kind.colour, text: kind.name, end: kind.times });
    if (more > 0) rows.push({ text: `and ${count(more)} more kinds` });
  } else if (legend) {
    const { low, of, high } = endsOf(legend, by);
    const what = by === "battery" ? "charge" : by === "value" ? words(name) : by;
    rows.push({ ramp: legend.stops, low, of: of === "" || of === what ? what : `${what}, ${of}`, high });
    if (by !== "speed") rows.push({ dot: css(GREY), text: "no value", end: "" });
  }
  const layers = run.layers.value;
  if (layers.links && run.links.value.length > 0) {
    const { stops, low, high } = linkScale(dark);
    rows.push({ ramp: stops, low, of: "radio links", high });
  }
  const wind = layers.wind ? longest(run.wind.value) : "";
  if (wind !== "") rows.push({ text: `wind: arrows up to ${wind}` });
  return { title, rows };
}
