// Lines of a width in pixels, many in one draw call; their ends are places, or vehicles that move.

import * as THREE from "three";
import { SWARM, type Frames } from "./frames";
import type { Shared } from "./light";

const VERTEX = /* glsl */ `
${SWARM}
attribute vec3 from, to;
/** The numbers of the vehicles at both ends; below 0: the place \`from\`, \`to\`. */
attribute vec2 ends;
/** Fading lines: when each end was there, s. Pulses: the start and how long it takes, wall s. */
attribute vec2 times;
attribute vec4 colour;
uniform vec3 uViewport;
uniform float uWidth, uNow, uFade, uClock, uOpacity;
varying vec4 vColour;
varying float vSide;
void main() {
  vec3 a = ends.x < 0.0 ? from : placeOf(ends.x).xyz;
  vec3 b = ends.y < 0.0 ? to : placeOf(ends.y).xyz;
  float alpha = colour.a * uOpacity;
  float width = uWidth;
  #ifdef PULSE
  float u = (uClock - times.x) / times.y;
  vec3 d = b - a;
  float head = clamp(u * 1.25, 0.0, 1.0), tail = clamp(u * 1.25 - 0.25, 0.0, 1.0);
  if (u < 0.0 || u > 1.0) alpha = 0.0;
  b = a + d * head;
  a = a + d * tail;
  if (position.x < 0.5) alpha *= 0.05;
  #elif defined(STEM)
  // Down to the ground; what is below it has none.
  b = vec3(a.xy, 0.0);
  if (a.z <= 0.0) alpha = 0.0;
  if (position.x > 0.5) alpha *= 0.7;
  #else
  if (uFade > 0.0) {
    float age = (uNow - (position.x < 0.5 ? times.x : times.y)) / uFade;
    alpha *= age < -0.001 || age > 1.0 ? 0.0 : (1.0 - age) * (1.0 - age * 0.4);
  }
  #endif
  vec4 ca = uSee * vec4(a, 1.0);
  vec4 cb = uSee * vec4(b, 1.0);
  // What is behind the eye is cut off at a plane just in front of it.
  float least = 1e-4 * max(max(ca.w, cb.w), 1e-3);
  if (ca.w < least && cb.w < least) alpha = 0.0;
  else if (ca.w < least) ca = mix(ca, cb, (least - ca.w) / (cb.w - ca.w));
  else if (cb.w < least) cb = mix(cb, ca, (least - cb.w) / (ca.w - cb.w));
  vec2 pa = ca.xy / ca.w * uViewport.xy, pb = cb.xy / cb.w * uViewport.xy;
  vec2 way = pb - pa;
  float l = length(way);
  way = l > 1e-4 ? way / l : vec2(1.0, 0.0);
  vec2 side = vec2(-way.y, way.x) * position.y * (width + 0.7) * uViewport.z;
  vec4 at = position.x < 0.5 ? ca : cb;
  at.xy += side / uViewport.xy * at.w;
  at.z -= 2e-5 * at.w;
  gl_Position = alpha < 0.004 ? vec4(2.0, 2.0, 2.0, 1.0) : at;
  vColour = vec4(colour.rgb, alpha);
  vSide = position.y * (width + 0.7);
}
`;

const FRAGMENT = /* glsl */ `
uniform float uWidth;
varying vec4 vColour;
varying float vSide;
void main() {
  float a = clamp(uWidth + 0.7 - abs(vSide), 0.0, 1.0);
  gl_FragColor = vec4(vColour.rgb, vColour.a * a);
}
`;

export interface LineOptions {
  width_px: number;
  /** Lines fade within this time, s; 0: they do not. */
  fade_s?: number;
  /** They are pulses that run from one end to the other. */
  pulse?: boolean;
  /** They go from a vehicle down to the ground. */
  stem?: boolean;
  /** They shine: added to what is behind. */
  shine?: boolean;
  /** Drawn over everything. */
  above?: boolean;
  order?: number;
}

/** Up to `capacity` lines in a ring: new ones replace the oldest. */
export class Lines {
  readonly mesh: THREE.Mesh<THREE.InstancedBufferGeometry, THREE.ShaderMaterial>;
  private from: THREE.InstancedBufferAttribute;
  private to: THREE.InstancedBufferAttribute;
  private ends: THREE.InstancedBufferAttribute;
  private times: THREE.InstancedBufferAttribute;
  private colour: THREE.InstancedBufferAttribute;
  private all: THREE.InstancedBufferAttribute[];
  private next = 0;
  private used = 0;

