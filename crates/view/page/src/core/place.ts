// A view as text behind the `#` of an address: `#t=12.5&select=bee-3&follow=1&camera=...`.
// Whoever opens it sees the same. What is not there stays as it is; what makes no sense is passed over.

import type { CameraState, ColourBy, Layers } from "../scene/index";

export interface Place {
  t_s?: number;
  camera?: CameraState;
  select?: string;
  follow?: boolean;
  layers?: Layers;
  colour?: { by: ColourBy; name: string };
  theme?: Theme;
  charts?: ChartKey[];
  panels?: string[];
  /** The kind of marks that are wanted; all without. */
  marks?: string;
}

export type Theme = "auto" | "light" | "dark";

/** A chart: of the run, or of the vehicle that is selected. */
export interface ChartKey {
  name: string;
  own: boolean;
}

export const layerNames = ["labels", "trails", "links", "packets", "beams", "wind", "grid", "world", "cut"] as const;
const colours: ColourBy[] = ["kind", "battery", "speed", "value"];
const themes: Theme[] = ["auto", "light", "dark"];

export function writePlace(place: Place): string {
  const out = new URLSearchParams();
  if (place.t_s !== undefined) out.set("t", String(round(place.t_s, 9)));
  if (place.select !== undefined) out.set("select", place.select);
  if (place.follow) out.set("follow", "1");
  if (place.camera) {
    const { from, at, flat } = place.camera;
    out.set("camera", [...from, ...at].map((x) => round(x, 3)).join(",") + (flat ? ",flat" : ""));
  }
  if (place.layers) {
    const shown = place.layers;
    out.set("layers", layerNames.filter((name) => shown[name]).join(","));
  }
  if (place.colour) {
    out.set("colour", place.colour.by === "value" ? `value:${place.colour.name}` : place.colour.by);
  }
  if (place.theme) out.set("theme", place.theme);
  if (place.charts) out.set("charts", place.charts.map((key) => (key.own ? "own:" : "") + key.name).join(","));
  if (place.marks) out.set("marks", place.marks);
  if (place.panels) out.set("panels", place.panels.join(","));
  // Readable where an address may be: commas, colons and slashes have no meaning of their own behind a `#`.
  return out.toString().replaceAll("%2C", ",").replaceAll("%3A", ":").replaceAll("%2F", "/");
}

export function readPlace(hash: string): Place {
  const given = new URLSearchParams(hash.replace(/^#/, ""));
  const place: Place = {};
  const t = given.get("t");
  if (t !== null && t !== "" && Number.isFinite(Number(t))) place.t_s = Number(t);
  const select = given.get("select");
  if (select) place.select = select;
  if (given.has("follow")) place.follow = given.get("follow") === "1";
  const camera = given.get("camera")?.split(",");
  if (camera) {
    const x = camera.slice(0, 6).map(Number);
    if (x.length === 6 && x.every(Number.isFinite)) {
      place.camera = { from: [x[0]!, x[1]!, x[2]!], at: [x[3]!, x[4]!, x[5]!], flat: camera[6] === "flat" };
    }
  }
  const layers = given.get("layers")?.split(",");
  if (layers) {
    place.layers = Object.fromEntries(layerNames.map((name) => [name, layers.includes(name)])) as unknown as Layers;
  }
  const colour = given.get("colour");
  if (colour?.startsWith("value:")) place.colour = { by: "value", name: colour.slice("value:".length) };
  else if (colour && colours.includes(colour as ColourBy)) place.colour = { by: colour as ColourBy, name: "" };
  const theme = given.get("theme");
  if (theme && themes.includes(theme as Theme)) place.theme = theme as Theme;
  const charts = given.get("charts");
  if (charts !== null) {
    place.charts = charts
      .split(",")
      .filter((text) => text !== "")
      .map((text) => (text.startsWith("own:") ? { name: text.slice(4), own: true } : { name: text, own: false }));
  }
  const marks = given.get("marks");
  if (marks) place.marks = marks;
  const panels = given.get("panels");
  if (panels !== null) place.panels = panels.split(",").filter((text) => text !== "");
  return place;
}

function round(x: number, decimals: number): number {
  return Number(x.toFixed(decimals));
}
