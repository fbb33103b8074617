// The panel on the left: what is drawn, by what it is coloured, and from where it is seen.

import { button, h, say, show } from "../core/dom";
import { unitWords, words } from "../core/format";
import { endsOf, kindsOf } from "../core/legend";
import { layerNames } from "../core/place";
import type { Signal } from "../core/signal";
import { batteryName, type Run } from "../run";
import { GREY, css } from "../scene/colours";
import type { ColourBy, Layers, Legend, ViewName } from "../scene/index";
import { linkScale } from "../scene/radio";
import { longest } from "../scene/wind";

export const layerWords: { [name in keyof Layers]: string } = {
  labels: "Names",
  trails: "Trails",
  links: "Radio links",
  packets: "Packets",
  beams: "Sensor beams",
  wind: "Wind",
  grid: "Grid",
  world: "World",
  cut: "Cut open",
};

/** The keys that switch them. */
export const layerKeys: { [name in keyof Layers]: string } = {
  labels: "1",
  trails: "2",
  links: "3",
  packets: "4",
  beams: "5",
  wind: "6",
  grid: "7",
  world: "8",
  cut: "x",
};

export const views: [name: ViewName, label: string, key: string, short: string][] = [
  ["orbit", "From above and aside", "o", "Orbit"],
  ["top", "From above", "t", "Top"],
  ["north", "From the north", "n", "N"],
  ["east", "From the east", "e", "E"],
  ["south", "From the south", "s", "S"],
  ["west", "From the west", "w", "W"],
];

/** With more radios the program tells packets of the selected vehicle, and no links. */
const MOST_RADIOS = 256;
/** With more vehicles only the selected one has a trail. */
const MOST_TRAILS = 500;

/** `list`: shows all vehicles of a kind in the list of vehicles. */
export function layersPanel(run: Run, dark: Signal<boolean>, look: (view: ViewName) => void, fit: () => void, list: (kind: string) => void): HTMLElement {
  return h(
    "section",
    { class: "panel left", id: "layers", "aria-label": "layers and colours" },
    h("h2", { text: "Show" }),
    layerBoxes(run, dark),
    h("h2", { text: "Colour by" }),
    colourChoice(run),
    legendBox(run, list),
    h("h2", { text: "View" }),
    h(
      "div",
      { class: "views" },
      ...views.map(([view, label, key, short]) => button(label, key, short, () => look(view), { class: "tool plain" })),
      button("All vehicles in sight", "a", "Show all", fit, { class: "tool plain", id: "fit" }),
    ),
  );
}

function layerBoxes(run: Run, dark: Signal<boolean>): HTMLElement {
  const list = h("div", { class: "checks" });
  const hints = new Map((["trails", "links", "packets", "cut"] as const).map((name) => [name as keyof Layers, h("span", { class: "faint" })]));
  const hint = () => {
    const many = run.count > MOST_RADIOS;
    say(hints.get("trails")!, run.count > MOST_TRAILS ? " of the selected vehicle" : "");
    say(hints.get("packets")!, !many ? "" : run.selected.value === null ? ": select a vehicle" : " of the selected vehicle");
    say(hints.get("links")!, many && run.links.value.length === 0 ? ` of up to ${MOST_RADIOS} radios` : "");
  };
  say(hints.get("cut")!, ": without roofs");
  run.selected.now(hint);
  run.links.on(hint);
  const rows = new Map<keyof Layers, { row: HTMLElement; box: HTMLInputElement }>();
  for (const name of layerNames) {
    const box = h("input", {
      type: "checkbox",
      id: `layer-${name}`,
      "aria-keyshortcuts": layerKeys[name],
      on: { change: () => run.toggleLayer(name) },
    });
    const row = h("label", { class: "check" }, box, h("span", {}, layerWords[name], hints.get(name) ?? null), h("kbd", { text: layerKeys[name] }));
    rows.set(name, { row, box });
    list.append(row);
    if (name === "links") list.append(linksScale(run, dark));
    if (name === "wind") list.append(windScale(run));
  }
  run.layers.now((layers) => {
    for (const [name, { box }] of rows) box.checked = layers[name];
  });
  // What a run does not have, nobody switches on.
  run.has.now((has) => {
    for (const name of ["links", "packets"] as const) show(rows.get(name)!.row, has.radio);
    show(rows.get("wind")!.row, has.wind);
    show(rows.get("beams")!.row, has.beams);
    show(rows.get("world")!.row, run.hello.stage.props.length > 0);
    show(rows.get("cut")!.row, has.overhead);
  });
  return list;
}

