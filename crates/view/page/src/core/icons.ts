// The icons: strokes on a field of 16 by 16, in the colour of the text.

import { svg } from "./dom";

const paths = {
  play: "M5 3.2v9.6L12.6 8z",
  pause: "M5.2 3.5v9M10.8 3.5v9",
  step: "M4 3.5v9L10 8zM12.2 3.5v9",
  back: "M12 3.5v9L6 8zM3.8 3.5v9",
  nextMark: "M3 8h6.5M7 5l3 3-3 3M13 3.5v9",
  lastMark: "M13 8H6.5M9 5L6 8l3 3M3 3.5v9",
  search: "M7 11.5a4.5 4.5 0 1 0 0-9 4.5 4.5 0 0 0 0 9zM10.4 10.4l3.4 3.4",
  camera: "M2.5 5h2.3l1.2-1.8h4L11.2 5h2.3v8h-11zM8 11.2a2.3 2.3 0 1 0 0-4.6 2.3 2.3 0 0 0 0 4.6z",
  link: "M6.7 9.3a2.6 2.6 0 0 0 3.8.2l2-2a2.7 2.7 0 0 0-3.8-3.8l-1 1M9.3 6.7a2.6 2.6 0 0 0-3.8-.2l-2 2a2.7 2.7 0 0 0 3.8 3.8l1-1",
  help: "M5.8 6a2.2 2.2 0 1 1 3.4 1.9c-.8.5-1.2.9-1.2 1.8M8 12.2v.3",
  light: "M8 10.8a2.8 2.8 0 1 0 0-5.6 2.8 2.8 0 0 0 0 5.6zM8 1.5v1.4M8 13.1v1.4M1.5 8h1.4M13.1 8h1.4M3.4 3.4l1 1M11.6 11.6l1 1M3.4 12.6l1-1M11.6 4.4l1-1",
  dark: "M13 9.6A5.6 5.6 0 0 1 6.4 3a5.4 5.4 0 1 0 6.6 6.6z",
  auto: "M8 13.5a5.5 5.5 0 1 0 0-11 5.5 5.5 0 0 0 0 11zM8 2.5v11M8 5h3.8M8 8h5.4M8 11h3.8",
  text: "M2.5 12.5L6 3.5l3.5 9M3.6 9.8h4.8M10.8 12.5l2-5 2 5M11.3 11h3",
  full: "M2.5 6V2.5H6M10 2.5h3.5V6M13.5 10v3.5H10M6 13.5H2.5V10",
  layers: "M8 2.5L14 6 8 9.5 2 6zM2.5 9.2L8 12.5l5.5-3.3",
  chart: "M2.5 2.5v11h11M4.5 10.5l3-3.5 2.3 2 3.7-5",
  target: "M8 12.5a4.5 4.5 0 1 0 0-9 4.5 4.5 0 0 0 0 9zM8 1.5v4M8 10.5v4M1.5 8h4M10.5 8h4",
  fit: "M3 5V3h2M11 3h2v2M13 11v2h-2M5 13H3v-2M8 9.5a1.5 1.5 0 1 0 0-3 1.5 1.5 0 0 0 0 3z",
  close: "M4 4l8 8M12 4l-8 8",
  plus: "M8 3.5v9M3.5 8h9",
  list: "M5.5 4h8M5.5 8h8M5.5 12h8M2.5 4h.2M2.5 8h.2M2.5 12h.2",
  slower: "M8 4L3.5 8 8 12M13 4L8.5 8 13 12",
  faster: "M8 4l4.5 4L8 12M3 4l4.5 4L3 12",
  flag: "M4 14V2.5h8L10.2 5.5 12 8.5H4",
} as const;

export type Icon = keyof typeof paths;

export function icon(name: Icon): SVGElement {
  const root = svg("svg", { viewBox: "0 0 16 16", class: "icon", "aria-hidden": "true", focusable: "false" });
  root.append(svg("path", { d: paths[name] }));
  return root;
}
