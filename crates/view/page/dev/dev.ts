// The scene by itself, fed with a made-up swarm: for looking at it and for measuring. Not part of the page.
//
// ?n=100 vehicles, ?dark=1, ?flowers=2000, ?world=meadow|town|none, ?ground=grass, ?run=1: it flies. `window.dev` is for scripts.

import { createScene } from "../src/scene/scene";
import type { Layers, SceneView } from "../src/scene/index";
import type { Details, Form, Frame, Hello, Link, Packet, Piece, Prop, Quat } from "../src/wire";

const ask = new URLSearchParams(location.search);
const n = Number(ask.get("n") ?? 100);
const dark = ask.get("dark") === "1";
const flowers = Number(ask.get("flowers") ?? 600);
const worldName = ask.get("world") ?? "meadow";
const extent = Number(ask.get("extent") ?? Math.max(8, Math.cbrt(n) * 2.4));

let state = 7;
const random = (): number => {
  state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
  return state / 2 ** 32;
};

const forms: Form[] = [];
const form = (f: Form): number => {
  const text = JSON.stringify(f);
  const at = forms.findIndex((g) => JSON.stringify(g) === text);
  return at >= 0 ? at : forms.push(f) - 1;
};
const piece = (f: Form, at: [number, number, number], yaw = 0): Piece => ({ form: form(f), at, turn: [Math.cos(yaw / 2), 0, 0, Math.sin(yaw / 2)] });
const prop = (kind: string, label: string, color: string, texture: string, ...pieces: Piece[]): Prop => ({ kind, label, color, texture, pieces, meta: {} });

function person(x: number, y: number, color: string): Prop {
  const [w, h] = [0.7 / 13, 1.75 / 13];
  const boxes = [[3, 6, 0, 6], [7, 10, 0, 6], [3, 10, 6, 10], [0, 2, 4, 10], [11, 13, 4, 10], [6, 7, 10, 11], [5, 8, 11, 13]];
  return prop("person", "gardener", color, "", ...boxes.map(([l, r, b, t]) =>
    piece({ box: [((r! - l!) / 2) * w, 0.13, ((t! - b!) / 2) * h] }, [x + ((l! + r!) / 2 - 6.5) * w, y, ((b! + t!) / 2) * h])));
}

function hills(): Prop {
  const [cells, step] = [80, 1];
  const points: number[] = [];
  const triangles: number[] = [];
  for (let j = 0; j <= cells; j++) {
    for (let i = 0; i <= cells; i++) {
      const [x, y] = [(i - cells / 2) * step, (j - cells / 2) * step];
      points.push(x, y, 1.5 * Math.sin(x / 7) * Math.cos(y / 9) + 3 * Math.exp(-((x - 12) ** 2 + (y - 10) ** 2) / 90) - 2);
    }
  }
  for (let j = 0; j < cells; j++) {
    for (let i = 0; i < cells; i++) {
      const a = j * (cells + 1) + i;
      triangles.push(a, a + 1, a + cells + 2, a, a + cells + 2, a + cells + 1);
    }
  }
  return prop("terrain", "hills", "#6f8f5a", "grass", piece({ mesh: { points, triangles } }, [0, 0, 0]));
}

