// Where the camera is: an orbit around a point, with or without perspective, that glides to where it is sent and then
// stands still. Numbers only; pointer.ts moves it, scene.ts draws by it.
//
// Going flat keeps the size of things at the target: the eye moves away while the angle of view narrows, until the
// rays are parallel.

import * as THREE from "three";
import type { CameraState, ViewName } from "./index";
import { add, clamp, scale, sub } from "./math";
import type { Vec3 } from "../wire";

const TAN_HALF_VIEW = Math.tan((40 / 2) * (Math.PI / 180));
/** Below this the camera has arrived: rad, and parts of the distance. */
const ARRIVED = 2e-4;
const NEAREST_M = 0.02;
const FARTHEST_M = 200_000;

/** The share of the picture's height below a floor that is looked at from the side. */
const BELOW = 0.1;

interface Pose {
  /** What it looks at; relative to what is followed, if anything is. */
  target: Vec3;
  /** Of the eye seen from the target: counter-clockwise from east, and up, rad. */
  azimuth: number;
  elevation: number;
  /** Natural logarithm of the distance from target to eye, m. */
  zoom: number;
  /** 0: perspective, 1: parallel rays. */
  flat: number;
}

/** Seen from that side, north up in the view from the top. */
const SIDES: Record<Exclude<ViewName, "orbit">, [azimuth: number, elevation: number]> = {
  top: [-Math.PI / 2, Math.PI / 2],
  north: [Math.PI / 2, 0],
  east: [0, 0],
  south: [-Math.PI / 2, 0],
  west: [Math.PI, 0],
};

export class Orbit {
  readonly camera = new THREE.Camera();
  private now: Pose = { target: [0, 0, 0], azimuth: -1.05, elevation: 0.36, zoom: Math.log(30), flat: 0 };
  private goal: Pose = structuredClone(this.now);
  private lastOrbit: [number, number] = [this.now.azimuth, this.now.elevation];
  private anchor: (() => Vec3 | null) | null = null;
  private lastAnchor: Vec3 = [0, 0, 0];
  private seconds = 0.07;
  private aspect = 1;
  private height = 1;
  /** The left of the picture that a panel covers, CSS pixels: the target is in the middle of the rest. */
  covered_px = 0;
  /** How far around the target there is anything to see, m. */
  reach = 100;
  /** How much farther away the eye is than it would be with perspective, m. */
  retreat = 0;

  resize(width: number, height: number): void {
    this.aspect = width / Math.max(height, 1);
    this.height = Math.max(height, 1);
  }

  /** Where the target is in the picture: -1 to 1 to the right. */
  middle(): number {
    return clamp(this.covered_px / (this.height * this.aspect), 0, 0.5);
  }

  /** The point looked at, world. */
  target(): Vec3 {
    return add(this.now.target, this.base());
  }

  distance(): number {
    return Math.exp(this.now.zoom);
  }

  /** The size of a CSS pixel at the target, m. */
  pixel(): number {
    return (2 * this.distance() * TAN_HALF_VIEW) / this.height;
  }

  isFlat(): boolean {
    return this.goal.flat === 1;
  }

  /** The axis that it looks along without perspective, 0 east, 1 north, 2 up; null: none. */
  along(): number | null {
    if (this.now.flat !== 1) return null;
    const axis = this.axes()[0].findIndex((x) => Math.abs(x) > 0.999);
    return axis < 0 ? null : axis;
  }

  following(): boolean {
    return this.anchor !== null;
  }

  /** From the target to the eye, to the right, and up, unit vectors. */
  axes(pose: Pose = this.now): [back: Vec3, right: Vec3, up: Vec3] {
    const [sa, ca] = [Math.sin(pose.azimuth), Math.cos(pose.azimuth)];
    const [se, ce] = [Math.sin(pose.elevation), Math.cos(pose.elevation)];
    return [
      [ce * ca, ce * sa, se],
      [-sa, ca, 0],
      [-se * ca, -se * sa, ce],
    ];
  }

  /** Glides on for `dt` wall seconds; whether it still moves. */
  step(dt: number): boolean {
    const f = 1 - Math.exp(-clamp(dt, 0, 0.4) / this.seconds);
    const { now, goal } = this;
    const away = sub(goal.target, now.target);
    const off =
      Math.max(
        Math.hypot(...away) / this.distance(),
        Math.abs(goal.azimuth - now.azimuth),
        Math.abs(goal.elevation - now.elevation),
        Math.abs(goal.zoom - now.zoom),
        Math.abs(goal.flat - now.flat) * 0.1,
      );
    if (off < ARRIVED) {
      this.now = structuredClone(goal);
      this.seconds = 0.07;
      return false;
    }
    now.target = add(now.target, scale(away, f));
    now.azimuth += (goal.azimuth - now.azimuth) * f;
    now.elevation += (goal.elevation - now.elevation) * f;
    now.zoom += (goal.zoom - now.zoom) * f;
    now.flat += (goal.flat - now.flat) * f;
    return true;
  }

