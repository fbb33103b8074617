// The swarm between two instants: two frames as textures that all vertex shaders read, and the same in numbers.
//
// Each vehicle is a texel, so beams, trails and links need only its number. Of two frames that follow one another only
// the new one is sent to the graphics card.

import * as THREE from "three";
import type { Frame, Quat, Vec3 } from "../wire";
import { slerp } from "./math";

const ROW = 128;

interface Slot {
  frame: Frame | null;
  places: THREE.DataTexture;
  turns: THREE.DataTexture;
}

export interface SwarmUniforms {
  [name: string]: THREE.IUniform;
}

export class Frames {
  readonly uniforms: SwarmUniforms;
  readonly colours: THREE.DataTexture;
  a: Frame | null = null;
  b: Frame | null = null;
  f = 0;
  private slots: [Slot, Slot];

  constructor(
    readonly count: number,
    radii: ArrayLike<number>,
  ) {
    const rows = Math.max(1, Math.ceil(count / ROW));
    const slot = (): Slot => {
      const data = new Float32Array(ROW * rows * 4);
      for (let i = 0; i < count; i++) data[i * 4 + 3] = radii[i] ?? 0.1;
      const places = new THREE.DataTexture(data, ROW, rows, THREE.RGBAFormat, THREE.FloatType);
      const turns = new THREE.DataTexture(new Int16Array(ROW * rows * 4), ROW, rows, THREE.RGBAIntegerFormat, THREE.ShortType);
      turns.internalFormat = "RGBA16I";
      for (const t of [places, turns]) {
        t.needsUpdate = true;
        t.unpackAlignment = 8;
      }
      return { frame: null, places, turns };
    };
    this.slots = [slot(), slot()];
    this.colours = new THREE.DataTexture(new Uint8Array(ROW * rows * 4).fill(255), ROW, rows);
    this.colours.needsUpdate = true;
    const [one, two] = this.slots;
    this.uniforms = {
      uPlacesA: { value: one.places },
      uPlacesB: { value: two.places },
      uTurnsA: { value: one.turns },
      uTurnsB: { value: two.turns },
      uColours: { value: this.colours },
      uF: { value: 0 },
    };
  }

  /** The swarm at `f` (0 to 1) between two frames. Frames of another number of vehicles are cut or padded. */
  show(a: Frame, b: Frame, f: number): void {
    let [one, two] = this.slots;
    if (one.frame !== a && two.frame === a && a !== b) [one, two] = this.slots = [two, one];
    if (one.frame !== a) this.fill(one, a);
    if (two.frame !== b) this.fill(two, b);
    this.uniforms["uPlacesA"]!.value = one.places;
    this.uniforms["uPlacesB"]!.value = two.places;
    this.uniforms["uTurnsA"]!.value = one.turns;
    this.uniforms["uTurnsB"]!.value = two.turns;
    this.uniforms["uF"]!.value = f;
    this.a = a;
    this.b = b;
    this.f = f;
  }

  /** Virtual time shown, s. */
  time(): number {
    return this.a && this.b ? this.a.time + (this.b.time - this.a.time) * this.f : 0;
  }

  /** Where a vehicle is, world; null before the first frame, or if its place is not finite. */
  place(i: number): Vec3 | null {
    const p: Vec3 = [0, 0, 0];
    return this.read(i, p) ? p : null;
  }

  /** The same, written to `to`; whether there is one. Makes no garbage. */
  read(i: number, to: Vec3 | Float64Array): boolean {
    const { a, b, f } = this;
    if (!a || !b || i < 0 || i >= a.n || i >= b.n) return false;
    const [p, q] = [a.positions, b.positions];
    to[0] = p[3 * i]! + (q[3 * i]! - p[3 * i]!) * f;
    to[1] = p[3 * i + 1]! + (q[3 * i + 1]! - p[3 * i + 1]!) * f;
    to[2] = p[3 * i + 2]! + (q[3 * i + 2]! - p[3 * i + 2]!) * f;
    return Number.isFinite(to[0]! + to[1]! + to[2]!);
  }

  /** From body to world. */
  turn(i: number): Quat {
    const { a, b, f } = this;
    if (!a || !b || i >= a.n || i >= b.n) return [1, 0, 0, 0];
    const of = (frame: Frame): Quat => [0, 1, 2, 3].map((k) => frame.attitudes[4 * i + k]! / 32767) as Quat;
    return slerp(of(a), of(b), f);
  }

  dispose(): void {
    for (const s of this.slots) {
      s.places.dispose();
      s.turns.dispose();
    }
    this.colours.dispose();
  }

  private fill(slot: Slot, frame: Frame): void {
    const n = Math.min(frame.n, this.count);
    const to = slot.places.image.data as unknown as Float32Array;
    const p = frame.positions;
    for (let i = 0; i < n; i++) {
      to[4 * i] = p[3 * i]!;
      to[4 * i + 1] = p[3 * i + 1]!;
      to[4 * i + 2] = p[3 * i + 2]!;
    }
    (slot.turns.image.data as unknown as Int16Array).set(frame.attitudes.subarray(0, 4 * n));
    slot.places.needsUpdate = true;
    slot.turns.needsUpdate = true;
    slot.frame = frame;
  }
}

/** What vertex shaders that read vehicles begin with. */
export const SWARM = /* glsl */ `
precision highp int;
precision highp sampler2D;
precision highp isampler2D;
uniform sampler2D uPlacesA, uPlacesB, uColours;
uniform isampler2D uTurnsA, uTurnsB;
uniform float uF, uFlat;
uniform mat4 uSee;
ivec2 cell(float i) { int n = int(i + 0.5); return ivec2(n % ${ROW}, n / ${ROW}); }
/** Place, and the radius. */
vec4 placeOf(float i) {
  ivec2 c = cell(i);
  return mix(texelFetch(uPlacesA, c, 0), texelFetch(uPlacesB, c, 0), uF);
}
vec4 turnOf(float i) {
  ivec2 c = cell(i);
  vec4 a = vec4(texelFetch(uTurnsA, c, 0)), b = vec4(texelFetch(uTurnsB, c, 0));
  float la = length(a), lb = length(b);
  if (la == 0.0 || lb == 0.0) return vec4(1.0, 0.0, 0.0, 0.0);
  a /= la;
  b /= lb;
  float d = dot(a, b);
  if (d < 0.0) { b = -b; d = -d; }
  // At an even rate the short way round; where both are all but the same, straight.
  if (d > 0.9995) return normalize(mix(a, b, uF));
  float angle = acos(d);
  return (a * sin((1.0 - uF) * angle) + b * sin(uF * angle)) / sin(angle);
}
vec3 turned(vec4 q, vec3 v) {
  vec3 t = 2.0 * cross(q.yzw, v);
  return v + q.x * t + cross(q.yzw, t);
}
vec4 colourOf(float i) { return texelFetch(uColours, cell(i), 0); }
`;