/** From which colour to which links go, and what that means; as long as there are any. */
function linksScale(run: Run, dark: Signal<boolean>): HTMLElement {
  const bar = h("div", { class: "ramp" });
  const { low, high } = linkScale(false);
  const scale = h("div", { class: "scale figure", id: "links-scale", title: "Links by the strength of their signal" }, h("span", { text: low }), bar, h("span", { text: high }));
  const end = dark.now((dark) => (bar.style.background = `linear-gradient(to right, ${linkScale(dark).stops.join(", ")})`));
  run.gone.signal.addEventListener("abort", end);
  const update = () => show(scale, run.layers.value.links && run.links.value.length > 0);
  run.links.now(update);
  run.layers.on(update);
  return scale;
}

/** How fast an arrow of full length is. */
function windScale(run: Run): HTMLElement {
  const text = h("span");
  const scale = h("div", { class: "scale figure", id: "wind-scale", title: "Arrows half as long: a quarter of the speed" }, text);
  const update = () => {
    const fastest = run.layers.value.wind ? longest(run.wind.value) : "";
    say(text, `arrows up to ${fastest}`);
    show(scale, fastest !== "");
  };
  run.wind.now(update);
  run.layers.on(update);
  return scale;
}

function colourChoice(run: Run): HTMLElement {
  const choice = h("select", { id: "colour-by", "aria-label": "colour vehicles by" });
  const fill = () => {
    const option = (value: string, text: string) => h("option", { value, text });
    const options = [option("kind", "kind"), option("speed", "speed")];
    const battery = batteryName(run.series);
    if (battery) options.push(option("battery", "battery"));
    for (const [name, of] of run.series.ofVehicles()) {
      const shown = unitWords(of);
      if (name !== battery) options.push(option(`value:${name}`, `${words(name)}${shown === "" ? "" : `, ${shown}`}`));
    }
    const { by, name } = run.colour.value;
    const chosen = by === "value" ? `value:${name}` : by;
    if (!options.some((it) => it.value === chosen)) options.push(option(chosen, words(name || by)));
    const same = [...choice.options].map((it) => it.value).join("\n") === options.map((it) => it.value).join("\n");
    if (!same) choice.replaceChildren(...options);
    choice.value = chosen;
  };
  choice.addEventListener("change", () => {
    const [by, ...name] = choice.value.split(":");
    run.paint({ by: by as ColourBy, name: name.join(":") });
  });
  run.series.known.now(fill);
  run.colour.on(fill);
  return choice;
}

function legendBox(run: Run, list: (kind: string) => void): HTMLElement {
  const box = h("div", { class: "legend", id: "legend", "aria-label": "legend" });
  run.legend.now((legend) => {
    box.replaceChildren(...(legend ? entries(run, legend, list) : []));
    show(box, legend !== null);
  });
  return box;
}

function entries(run: Run, legend: Legend, list: (kind: string) => void): HTMLElement[] {
  if (legend.names) {
    const { list: kinds, more } = kindsOf(legend, run.hello.vehicles.kinds);
    const rows: HTMLElement[] = kinds.map(({ name, colour, times }) => {
      const dot = h("span", { class: "dot" });
      dot.style.background = colour;
      return button(`List all of kind ${name}`, null, dot, () => list(name), { class: "entry" }, h("span", { class: "whole", text: name }), h("span", { class: "faint end figure", text: times }));
    });
    if (more > 0) rows.push(h("p", { class: "faint", text: `and ${more} more` }));
    return rows;
  }
  const bar = h("div", { class: "ramp" });
  bar.style.background = `linear-gradient(to right, ${legend.stops.join(", ")})`;
  const grey = h("span", { class: "dot" });
  grey.style.background = css(GREY);
  const { low, of, high } = endsOf(legend, run.colour.value.by);
  return [
    bar,
    h("div", { class: "ends" }, h("span", { text: low }), h("span", { class: "faint cut", text: of }), h("span", { text: high })),
    ...(legend.title === "speed" ? [] : [h("div", { class: "entry" }, grey, h("span", { class: "faint", text: "no value" }))]),
  ];
}