  /** Sets the matrices of `camera`. */
  apply(): void {
    const [back, right, up] = this.axes();
    const distance = this.distance();
    const target = this.target();
    const half = distance * TAN_HALF_VIEW;
    const depth = Math.max(this.reach, distance * 4) + Math.hypot(...target);
    const p = this.camera.projectionMatrix;
    const middle = this.middle();
    const flat = this.now.flat > 0.985;
    const eyeAway = flat ? depth : distance / (1 - this.now.flat);
    this.retreat = flat ? 0 : eyeAway - distance;
    const eye = add(target, scale(back, eyeAway));
    if (flat) {
      const w = half * this.aspect;
      p.makeOrthographic(-w * (1 + middle), w * (1 - middle), half, -half, 0, 2 * depth);
    } else {
      const near = distance * 0.01 + (eyeAway - distance) * 0.2;
      const tan = (half / eyeAway) * near;
      const w = tan * this.aspect;
      p.makePerspective(-w * (1 + middle), w * (1 - middle), tan, -tan, near, eyeAway + 2 * depth);
    }
    this.camera.projectionMatrixInverse.copy(p).invert();
    this.camera.matrixAutoUpdate = false;
    this.camera.matrix.makeBasis(new THREE.Vector3(...right), new THREE.Vector3(...up), new THREE.Vector3(...back));
    this.camera.matrix.setPosition(...eye);
    this.camera.position.set(...eye);
    this.camera.updateMatrixWorld(true);
    this.camera.matrixWorldInverse.copy(this.camera.matrixWorld).invert();
  }

  /** Perspective and parallel rays: what makes a view ray of a pixel; for the sky. */
  lens(): { tan: number; aspect: number; flat: boolean } {
    return { tan: TAN_HALF_VIEW * (1 - this.now.flat), aspect: this.aspect, flat: this.now.flat > 0.985 };
  }

  /** The line of sight through a point of the picture, -1 to 1 to the right and up. */
  ray(x: number, y: number): { from: Vec3; along: Vec3 } {
    const m = new THREE.Matrix4().multiplyMatrices(this.camera.matrixWorld, this.camera.projectionMatrixInverse);
    const a = new THREE.Vector3(x, y, -1).applyMatrix4(m);
    const b = new THREE.Vector3(x, y, 0.5).applyMatrix4(m).sub(a).normalize();
    return { from: [a.x, a.y, a.z], along: [b.x, b.y, b.z] };
  }

  // What people do.

  /** By pixels; leaves a flat view. */
  orbit(dx: number, dy: number): void {
    this.hurry();
    this.goal.flat = 0;
    this.goal.azimuth -= dx * 0.006;
    this.goal.elevation = clamp(this.goal.elevation + dy * 0.006, -1.5, Math.PI / 2);
    this.lastOrbit = [this.goal.azimuth, this.goal.elevation];
  }

  /** By pixels. */
  pan(dx: number, dy: number): void {
    this.hurry();
    const size = (2 * Math.exp(this.goal.zoom) * TAN_HALF_VIEW) / this.height;
    const [, right, up] = this.axes(this.goal);
    this.goal.target = add(this.goal.target, add(scale(right, -dx * size), scale(up, dy * size)));
  }

  /** Nearer (below 1) or farther (above 1), keeping what is under the pointer (-1 to 1) there. */
  zoomBy(factor: number, x: number, y: number): void {
    this.hurry();
    const before = Math.exp(this.goal.zoom);
    const after = clamp(before * factor, NEAREST_M, FARTHEST_M);
    this.goal.zoom = Math.log(after);
    if (this.anchor) return;
    const [, right, up] = this.axes(this.goal);
    const half = (before - after) * TAN_HALF_VIEW;
    this.goal.target = add(this.goal.target, add(scale(right, (x - this.middle()) * half * this.aspect), scale(up, y * half)));
  }

  lookAt(point: Vec3): void {
    this.seconds = 0.12;
    this.goal.target = sub(point, this.base());
  }

  setView(name: ViewName): void {
    this.seconds = 0.11;
    const [azimuth, elevation] = name === "orbit" ? this.lastOrbit : SIDES[name];
    const turns = Math.round((this.now.azimuth - azimuth) / (2 * Math.PI));
    this.goal.azimuth = azimuth + turns * 2 * Math.PI;
    this.goal.elevation = elevation;
    this.goal.flat = name === "orbit" ? 0 : 1;
  }