function props(): Prop[] {
  if (worldName === "none") return [];
  if (worldName === "hills") return [hills()];
  const list: Prop[] = [];
  const stem = form({ cylinder: [0.01, 0.01, 0.1] });
  const head = form({ cylinder: [0.1, 0.1, 0.01] });
  const beds = [["#ff6697", 5, -5], ["#f2f2ff", -6, -3], ["#8a5cff", 1, 7], ["#ffcf33", -3, 4]] as const;
  const spread = Math.sqrt(flowers / 600) * 2.2;
  for (let i = 0; i < flowers; i++) {
    const [color, cx, cy] = beds[i % beds.length]!;
    const r = spread * Math.sqrt(random());
    const a = 2 * Math.PI * random();
    const [x, y] = [cx * Math.max(1, spread / 3) + r * Math.cos(a), cy * Math.max(1, spread / 3) + r * Math.sin(a)];
    list.push({ kind: "flower", label: "bed", color, texture: "", meta: {}, pieces: [
      { form: stem, at: [x, y, 0.1], turn: [1, 0, 0, 0] },
      { form: head, at: [x, y, 0.21], turn: [1, 0, 0, 0] },
    ] });
  }
  list.push(prop("structure", "shed", "#b9ada0", "brick",
    piece({ box: [2, 0.12, 1.2] }, [-6, 9, 1.2]), piece({ box: [0.12, 1.5, 1.2] }, [-8, 10.5, 1.2]), piece({ box: [0.12, 1.5, 1.2] }, [-4, 10.5, 1.2])));
  list.push(prop("structure", "roof", "#8a4b3a", "", piece({ mesh: { points: [-8.4, 8.6, 2.4, -3.6, 8.6, 2.4, -3.6, 12.2, 2.4, -8.4, 12.2, 2.4, -8.4, 10.4, 3.5, -3.6, 10.4, 3.5],
    triangles: [0, 1, 5, 0, 5, 4, 2, 3, 4, 2, 4, 5, 0, 4, 3, 1, 2, 5] } }, [0, 0, 0])));
  list.push(prop("obstacle", "crate", "#8c8c8c", "wood", piece({ box: [0.45, 0.45, 0.45] }, [3, 1, 0.45], 0.4)));
  list.push(prop("obstacle", "small crate", "#8c8c8c", "wood", piece({ box: [0.25, 0.25, 0.25] }, [3.05, 1, 1.15], 1)));
  list.push(prop("obstacle", "stone", "#8c8c8c", "stone", piece({ cylinder: [0.6, 0.45, 0.5] }, [6, 3, 0.5])));
  list.push(prop("obstacle", "ball", "#d8c23c", "", piece({ sphere: 0.5 }, [-2, -6, 0.5])));
  list.push(prop("obstacle", "tank", "#9fb4c4", "metal", piece({ capsule: [0.6, 0.8] }, [8, 8, 1.4])));
  list.push(prop("obstacle", "glass", "#88ccff60", "", piece({ box: [1.2, 0.05, 1] }, [0, -8, 1])));
  for (let i = 0; i < 14; i++) {
    const a = (i / 14) * 2 * Math.PI + 0.2 * random();
    const r = 15 + 5 * random();
    const [x, y, h] = [r * Math.cos(a), r * Math.sin(a), 1.5 + random()];
    list.push(prop("obstacle", "trunk", "#7a5a3c", "wood", piece({ cylinder: [0.22, 0.15, h] }, [x, y, h])));
    list.push(i % 3 ? prop("obstacle", "tree", "#8c8c8c", "tree", piece({ sphere: 1.4 + random() * 0.6 }, [x, y, 2 * h + 1]))
      : prop("obstacle", "fir", "#3c7a4a", "tree", piece({ cylinder: [1.4, 0, 2.2] }, [x, y, 2 * h + 1.6])));
  }
  list.push(person(-1, -2, "#cdaf9580"), person(2, 4.5, "#3c64a0"));
  if (worldName === "town") {
    for (let i = 0; i < 400; i++) {
      const [gx, gy] = [(i % 20) - 10, Math.floor(i / 20) - 10];
      const h = 4 + 16 * random() ** 3;
      list.push(prop("structure", "house", ["#a85e48", "#be8c68", "#8c8c90", "#d0c8b8"][i % 4]!, i % 4 < 2 ? "brick" : "", piece({ box: [5 + 2 * random(), 5 + 2 * random(), h] }, [gx * 24 + 12, gy * 24 + 12, h])));
    }
  }
  return list;
}

