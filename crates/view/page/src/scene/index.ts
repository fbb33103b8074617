// The world and the swarm in three dimensions: what the rest of the page needs to know of it.
//
// `createScene(host, options)` of scene.ts makes one. The host is an element with a size and a `position` other than
// `static`; two canvases fill it (the picture, and what is written over it). It throws if the browser has no WebGL 2.

import type { Caption } from "./caption";
import type { Details, Frame, Hello, Link, Packet } from "../wire";

export { createScene } from "./scene";
export type { Caption } from "./caption";
export { trailSeconds, trailStep } from "./trails";

/** `battery` and `value` are the colour values of the frames, `battery` from 0 to 1; `speed` is of their velocities. */
export type ColourBy = "kind" | "battery" | "speed" | "value";

/** What is drawn besides vehicles. */
export interface Layers {
  labels: boolean;
  trails: boolean;
  links: boolean;
  packets: boolean;
  beams: boolean;
  wind: boolean;
  /** Metric lines on the ground, the scale and the compass. */
  grid: boolean;
  world: boolean;
  /** The world without what is above the swarm: roofs, upper storeys. */
  cut: boolean;
}

/** `top`: from above, north up. `north`: seen from the north, as `top` is from the top. `orbit`: back to perspective. */
export type ViewName = "top" | "north" | "east" | "south" | "west" | "orbit";

/** Where the camera is and what it looks at, world frame ENU, m. Goes into links. */
export interface CameraState {
  from: [number, number, number];
  at: [number, number, number];
  /** Without perspective, as from far away: top and side views. */
  flat: boolean;
}

/** What a colour scale shows, for its legend. */
export interface Legend {
  title: string;
  unit: string;
  low: number;
  high: number;
  /** Colours from low to high as CSS; empty if there are names. Grey is what has no value. */
  stops: string[];
  /** Kinds with their colours, at most 12. */
  names?: [string, string][];
}

export interface SceneOptions {
  hello: Hello;
  dark: boolean;
  /** A vehicle was clicked; null: nothing. Selects nothing by itself. */
  onPick(vehicle: number | null): void;
  /** A vehicle, a link, an arrow of the wind or a thing of the world was pointed at, in words; null: nothing. */
  onHover(text: string | null): void;
  /** The camera has moved; at most four times a second, and at its end. */
  onCamera(state: CameraState): void;
  /** What the colours mean, whenever that changes; the first time while the scene is made. */
  onLegend(legend: Legend | null): void;
  /** The last vehicle has left the picture. */
  onLost(): void;
  /**
   * Now and then while the world is whole, if anything of it is above the swarm, so that `cut` makes a difference. `hides`:
   * most of the swarm is hidden from wherever one looks.
   */
  onOverhead(hides: boolean): void;
}

/** Implemented in scene.ts. Draws only when something has changed. */
export interface SceneView {
  /**
   * The swarm at fraction f (0 to 1) between two frames; the same frame twice for one instant. Frames are known by
   * identity: they must not be changed afterwards. The first call looks at the swarm, unless `setCamera` came before.
   */
  show(a: Frame, b: Frame, f: number): void;
  /** Forgets trails: time has jumped. Going back in time does so by itself. */
  jumped(): void;
  /** Trails are those of these frames, in the order of time, up to the one that is shown. */
  retrace(past: Frame[]): void;
  setDark(dark: boolean): void;
  setLayers(layers: Layers): void;
  /** `title` and `unit` are for the legend. */
  setColour(by: ColourBy, title: string, unit: string): void;
  /** Marks it, and draws its height, its trail, and what `setDetails` says of it; null: none. */
  select(vehicle: number | null): void;
  /** The camera goes with this vehicle, and may be turned and zoomed meanwhile; null: it stays. */
  follow(vehicle: number | null): void;
  setView(name: ViewName): void;
  /** All vehicles in sight, from the direction that the camera has. */
  fit(): void;
  setCamera(state: CameraState): void;
  camera(): CameraState;
  /** Of the selected vehicle; details of others are not drawn. */
  setDetails(details: Details | null): void;
  /** Replaces all links. */
  setLinks(list: Link[]): void;
  /**
   * Packets become pulses from sender to receivers, a third of a wall second long; longer if time runs slowly. `speed`:
   * virtual seconds per wall second.
   */
  addPackets(list: Packet[], speed: number): void;
  setWind(arrows: number[][]): void;
  /** The picture as it is, PNG, with labels and what the caption says; what is looked at is in its middle, for it has no panels. */
  png(caption: Caption): Promise<Blob>;
  /** So much of the picture is under a panel, from its left edge, CSS pixels: its middle is that of the rest. */
  setCovered(left_px: number): void;
  /** Called by itself when the host changes its size. */
  resize(): void;
  /**
   * Pictures drawn so far, and the mean time of the last ones from their beginning until the graphics card was done, ms
   * (0 before the fourth): for tests and the status line.
   */
  stats(): { drawn: number; ms: number };
  /** Whether the picture is finished as it is, and no other is to come by itself: for tests. */
  quiet(): boolean;
  dispose(): void;
}
