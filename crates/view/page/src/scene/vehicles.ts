// The bodies of the swarm. Small flyers are darts from afar (darts.ts) and flyers near by (near.ts), with a shadow on
// the ground; whatever else moves has the look that the run gives it, one draw call for each.

import * as THREE from "three";
import type { Hello } from "../wire";
import { blobs } from "./blobs";
import { bodies } from "./bodies";
import { Darts } from "./darts";
import { bodyOf, flyer } from "./forms";
import type { Frames } from "./frames";
import type { Shared } from "./light";
import { findNear, MOST_NEAR, NEAR_PX } from "./near";

/** Vehicles of a smaller radius are drawn as flyers, m. */
const FLYER_RADIUS_M = 1;
/** Above so many flyers there are no shadows: the picture has no room for them. */
const MOST_BLOBS = 20_000;
/** The least radius of other looks on the screen, CSS pixels. */
const LEAST_LOOK_PX = 3.5;

export class Vehicles {
  readonly group = new THREE.Group();
  /** The least radius of a flyer on the screen in the middle of the picture, CSS pixels. */
  readonly least: number;
  private glow = { value: 0.2 };
  private shade = { value: 0.3 };
  private darts: Darts | null = null;
  private flyers: Int32Array;
  private radii: Float64Array;
  private near: { mesh: ReturnType<typeof bodies>; who: THREE.InstancedBufferAttribute } | null = null;

  constructor(
    hello: Hello,
    private frames: Frames,
    shared: Shared,
  ) {
    const { roles, looks, radii_m } = hello.vehicles;
    this.radii = Float64Array.from(radii_m);
    this.least = leastOf(roles.length);
    const flyers: number[] = [];
    const batches = new Map<string, number[]>();
    for (let i = 0; i < roles.length; i++) {
      const look = looks[i] ?? -1;
      const ghost = roles[i] === "ghost";
      const small = (radii_m[i] ?? 0) < FLYER_RADIUS_M;
      const shapeless = !hello.looks[look]?.pieces.length;
      if (shapeless || (small && (ghost || roles[i] === "vehicle"))) flyers.push(i);
      if (shapeless || (small && roles[i] === "vehicle")) continue;
      const key = `${look}|${ghost ? "ghost" : ""}`;
      const list = batches.get(key);
      if (list) list.push(i);
      else batches.set(key, [i]);
    }
    for (const [key, who] of batches) {
      const [look, role] = key.split("|") as [string, string];
      const body = bodyOf(hello.looks[Number(look)]?.pieces ?? [], hello.forms, who.length < 200 ? 2 : who.length < 2000 ? 1 : 0);
      if (!body) continue;
      body.computeBoundingSphere();
      const radius_m = Math.max(body.boundingSphere?.radius ?? 1, 1e-3);
      this.group.add(bodies(body, who, frames, shared, this.glow, { least_px: role ? 0 : LEAST_LOOK_PX, radius_m, ghost: role !== "" }));
    }
    this.flyers = Int32Array.from(flyers.filter((i) => roles[i] !== "ghost"));
    if (flyers.length === 0) return;
    this.darts = new Darts(flyers, (i) => roles[i] === "ghost", this.least, frames, shared);
    this.group.add(this.darts.mesh);
    const mesh = bodies(flyer(), new Float32Array(Math.min(MOST_NEAR, flyers.length)), frames, shared, this.glow, { least_px: 0, radius_m: 0, ghost: false });
    mesh.geometry.instanceCount = 0;
    const who = mesh.geometry.getAttribute("vehicle") as THREE.InstancedBufferAttribute;
    who.setUsage(THREE.DynamicDrawUsage);
    this.near = { mesh, who };
    this.group.add(mesh);
    if (hello.stage.plane && flyers.length <= MOST_BLOBS) this.group.add(blobs(flyers, this.least * 0.8, this.shade, frames, shared));
    this.shade.value = flyers.length > 2000 ? 0.16 : 0.34;
  }

  setDark(dark: boolean): void {
    this.glow.value = dark ? 0.5 : 0.16;
  }

  /**
   * Before each picture. `view`: view-projection, column-major; a metre at clip depth 1 is `scale` CSS pixels.
   */
  update(view: ArrayLike<number>, scale: number, targetDepth: number): void {
    const { near, darts } = this;
    const { a, b, f } = this.frames;
    if (!near || !darts || !a || !b) return;
    const list = near.who.array as Float32Array;
    let least_px = NEAR_PX;
    const swarm = this.frames as { a: NonNullable<typeof a>; b: NonNullable<typeof b>; f: typeof f };
    let count = findNear(swarm, this.flyers, this.radii, view, scale, least_px, list);
    while (count > list.length) {
      least_px *= 1.25;
      count = findNear(swarm, this.flyers, this.radii, view, scale, least_px, list);
    }
    near.mesh.geometry.instanceCount = count;
    near.mesh.visible = count > 0;
    if (count > 0) {
      near.who.clearUpdateRanges();
      near.who.addUpdateRange(0, count);
      near.who.needsUpdate = true;
    }
    darts.update(least_px, targetDepth);
  }

  /** The radius on the screen at clip depth `w`, CSS pixels: as it is drawn. */
  radius_px(i: number, w: number, scale: number, targetDepth: number, flat: boolean): number {
    const own = ((this.radii[i] ?? 0.1) * scale) / Math.max(w, 1e-9);
    return Math.max(own, Darts.least(this.least, w, targetDepth, flat));
  }

  dispose(): void {
    this.group.traverse((o) => {
      if (o instanceof THREE.Mesh) {
        o.geometry.dispose();
        (o.material as THREE.Material).dispose();
      }
    });
  }
}

/** The more there are, the smaller each: they must not cover one another. */
function leastOf(count: number): number {
  return count > 30_000 ? 2 : count > 2000 ? 3.2 : count > 300 ? 5 : 7;
}