  /** Seen from so far above the target, rad, at once. */
  raise(elevation: number): void {
    this.goal.elevation = elevation;
    this.lastOrbit = [this.goal.azimuth, elevation];
  }

  /** All points within sight, from the direction that it looks from now. `margin`: m around each. */
  fit(points: Iterable<Vec3>, margin: number, at_once: boolean): void {
    const axes = this.axes(this.goal);
    const low: Vec3 = [Infinity, Infinity, Infinity];
    const high: Vec3 = [-Infinity, -Infinity, -Infinity];
    const seen: Vec3[] = [];
    for (const p of points) {
      const q = axes.map((a) => a[0] * p[0] + a[1] * p[1] + a[2] * p[2]) as Vec3;
      if (!q.every(Number.isFinite)) continue;
      seen.push(q);
      for (let i = 0; i < 3; i++) {
        low[i] = Math.min(low[i]!, q[i]!);
        high[i] = Math.max(high[i]!, q[i]!);
      }
    }
    if (seen.length === 0) return;
    const mid = [0, 1, 2].map((i) => (low[i]! + high[i]!) / 2) as Vec3;
    let distance = 0;
    const tanX = TAN_HALF_VIEW * Math.min(this.aspect * (1 - this.middle()), 3);
    for (const q of seen) {
      const toward = this.goal.flat === 1 ? 0 : q[0] - mid[0];
      const x = toward + (Math.abs(q[1] - mid[1]) + margin) / tanX;
      const y = toward + (Math.abs(q[2] - mid[2]) + margin) / TAN_HALF_VIEW;
      distance = Math.max(distance, x, y);
    }
    const target = axes.reduce<Vec3>((sum, a, i) => add(sum, scale(a, mid[i]!)), [0, 0, 0]);
    this.seconds = 0.12;
    // What is followed stays in the middle.
    this.goal.target = this.anchor ? [0, 0, 0] : sub(target, this.base());
    this.goal.zoom = Math.log(clamp(distance * 1.12, NEAREST_M * 5, FARTHEST_M));
    if (at_once) this.now = structuredClone(this.goal);
  }

  /** Whether it goes to a view from the side. */
  aside(): boolean {
    return this.goal.flat === 1 && Math.abs(this.goal.elevation) < 1e-3;
  }

  /** From the side, what is below a floor takes a narrow strip of the picture: there is nothing to see in it. */
  standOn(floor_m: number, at_once: boolean): void {
    if (!this.aside() || this.anchor) return;
    const half = Math.exp(this.goal.zoom) * TAN_HALF_VIEW;
    const [x, y, z] = this.goal.target;
    // A floor that is out of sight stays so.
    if (z - half < floor_m) this.goal.target = [x, y, Math.max(z, floor_m + half * (1 - 2 * BELOW))];
    if (at_once) this.now = structuredClone(this.goal);
  }

  /** Goes with something that moves; null: stays. */
  follow(where: (() => Vec3 | null) | null): void {
    const target = this.target();
    const goal = add(this.goal.target, this.base());
    this.anchor = where;
    const base = this.base();
    this.now.target = sub(target, base);
    this.goal.target = where ? [0, 0, 0] : goal;
    this.seconds = 0.12;
  }

  set(state: CameraState): void {
    const away = sub(state.from, state.at);
    const distance = clamp(Math.hypot(...away), NEAREST_M, FARTHEST_M);
    if (![...state.from, ...state.at].every(Number.isFinite)) return;
    const elevation = Math.asin(clamp(away[2] / distance, -1, 1));
    const azimuth = Math.hypot(away[0], away[1]) < 1e-6 * distance ? -Math.PI / 2 : Math.atan2(away[1], away[0]);
    const flat = state.flat ? 1 : 0;
    this.goal = { target: sub(state.at, this.base()), azimuth, elevation, zoom: Math.log(distance), flat };
    if (!flat) this.lastOrbit = [azimuth, elevation];
    this.now = structuredClone(this.goal);
  }

  state(): CameraState {
    const at = this.target();
    const from = add(at, scale(this.axes()[0], this.distance()));
    const neat = (v: Vec3): Vec3 => v.map((x) => Math.round(x * 1e4) / 1e4) as Vec3;
    return { from: neat(from), at: neat(at), flat: this.isFlat() };
  }

  private base(): Vec3 {
    if (!this.anchor) return [0, 0, 0];
    const at = this.anchor();
    if (at) this.lastAnchor = at;
    return this.lastAnchor;
  }

  private hurry(): void {
    this.seconds = 0.045;
  }
}