const hive: Piece[] = [0, 1, 2].map((i) => piece({ box: [0.3, 0.25, 0.14] }, [0, 0, 0.14 + i * 0.3 - 0.44]));
const looks = [{ pieces: [piece({ sphere: 0.05 }, [0, 0, 0])] }, { pieces: hive }, { pieces: [piece({ box: [0.4, 0.4, 0.15] }, [0, 0, 0])] }];
const kind = (i: number): string => (i === 0 ? "hive" : i === 1 ? "truck" : ["forager", "scout", "nurse", "guard"][i % 4]!);
const role = (i: number): string => (i === 0 ? "station" : i === 1 ? "ghost" : "vehicle");
const who = Array.from({ length: n }, (_, i) => i);
const stageProps = props();
const hello: Hello = {
  type: "hello", protocol: 1, mode: "live", name: "dev", seed: "1", version: "0", end_s: null, truncated: false,
  vehicles: {
    paths: who.map((i) => `${kind(i)}-${i}`), kinds: who.map(kind), roles: who.map(role),
    radii_m: who.map((i) => (i < 2 ? 0.5 : 0.06)), colors: who.map(() => "#f0b21e"), looks: who.map((i) => (i === 0 ? 1 : i === 1 ? 2 : 0)),
  },
  looks, forms,
  stage: { ground: "#7da36a", texture: ask.get("ground") ?? "", plane: worldName !== "hills", radius_m: Number(ask.get("radius") ?? 500), props: stageProps },
};

const phase = who.map(() => [random() * 6.28, random() * 6.28, random(), random(), 0.3 + random() * 0.7, random() * 6.28]);
function frame(t: number): Frame {
  const positions = new Float32Array(3 * n);
  const velocities = new Float32Array(3 * n);
  const values = new Float32Array(n);
  const attitudes = new Int16Array(4 * n);
  for (let i = 0; i < n; i++) {
    const [a, b, u, v, w, c] = phase[i]! as [number, number, number, number, number, number];
    const r = extent * (0.15 + 0.85 * Math.sqrt(u));
    const at = (s: number): [number, number, number] => [
      r * Math.cos(a + 0.12 * w * s) + 0.8 * Math.sin(b + 0.9 * s * w),
      r * Math.sin(a + 0.12 * w * s) + 0.8 * Math.cos(c + 0.7 * s * w),
      0.7 + extent * 0.45 * v + 0.5 * Math.sin(c + 0.6 * s * w),
    ];
    const p = i === 0 ? ([0, 0, 0.44] as const) : at(t);
    const q = at(t + 0.01);
    const d = i === 0 ? [1, 0, 0] : [0, 1, 2].map((k) => (q[k]! - p[k]!) * 100);
    positions.set(p, 3 * i);
    velocities.set(i === 0 ? [0, 0, 0] : d, 3 * i);
    values[i] = i % 17 === 3 ? NaN : 0.5 + 0.5 * Math.sin(a + 0.05 * t);
    const yaw = Math.atan2(d[1]!, d[0]!);
    const pitch = -0.15;
    const turn: Quat = [Math.cos(yaw / 2) * Math.cos(pitch / 2), Math.sin(yaw / 2) * -Math.sin(pitch / 2), Math.cos(yaw / 2) * Math.sin(pitch / 2), Math.sin(yaw / 2) * Math.cos(pitch / 2)];
    attitudes.set(turn.map((x) => Math.round((i === 0 ? [1, 0, 0, 0][turn.indexOf(x)]! : x) * 32767)), 4 * i);
  }
  if (n > 0) attitudes.set([32767, 0, 0, 0], 0);
  return { time: t, n, positions, velocities, values, attitudes };
}

