// Where to look when nobody has said: at the world before the first frame, then at the swarm, and after it as it
// leaves the picture.

import * as THREE from "three";
import type { Vec3 } from "../wire";
import type { Orbit } from "./camera";
import type { Frames } from "./frames";
import { length, sub, unit } from "./math";
import { firstHit } from "./picking";
import type { World } from "./world";

/** The first view goes with the swarm closely for so long, s of virtual time, unless somebody looks elsewhere. */
const FIRST_VIEW_S = 10;
/** It moves when a smaller share of the vehicles is in sight: in that time, and afterwards. */
const MANY = 0.7;
const FEW = 0.3;
/** Who sees more of them looks at the swarm. */
const HALF = 0.5;
/** Where the first view stands, seen from the swarm, rad: the lowest from which the world hides little of it. */
const ELEVATIONS = [0.36, 0.6, 0.85, 1.1, 1.35, 1.5];
/** By so many of the vehicles that is judged, and such a share of them must be seen. */
const SAMPLES = 20;
const CLEAR = 0.8;
/** Where fewer are seen from every elevation, the world hides the swarm. */
const DIM = 0.5;
/** The ceiling of a world that is cut open is above such a share of the vehicles. */
const HIGH = 0.9;
/** About so many vehicles tell whether the swarm is still in sight. */
const POLLED = 400;

export class Sight {
  /** How far from the origin there is anything to see, m. */
  reach = 10;
  /** When the view that nobody has chosen began; null: somebody has. */
  private since_s: number | null = null;
  private placed = false;
  /** Somebody has chosen a direction, or whom to follow, before there was anything to see. */
  private directed = false;
  private sighted = false;
  private points: Vec3[] = [];
  private spot = new Float64Array(3);

  constructor(
    private orbit: Orbit,
    private frames: Frames,
    private world: World,
    private radii: ArrayLike<number>,
  ) {}

  /** Above nearly all of the swarm, m; the ceiling of a world that is cut open. */
  height_m(): number {
    const heights = this.some(POLLED).map((p) => p[2]).sort((x, y) => x - y);
    return heights[Math.floor(HIGH * (heights.length - 1))] ?? Infinity;
  }

  /** Whether what begins above this hides most of the swarm, from wherever one looks. */
  hidden(height_m: number): boolean {
    const some = this.some(SAMPLES);
    const [x, y] = this.orbit.axes()[1];
    /** Whether enough are seen from one of the elevations. */
    const clear = (ceiling_m: number) =>
      ELEVATIONS.some((elevation) => {
        const level = Math.cos(elevation);
        const up: Vec3 = [level * y, -level * x, Math.sin(elevation)];
        return some.filter((from) => !firstHit(this.world, from, up, ceiling_m)).length >= DIM * some.length;
      });
    return some.length > 0 && !clear(Infinity) && clear(height_m);
  }

  /** Somebody has chosen what to look at, or from where: a swarm that is still to come is looked at from there. */
  chosen(): void {
    this.since_s = null;
    this.directed = true;
  }

  /** Somebody has chosen both: the swarm is not looked for. */
  settled(): void {
    this.since_s = null;
    this.placed = true;
  }

  /** Before the first frame: the world. */
  onWorld(): void {
    const box = this.world.bounds;
    if (box.isEmpty()) return;
    this.reach = Math.max(this.reach, box.min.length(), box.max.length());
    this.orbit.fit(corners(box), 0, true);
  }

  /** After new frames. `view`: the last picture's. Whether the camera has somewhere to go. */
  passed(from_s: number, to_s: number, view: THREE.Matrix4, moving: boolean): boolean {
    if (!this.placed) {
      this.placed = true;
      if (!this.directed) this.since_s = from_s;
      return this.onSwarm(true);
    }
    if (this.since_s === null) return false;
    const passed_s = to_s - this.since_s;
    if (passed_s < 0) this.since_s = null;
    else if (!moving && this.seen(view) < (passed_s > FIRST_VIEW_S ? FEW : MANY)) return this.onSwarm(false);
    return false;
  }

  /** Less of the picture, or more of it, is covered: a view that nobody has chosen fits into the rest. */
  covered(): void {
    if (!this.placed) this.onWorld();
    else if (this.since_s !== null) this.onSwarm(true);
  }

