// Small geometry on plain numbers: quaternions w, x, y, z, rays, projections. No three.js, so that it can be tested alone.

import type { Quat, Vec3 } from "../wire";

export function clamp(x: number, low: number, high: number): number {
  return x < low ? low : x > high ? high : x;
}

export function lerp(a: number, b: number, f: number): number {
  return a + (b - a) * f;
}

export function add(a: Vec3, b: Vec3): Vec3 {
  return [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
}

export function sub(a: Vec3, b: Vec3): Vec3 {
  return [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
}

export function scale(a: Vec3, s: number): Vec3 {
  return [a[0] * s, a[1] * s, a[2] * s];
}

export function dot(a: Vec3, b: Vec3): number {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

export function cross(a: Vec3, b: Vec3): Vec3 {
  return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
}

export function length(a: Vec3): number {
  return Math.hypot(a[0], a[1], a[2]);
}

/** The unit vector along `a`; `or` if it has no length. */
export function unit(a: Vec3, or: Vec3 = [1, 0, 0]): Vec3 {
  const l = length(a);
  return l > 0 && Number.isFinite(l) ? scale(a, 1 / l) : or;
}

/** The vector turned by the quaternion: body to world. */
export function rotate(q: Quat, v: Vec3): Vec3 {
  const [w, x, y, z] = q;
  const tx = 2 * (y * v[2] - z * v[1]);
  const ty = 2 * (z * v[0] - x * v[2]);
  const tz = 2 * (x * v[1] - y * v[0]);
  return [
    v[0] + w * tx + y * tz - z * ty,
    v[1] + w * ty + z * tx - x * tz,
    v[2] + w * tz + x * ty - y * tx,
  ];
}

export function multiply(a: Quat, b: Quat): Quat {
  return [
    a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3],
    a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
    a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1],
    a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0],
  ];
}

export function conjugate(q: Quat): Quat {
  return [q[0], -q[1], -q[2], -q[3]];
}

/** Between two attitudes at an even rate the short way round; what the shader does too. */
export function slerp(a: Quat, b: Quat, f: number): Quat {
  const [la, lb] = [Math.hypot(...a), Math.hypot(...b)];
  if (la === 0 || lb === 0) return [1, 0, 0, 0];
  const d = (a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3]) / (la * lb);
  const angle = Math.acos(Math.min(1, Math.abs(d)));
  const close = Math.abs(d) > 0.9995;
  const x = (close ? 1 - f : Math.sin((1 - f) * angle)) / la;
  const y = ((close ? f : Math.sin(f * angle)) * (d < 0 ? -1 : 1)) / lb;
  const q: Quat = [0, 0, 0, 0];
  for (let i = 0; i < 4; i++) q[i] = a[i]! * x + b[i]! * y;
  const l = Math.hypot(...q);
  return [q[0] / l, q[1] / l, q[2] / l, q[3] / l];
}

/** The shortest turn that brings the x axis onto a direction. */
export function fromX(direction: Vec3): Quat {
  const d = unit(direction);
  if (d[0] < -0.999999) return [0, 0, 0, 1];
  const q: Quat = [1 + d[0], 0, -d[2], d[1]];
  const l = Math.hypot(...q);
  return [q[0] / l, q[1] / l, q[2] / l, q[3] / l];
}

/** How far along the ray a triangle is hit, from either side; `Infinity` if it is not. */
export function rayTriangle(from: Vec3, along: Vec3, a: Vec3, b: Vec3, c: Vec3): number {
  const e1 = sub(b, a);
  const e2 = sub(c, a);
  const p = cross(along, e2);
  const det = dot(e1, p);
  if (det === 0) return Infinity;
  const s = sub(from, a);
  const u = dot(s, p) / det;
  if (u < 0 || u > 1) return Infinity;
  const q = cross(s, e1);
  const v = dot(along, q) / det;
  if (v < 0 || u + v > 1) return Infinity;
  const t = dot(e2, q) / det;
  return t > 0 ? t : Infinity;
}

/** Whether a ray (unit direction) passes a ball before `limit`. */
export function rayMeetsBall(from: Vec3, along: Vec3, x: number, y: number, z: number, radius: number, limit: number): boolean {
  const dx = x - from[0];
  const dy = y - from[1];
  const dz = z - from[2];
  const t = dx * along[0] + dy * along[1] + dz * along[2];
  if (t < -radius || t - radius > limit) return false;
  return dx * dx + dy * dy + dz * dz - t * t <= radius * radius;
}

/**
 * A point through a column-major view-projection matrix to CSS pixels from the upper left.
 * `depth` is the distance along the line of sight for a camera with perspective (clip w); null if behind it.
 */
export function project(
  m: ArrayLike<number>,
  p: ArrayLike<number>,
  width: number,
  height: number,
): { x: number; y: number; depth: number } | null {
  const [x, y, z] = [p[0]!, p[1]!, p[2]!];
  const w = m[3]! * x + m[7]! * y + m[11]! * z + m[15]!;
  if (w <= 1e-9) return null;
  const nz = (m[2]! * x + m[6]! * y + m[10]! * z + m[14]!) / w;
  if (nz < -1 || nz > 1) return null;
  const nx = (m[0]! * x + m[4]! * y + m[8]! * z + m[12]!) / w;
  const ny = (m[1]! * x + m[5]! * y + m[9]! * z + m[13]!) / w;
  return { x: (nx * 0.5 + 0.5) * width, y: (0.5 - ny * 0.5) * height, depth: nz };
}

/** 1, 2 or 5 times a power of ten: the largest not above `x` (> 0). */
export function niceBelow(x: number): number {
  const power = 10 ** Math.floor(Math.log10(x));
  const digits = x / power;
  return (digits >= 5 ? 5 : digits >= 2 ? 2 : 1) * power;
}
