// What the server says and hears; see ../../PROTOCOL.md.

export type Vec3 = [number, number, number];
/** w, x, y, z: from body to world. */
export type Quat = [number, number, number, number];

export type Form =
  | { sphere: number }
  | { box: Vec3 }
  | { cylinder: [foot: number, top: number, halfHeight: number] }
  | { capsule: [radius: number, halfHeight: number] }
  | { mesh: { points: number[]; triangles: number[] } };

export interface Piece {
  form: number;
  at: Vec3;
  turn: Quat;
}

export interface Prop {
  kind: string;
  label: string;
  color: string;
  texture: string;
  pieces: Piece[];
  meta: Record<string, string>;
}

export interface Stage {
  ground: string;
  /** The picture on the ground, as that of a prop; empty for none. */
  texture?: string;
  plane: boolean;
  radius_m: number;
  props: Prop[];
}

export interface Hello {
  type: "hello";
  protocol: number;
  mode: "live" | "replay";
  name: string;
  seed: string;
  version: string;
  end_s: number | null;
  truncated: boolean;
  vehicles: {
    paths: string[];
    kinds: string[];
    roles: string[];
    radii_m: number[];
    colors: string[];
    looks: number[];
  };
  looks: { pieces: Piece[] }[];
  forms: Form[];
  stage: Stage;
  replay?: { from_s: number; to_s: number; ticks_s: number[]; period_s: number };
}

export interface State {
  type: "state";
  time_s: number;
  paused: boolean;
  factor: number | null;
  speed: number;
  ended: string | null;
  events: number;
  viewers: number;
  skipped: number;
}

export interface Series {
  id: number;
  name: string;
  unit: string;
  vehicle: number | null;
}

export interface Mark {
  t: number;
  kind: string;
  who: number[];
  text: string;
}

export interface Packet {
  t: number;
  from: number;
  bytes: number;
  to: [vehicle: number, rssi: number][];
}

/** From, to, mean RSSI (dBm), share of frames received. */
export type Link = [from: number, to: number, rssi: number, share: number];

export type Beams =
  | { rays: Vec3[]; range_m: number }
  | { cone: number; range_m: number }
  | { frustum: [number, number]; range_m: number }
  | { ball: true; range_m: number };

export interface SensorDetails {
  name: string;
  t: number | null;
  mount: { at: Vec3; turn: Quat };
  beams: Beams | null;
  columns: [name: string, unit: string][];
  reading: (number | null)[] | null;
  truth: (number | null)[] | null;
  lost: boolean;
}

export interface Details {
  type: "details";
  vehicle: number;
  t: number;
  parts: { place: string; name: string; parameters: [string, string][] }[];
  sensors: SensorDetails[];
  battery: { soc: number; voltage_v: number; current_a: number; condition: string } | null;
  radios: {
    name: string;
    channel: number | null;
    state: string | null;
    /** Frames; null if nobody counted. */
    sent: number | null;
    received: number | null;
    lost: Record<string, number>;
  }[];
  packets: { t: number; sent: boolean; other: number | null; bytes: number; rssi_dbm: number | null }[];
}

export type ServerMessage =
  | Hello
  | State
  | { type: "series"; list: Series[] }
  | { type: "history"; id: number; times_s: number[]; values: (number | null)[] }
  | { type: "marks"; list: Mark[]; dropped: number }
  | { type: "packets"; list: Packet[]; dropped: number }
  | { type: "links"; t: number; period_s: number; list: Link[] }
  | { type: "wind"; t: number; arrows: number[][] }
  | Details
  | { type: "fetched"; id: number }
  | { type: "error"; text: string };

export type PageMessage =
  | { type: "pause" | "resume" }
  | { type: "step"; instants?: number; seconds?: number }
  | { type: "pace"; factor: number | null }
  | { type: "select"; vehicle: number | null; t?: number }
  | { type: "colour"; by: string | null }
  | { type: "got"; time_s: number }
  | { type: "fetch"; id: number; from_s: number; to_s: number; step_s: number }
  | { type: "history"; id: number };

/** All vehicles at one instant. */
export interface Frame {
  time: number;
  n: number;
  positions: Float32Array;
  velocities: Float32Array | null;
  /** NaN where there is none. */
  values: Float32Array | null;
  /** w, x, y, z, each times 32767. */
  attitudes: Int16Array;
}

export interface Values {
  time: number;
  ids: Uint32Array;
  values: Float64Array;
}
