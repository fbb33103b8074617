// The world and the swarm in three dimensions: what the rest of the page needs to know of it.

import type { Details, Frame, Hello, Link, Packet } from "../wire";

export type ColourBy = "kind" | "battery" | "speed" | "value";

/** What is drawn besides world and vehicles. */
export interface Layers {
  labels: boolean;
  trails: boolean;
  links: boolean;
  packets: boolean;
  beams: boolean;
  wind: boolean;
  grid: boolean;
  world: boolean;
}

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
  /** Colours from low to high as CSS, or names with their colours. */
  stops: string[];
  names?: [string, string][];
}

export interface SceneOptions {
  hello: Hello;
  dark: boolean;
  /** A vehicle was clicked; null: nothing. */
  onPick(vehicle: number | null): void;
  /** A world object was pointed at; null: nothing. */
  onHover(text: string | null): void;
  onCamera(state: CameraState): void;
  onLegend(legend: Legend | null): void;
}

/** Implemented in scene.ts. Draws only when something has changed. */
export interface SceneView {
  /** The swarm at fraction f (0 to 1) between two frames; the same frame twice for one instant. */
  show(a: Frame, b: Frame, f: number): void;
  /** Forgets trails: time has jumped. */
  jumped(): void;
  setDark(dark: boolean): void;
  setLayers(layers: Layers): void;
  setColour(by: ColourBy, title: string, unit: string): void;
  select(vehicle: number | null): void;
  /** The camera goes with this vehicle; null: it stays. */
  follow(vehicle: number | null): void;
  setView(name: ViewName): void;
  /** All vehicles in sight. */
  fit(): void;
  setCamera(state: CameraState): void;
  camera(): CameraState;
  setDetails(details: Details | null): void;
  setLinks(list: Link[]): void;
  /** Packets become pulses from sender to receivers; `speed`: virtual seconds per wall second. */
  addPackets(list: Packet[], speed: number): void;
  setWind(arrows: number[][]): void;
  /** The picture as it is, PNG, without panels. */
  png(): Promise<Blob>;
  resize(): void;
  /** Pictures drawn so far, and the mean time of the last ones, ms: for tests and the status line. */
  stats(): { drawn: number; ms: number };
  dispose(): void;
}