function links(t: number): Link[] {
  const f = frame(t);
  const list: Link[] = [];
  const far = extent * 0.45;
  for (let i = 0; i < n && list.length < 3000; i++) {
    for (let j = i + 1; j < Math.min(n, i + 60); j++) {
      const d = Math.hypot(...[0, 1, 2].map((k) => f.positions[3 * i + k]! - f.positions[3 * j + k]!));
      if (d < far) list.push([i, j, -45 - (50 * d) / far, 1 - (0.7 * d) / far]);
    }
  }
  return list;
}

function packets(t: number, count: number): Packet[] {
  return Array.from({ length: count }, (_, i) => {
    const from = (i * 13 + 2) % n;
    return { t, from, bytes: 24, to: Array.from({ length: 8 }, (_, k) => [(from + 3 + k * 5) % n, -50 - 5 * k] as [number, number]) };
  });
}

function details(vehicle: number, t: number): Details {
  const rays = Array.from({ length: 24 }, (_, i) => [Math.cos((i * Math.PI) / 12), Math.sin((i * Math.PI) / 12), 0] as [number, number, number]);
  const level = { at: [0, 0, 0] as [number, number, number], turn: [1, 0, 0, 0] as Quat };
  const base = { t, truth: null, lost: false };
  return {
    type: "details", vehicle, t, parts: [], battery: null, radios: [], packets: [],
    sensors: [
      { ...base, name: "lidar", mount: level, beams: { rays, range_m: 4 }, columns: [["range", "m"]], reading: rays.map((_, i) => (i % 3 === 0 ? 4 : 1.5 + Math.sin(i))) },
      { ...base, name: "camera", mount: level, beams: { frustum: [1.1, 0.8], range_m: 2.5 }, columns: [], reading: null },
      { ...base, name: "sonar", mount: { at: [0, 0, 0], turn: [Math.SQRT1_2, 0, Math.SQRT1_2, 0] }, beams: { cone: 0.3, range_m: 2 }, columns: [], reading: null },
      { ...base, name: "finder", mount: level, beams: { ball: true, range_m: 3 }, columns: [], reading: null },
    ],
  };
}

function wind(): number[][] {
  const list: number[][] = [];
  const step = extent / 3;
  for (let x = -3; x <= 3; x++) for (let y = -3; y <= 3; y++) list.push([x * step, y * step, extent * 0.3, 3 + Math.sin(y), 1 + Math.sin(x * 0.7), 0.2]);
  return list;
}

const told: Record<string, unknown> = {};
const layers: Layers = { labels: false, trails: true, links: false, packets: true, beams: true, wind: false, grid: true, world: true, cut: false };
const started = performance.now();
const view: SceneView = createScene(document.getElementById("scene")!, {
  hello, dark,
  onPick: (v) => (told["pick"] = v),
  onHover: (v) => (told["hover"] = v),
  onCamera: (v) => (told["camera"] = v),
  onLegend: (v) => (told["legend"] = v),
  onLost: () => (told["lost"] = true),
  onOverhead: (v) => (told["overhead"] = v),
});
view.setLayers(layers);
told["built_ms"] = performance.now() - started;

const period = 0.1;
let tick = 0;
let [a, b] = [frame(0), frame(period)];
function goTo(t: number): void {
  while (tick * period < t) {
    tick++;
    [a, b] = [b, frame((tick + 1) * period)];
    view.show(a, b, 0);
  }
  view.show(a, b, Math.min(1, Math.max(0, (t - a.time) / period)));
}
goTo(Number(ask.get("t") ?? 6));

if (ask.get("run") === "1") {
  const from = performance.now() / 1000 - 6;
  let last = 0;
  const loop = (): void => {
    const t = performance.now() / 1000 - from;
    if (t - last > 0.4) {
      last = t;
      if (layers.packets) view.addPackets(packets(t, 4), 1);
      if (layers.links) view.setLinks(links(t));
    }
    goTo(t);
    requestAnimationFrame(loop);
  };
  loop();
}

Object.assign(window, { dev: { view, layers, told, goTo, links, packets, details, wind, frame, hello } });
