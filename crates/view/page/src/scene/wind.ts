// The moving air: an arrow at each place it is known, its length by the speed. Seen from above or from a side there
// are arrows of one layer only: those of all would lie over each other.

import * as THREE from "three";
import { number } from "../core/format";
import { add, fromX, length, scale } from "./math";
import { LIGHT, type Shared } from "./light";
import type { Vec3 } from "../wire";

const MOST = 4000;
/** An arrow of this speed or less is never as long as arrows may be: a breath is no gale, m/s. */
const BREEZE_M_S = 1;

/** Arrows are in one layer if they are no farther from it than this part of what they are apart. */
const SAME = 0.1;

/** An arrow as it is drawn. */
export interface Arrow {
  from: Vec3;
  to: Vec3;
  speed_m_s: number;
}

/** An arrow along x from 0 to 1. */
function arrow(): THREE.BufferGeometry {
  const shaft = new THREE.CylinderGeometry(0.017, 0.017, 0.76, 6).rotateZ(-Math.PI / 2).translate(0.38, 0, 0).toNonIndexed();
  const tip = new THREE.ConeGeometry(0.065, 0.24, 10).rotateZ(-Math.PI / 2).translate(0.88, 0, 0).toNonIndexed();
  const g = new THREE.BufferGeometry();
  for (const name of ["position", "normal"]) {
    const [a, b] = [shaft.getAttribute(name), tip.getAttribute(name)];
    g.setAttribute(name, new THREE.Float32BufferAttribute([...a.array, ...b.array], 3));
  }
  return g;
}

export class Wind {
  readonly mesh: THREE.InstancedMesh<THREE.BufferGeometry, THREE.ShaderMaterial>;
  /** What is drawn. */
  drawn: Arrow[] = [];
  private list: number[][] = [];
  private axis: number | null = null;
  private layer: number | null = null;

  constructor(shared: Shared) {
    const material = new THREE.ShaderMaterial({
      uniforms: { ...shared, uColour: { value: new THREE.Vector3(0.05, 0.35, 0.75) } },
      vertexShader: /* glsl */ `
        varying vec3 vNormal2;
        void main() {
          vNormal2 = mat3(instanceMatrix) * normal;
          gl_Position = projectionMatrix * viewMatrix * instanceMatrix * vec4(position, 1.0);
        }`,
      fragmentShader: /* glsl */ `
        ${LIGHT}
        uniform vec3 uColour;
        varying vec3 vNormal2;
        void main() {
          vec3 n = normalize(vNormal2);
          gl_FragColor = vec4(toSrgb(uColour * (0.75 + 0.4 * n.z)), 0.58);
        }`,
      transparent: true,
    });
    this.mesh = new THREE.InstancedMesh(arrow(), material, MOST);
    this.mesh.count = 0;
    this.mesh.frustumCulled = false;
    this.mesh.renderOrder = 18;
  }

  setDark(dark: boolean): void {
    this.mesh.material.uniforms["uColour"]!.value.set(...(dark ? [0.25, 0.62, 0.95] : [0.04, 0.26, 0.62]));
  }

  /** Places and velocities of the air. An arrow of the greatest speed of all is two thirds as long as those that are drawn are apart. */
  set(arrows: number[][]): void {
    this.list = arrows.filter(whole).slice(0, MOST);
    this.layer = layerOf(this.list, this.axis, this.layer ?? 0);
    this.fill();
  }

  /** Seen along this axis (0 east, 1 north, 2 up) without perspective: the layer nearest to what is looked at; null: all. */
  look(axis: number | null, target: Vec3): void {
    const layer = layerOf(this.list, axis, axis === null ? 0 : target[axis]!);
    if (axis === this.axis && layer === this.layer) return;
    [this.axis, this.layer] = [axis, layer];
    this.fill();
  }

  private fill(): void {
    const fastest = Math.max(fastestOf(this.list), BREEZE_M_S);
    const { axis, layer } = this;
    const near = spacing(this.list) * SAME;
    const list = axis === null || layer === null ? this.list : this.list.filter((a) => Math.abs(a[axis]! - layer) <= near);
    const apart = spacing(list);
    this.drawn = [];
    for (const a of list) {
      const v: Vec3 = [a[3]!, a[4]!, a[5]!];
      const speed = length(v);
      if (!(speed > fastest * 0.01)) continue;
      const l = apart * 0.62 * Math.sqrt(speed / fastest);
      const [w, x, y, z] = fromX(v);
      const m = new THREE.Matrix4().compose(new THREE.Vector3(a[0]!, a[1]!, a[2]!), new THREE.Quaternion(x, y, z, w), new THREE.Vector3(l, l, l));
      this.mesh.setMatrixAt(this.drawn.length, m);
      const from: Vec3 = [a[0]!, a[1]!, a[2]!];
      this.drawn.push({ from, to: add(from, scale(v, l / speed)), speed_m_s: speed });
    }
    this.mesh.count = this.drawn.length;
    this.mesh.instanceMatrix.needsUpdate = true;
  }

  dispose(): void {
    this.mesh.geometry.dispose();
    this.mesh.material.dispose();
    this.mesh.dispose();
  }
}

/** The greatest speed of all arrows, in words; empty in still air. */
export function longest(arrows: number[][]): string {
  const fastest_m_s = fastestOf(arrows.filter(whole));
  return fastest_m_s > 0 ? `${number(fastest_m_s, 2)}\u00a0m/s` : "";
}

function whole(arrow: number[]): boolean {
  return arrow.length >= 6 && arrow.slice(0, 6).every(Number.isFinite);
}

/** Which layer across an axis is nearest to a place on it; null without arrows, or without an axis. */
function layerOf(arrows: number[][], axis: number | null, at: number): number | null {
  if (axis === null || arrows.length === 0) return null;
  return arrows.map((a) => a[axis]!).reduce((best, x) => (Math.abs(x - at) < Math.abs(best - at) ? x : best));
}

function fastestOf(arrows: number[][]): number {
  return arrows.reduce((most, a) => Math.max(most, length([a[3]!, a[4]!, a[5]!])), 0);
}

/** How far the arrows are apart, by the first and the one nearest to it, m; 5 if there is one only. */
function spacing(arrows: number[][]): number {
  const [a, ...others] = arrows;
  if (!a || others.length === 0) return 5;
  let least = Infinity;
  for (const b of others) {
    const d = length([a[0]! - b[0]!, a[1]! - b[1]!, a[2]! - b[2]!]);
    if (d > 1e-6 && d < least) least = d;
  }
  return Number.isFinite(least) ? least : 5;
}