  constructor(
    readonly capacity: number,
    frames: Frames,
    shared: Shared,
    options: LineOptions,
  ) {
    const g = new THREE.InstancedBufferGeometry();
    g.setAttribute("position", new THREE.Float32BufferAttribute([0, -1, 0, 1, -1, 0, 1, 1, 0, 0, 1, 0], 3));
    g.setIndex([0, 1, 2, 0, 2, 3]);
    const floats = (size: number): THREE.InstancedBufferAttribute => {
      const a = new THREE.InstancedBufferAttribute(new Float32Array(capacity * size), size);
      a.setUsage(THREE.DynamicDrawUsage);
      return a;
    };
    g.setAttribute("from", (this.from = floats(3)));
    g.setAttribute("to", (this.to = floats(3)));
    g.setAttribute("ends", (this.ends = floats(2)));
    g.setAttribute("times", (this.times = floats(2)));
    this.colour = new THREE.InstancedBufferAttribute(new Uint8Array(capacity * 4), 4, true);
    this.colour.setUsage(THREE.DynamicDrawUsage);
    g.setAttribute("colour", this.colour);
    g.instanceCount = 0;
    this.all = [this.from, this.to, this.ends, this.times, this.colour];
    const material = new THREE.ShaderMaterial({
      vertexShader: VERTEX,
      fragmentShader: FRAGMENT,
      defines: { ...(options.pulse && { PULSE: 1 }), ...(options.stem && { STEM: 1 }) },
      uniforms: {
        ...shared,
        ...frames.uniforms,
        uWidth: { value: options.width_px / 2 },
        uNow: { value: 0 },
        uFade: { value: options.fade_s ?? 0 },
        uOpacity: { value: 1 },
      },
      transparent: true,
      depthWrite: false,
      depthTest: !options.above,
      side: THREE.DoubleSide,
      blending: options.shine ? THREE.AdditiveBlending : THREE.NormalBlending,
    });
    this.mesh = new THREE.Mesh(g, material);
    this.mesh.frustumCulled = false;
    this.mesh.renderOrder = options.order ?? 10;
  }

  get count(): number {
    return this.used;
  }

  set(name: "uNow" | "uFade" | "uWidth" | "uOpacity", value: number): void {
    this.mesh.material.uniforms[name]!.value = value;
  }

  clear(): void {
    this.next = 0;
    this.used = 0;
    this.mesh.geometry.instanceCount = 0;
  }

  /** Adds one line; `flush` must follow. Returns its slot. */
  add(
    a: ArrayLike<number> | number,
    b: ArrayLike<number> | number,
    rgba: ArrayLike<number>,
    t0 = 0,
    t1 = 0,
  ): number {
    const i = this.next;
    this.next = (this.next + 1) % this.capacity;
    this.used = Math.min(this.used + 1, this.capacity);
    this.put(this.from.array, 3 * i, 2 * i, a);
    this.put(this.to.array, 3 * i, 2 * i + 1, b);
    this.times.array[2 * i] = t0;
    this.times.array[2 * i + 1] = t1;
    this.recolour(i, rgba);
    return i;
  }

  /** One end: a place, or the number of a vehicle. */
  private put(places: THREE.TypedArray, at: number, end: number, x: ArrayLike<number> | number): void {
    if (typeof x === "number") {
      this.ends.array[end] = x;
      return;
    }
    this.ends.array[end] = -1;
    places[at] = x[0]!;
    places[at + 1] = x[1]!;
    places[at + 2] = x[2]!;
  }

  recolour(i: number, rgba: ArrayLike<number>): void {
    for (let k = 0; k < 4; k++) this.colour.array[4 * i + k] = rgba[k]!;
  }

  /** Sends what was added, from slot `first` on, `n` of them round the ring; all without numbers. */
  flush(first = 0, n = this.capacity): void {
    for (const a of this.all) {
      if (n < this.capacity) {
        const end = first + n;
        a.addUpdateRange(first * a.itemSize, (Math.min(end, this.capacity) - first) * a.itemSize);
        if (end > this.capacity) a.addUpdateRange(0, (end - this.capacity) * a.itemSize);
      } else {
        a.clearUpdateRanges();
        if (this.used < this.capacity) a.addUpdateRange(0, Math.max(this.used, 1) * a.itemSize);
      }
      a.needsUpdate = true;
    }
    this.mesh.geometry.instanceCount = this.used;
  }

  dispose(): void {
    this.mesh.geometry.dispose();
    this.mesh.material.dispose();
  }
}
