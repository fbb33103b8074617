// What is under the pointer: the vehicle nearest to it on the screen, or the first thing of the world along the line
// of sight.

import * as THREE from "three";
import type { Vec3 } from "../wire";
import { clamp, project, rayMeetsBall, rayTriangle } from "./math";
import type { Target, World } from "./world";

/** How far from the pointer a vehicle may be, CSS pixels. */
export const REACH_PX = 12;
/** And a line. */
const LINE_REACH_PX = 5;

/**
 * The vehicle drawn nearest to a point of the picture, or nearest to the eye of those whose drawn radius covers it.
 * `radius_px` says how large each is drawn.
 */
export function nearest(
  count: number,
  place: (i: number) => ArrayLike<number> | null,
  view: ArrayLike<number>,
  width: number,
  height: number,
  x: number,
  y: number,
  radius_px: (i: number, w: number) => number,
): number | null {
  let best: number | null = null;
  let score = Infinity;
  for (let i = 0; i < count; i++) {
    const p = place(i);
    if (!p) continue;
    const at = project(view, p, width, height);
    if (!at) continue;
    const d = Math.hypot(at.x - x, at.y - y);
    if (d > REACH_PX + 60) continue;
    const w = view[3]! * p[0]! + view[7]! * p[1]! + view[11]! * p[2]! + view[15]!;
    const over = Math.max(0, d - Math.max(0, radius_px(i, w)));
    if (over > REACH_PX) continue;
    // The pointer's distance first; of those under it, the one in front.
    const s = over + 1e-3 * d + 1e-3 * at.depth;
    if (s < score) {
      score = s;
      best = i;
    }
  }
  return best;
}

/** Which line (between places of the world) is drawn nearest to a point of the picture, if any is near; both ends in sight. */
export function nearestLine(lines: Iterable<readonly [Vec3, Vec3] | null>, view: ArrayLike<number>, width: number, height: number, x: number, y: number): number | null {
  let best: number | null = null;
  let least = LINE_REACH_PX;
  let i = -1;
  for (const line of lines) {
    i++;
    const a = line && project(view, line[0], width, height);
    const b = line && project(view, line[1], width, height);
    if (!a || !b) continue;
    const [dx, dy] = [b.x - a.x, b.y - a.y];
    const f = clamp(((x - a.x) * dx + (y - a.y) * dy) / Math.max(dx * dx + dy * dy, 1e-9), 0, 1);
    const d = Math.hypot(a.x + f * dx - x, a.y + f * dy - y);
    if (d < least) {
      least = d;
      best = i;
    }
  }
  return best;
}

/** The first piece of the world that a ray (unit direction) meets, and how far away, m; without those that begin above the ceiling. */
export function firstHit(world: World, from: Vec3, along: Vec3, ceiling_m = world.ceiling_m): { target: Target; away_m: number } | null {
  let best: Target | null = null;
  let away = Infinity;
  for (const target of world.targets) {
    const [x, y, z, r] = target.ball;
    if (target.foot_m >= ceiling_m) continue;
    if (!rayMeetsBall(from, along, x, y, z, r, away)) continue;
    const t = hit(target, from, along);
    if (t < away) {
      away = t;
      best = target;
    }
  }
  return best ? { target: best, away_m: away } : null;
}

function hit(target: Target, from: Vec3, along: Vec3): number {
  const inverse = target.matrix.clone().invert();
  const a = new THREE.Vector3(...from).applyMatrix4(inverse);
  // Not made a unit vector again: a length along it stays a length in the world.
  const b = new THREE.Vector3(...along).applyMatrix3(new THREE.Matrix3().setFromMatrix4(inverse));
  const p = target.triangles();
  const [o, d]: [Vec3, Vec3] = [[a.x, a.y, a.z], [b.x, b.y, b.z]];
  const v = (i: number): Vec3 => [p[i]!, p[i + 1]!, p[i + 2]!];
  let best = Infinity;
  for (let i = 0; i + 8 < p.length; i += 9) best = Math.min(best, rayTriangle(o, d, v(i), v(i + 3), v(i + 6)));
  return best;
}