  /** Whether the last vehicle has just left a picture that somebody has chosen; told again when most have been back. */
  lost(view: THREE.Matrix4): boolean {
    if (this.since_s !== null) return false;
    const seen = this.seen(view);
    if (seen > HALF) this.sighted = true;
    if (seen > 0 || !this.sighted || !this.placed) return false;
    this.sighted = false;
    return true;
  }

  /** All vehicles in sight. `first`: it is the first view. Whether there are any. */
  onSwarm(first: boolean): boolean {
    const box = new THREE.Box3();
    let radius = 0.05;
    const points = this.places();
    for (const p of points) box.expandByPoint(new THREE.Vector3(...p));
    for (let i = 0; i < this.frames.count; i++) radius = Math.max(radius, this.radii[i] ?? 0);
    if (points.length === 0) return false;
    const size = box.getSize(new THREE.Vector3()).length();
    this.reach = Math.max(this.reach, box.min.length(), box.max.length());
    // With the world around, if that is not much larger than the swarm.
    const around = this.world.bounds;
    const wide = around.isEmpty() ? Infinity : around.getSize(new THREE.Vector3()).length();
    const whole = (first || this.orbit.aside()) && wide < Math.max(size, radius * 20) * 1.4;
    const all = whole ? [...points, ...corners(around)] : points;
    const margin = Math.max(radius * 3, size * 0.03, 0.3);
    this.orbit.fit(all, margin, first);
    this.orbit.standOn(all.reduce((low, p) => Math.min(low, p[2]), 0), first);
    if (first && !this.directed && !around.isEmpty()) this.lookOver(all, margin);
    return true;
  }

  /** Rises until the world hides few of the swarm; if that never comes, to where it hides least. */
  private lookOver(points: Vec3[], margin: number): void {
    const some = this.some(SAMPLES);
    let best = { elevation: ELEVATIONS[0]!, seen: 0 };
    for (const elevation of ELEVATIONS) {
      this.orbit.raise(elevation);
      this.orbit.fit(points, margin, true);
      const { from } = this.orbit.state();
      const seen = some.filter((to) => {
        const away = sub(to, from);
        const hit = firstHit(this.world, from, unit(away));
        return !hit || hit.away_m > length(away);
      }).length;
      if (seen >= CLEAR * some.length) return;
      if (seen > best.seen) best = { elevation, seen };
    }
    this.orbit.raise(best.elevation);
    this.orbit.fit(points, margin, true);
  }

  /** The places of so many vehicles, or of all. */
  private some(most: number): Vec3[] {
    const { frames } = this;
    const found: Vec3[] = [];
    for (let i = 0; i < frames.count; i += Math.max(1, Math.ceil(frames.count / most))) {
      const p = frames.place(i);
      if (p) found.push(p);
    }
    return found;
  }

  private places(): Vec3[] {
    const { points, frames } = this;
    points.length = 0;
    for (let i = 0; i < frames.count; i++) {
      const p = frames.place(i);
      if (p) points.push(p);
    }
    return points;
  }

  /** A view from the side was asked for: of the swarm, unless somebody looks closely at something. */
  aside(view: THREE.Matrix4): void {
    if (!this.orbit.following() && this.seen(view) > HALF) this.onSwarm(false);
  }

  /** The share of vehicles in the picture, about. */
  private seen(view: THREE.Matrix4): number {
    const m = view.elements;
    const p = this.spot;
    let [seen, all] = [0, 0];
    const step = Math.max(1, Math.floor(this.frames.count / POLLED));
    for (let i = 0; i < this.frames.count; i += step) {
      if (!this.frames.read(i, p)) continue;
      all += 1;
      const w = m[3]! * p[0]! + m[7]! * p[1]! + m[11]! * p[2]! + m[15]!;
      const x = m[0]! * p[0]! + m[4]! * p[1]! + m[8]! * p[2]! + m[12]!;
      const y = m[1]! * p[0]! + m[5]! * p[1]! + m[9]! * p[2]! + m[13]!;
      if (w > 0 && Math.abs(x) <= w && Math.abs(y) <= w) seen += 1;
    }
    return all > 0 ? seen / all : 1;
  }
}

function corners(box: THREE.Box3): Vec3[] {
  const ends = [box.min, box.max];
  return Array.from({ length: 8 }, (_, i) => [ends[i & 1]!.x, ends[(i >> 1) & 1]!.y, ends[(i >> 2) & 1]!.z]);
}
