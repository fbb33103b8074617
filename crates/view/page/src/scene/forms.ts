// Outlines as triangles: the forms of the wire, flowers, and the little flyer that stands for a vehicle.
//
// All geometries have `position`, `normal` and `tint`: a colour (red, green, blue, 0 to 1) and how much of it (0: the
// thing's own colour, 1: this one).

import * as THREE from "three";
import type { Form, Piece } from "../wire";

/** A plain number array while a geometry is being made. */
interface Soup {
  position: number[];
  normal: number[];
  tint: number[];
}

function finish(soup: Soup): THREE.BufferGeometry {
  const g = new THREE.BufferGeometry();
  g.setAttribute("position", new THREE.Float32BufferAttribute(soup.position, 3));
  g.setAttribute("normal", new THREE.Float32BufferAttribute(soup.normal, 3));
  g.setAttribute("tint", new THREE.Float32BufferAttribute(soup.tint, 4));
  return g;
}

/** Adds a geometry, moved by `m`, with a tint (or by a function of the place before it is moved). */
function put(
  soup: Soup,
  g: THREE.BufferGeometry,
  m: THREE.Matrix4,
  tint: readonly number[] | ((x: number, y: number, z: number) => readonly number[]),
): void {
  const flat = g.index ? g.toNonIndexed() : g;
  const p = flat.getAttribute("position");
  const n = flat.getAttribute("normal");
  const own = flat.getAttribute("tint");
  const normal = new THREE.Matrix3().getNormalMatrix(m);
  const v = new THREE.Vector3();
  for (let i = 0; i < p.count; i++) {
    v.fromBufferAttribute(p, i);
    const t = own ? [own.getX(i), own.getY(i), own.getZ(i), own.getW(i)] : typeof tint === "function" ? tint(v.x, v.y, v.z) : tint;
    v.applyMatrix4(m);
    soup.position.push(v.x, v.y, v.z);
    v.fromBufferAttribute(n, i).applyMatrix3(normal).normalize();
    soup.normal.push(v.x, v.y, v.z);
    soup.tint.push(t[0]!, t[1]!, t[2]!, t[3]!);
  }
  if (flat !== g) flat.dispose();
  g.dispose();
}

const OWN = [0, 0, 0, 0] as const;

/** The matrix of a piece: its place, its turn, and sizes along its axes. */
export function matrixOf(piece: Piece, size: THREE.Vector3): THREE.Matrix4 {
  const [w, x, y, z] = piece.turn;
  return new THREE.Matrix4().compose(new THREE.Vector3(...piece.at), new THREE.Quaternion(x, y, z, w).normalize(), size);
}

/** How many triangles a form has: few, some, many. */
export type Fineness = 0 | 1 | 2;

/** A form of size 1: forms with the same `key` differ only in `size`. */
export interface Outline {
  key: string;
  size: THREE.Vector3;
  /** With few (0), some (1) or many (2) triangles. */
  make(fine: Fineness): THREE.BufferGeometry;
}

function upright(g: THREE.BufferGeometry): THREE.BufferGeometry {
  return g.rotateX(Math.PI / 2);
}

/** From a form of the wire; null if it has no size. */
export function outlineOf(form: Form, number: number): Outline | null {
  if ("sphere" in form) {
    const r = form.sphere;
    return { key: "sphere", size: new THREE.Vector3(r, r, r), make: (fine) => upright(new THREE.SphereGeometry(1, [6, 12, 28][fine], [4, 8, 18][fine])) };
  }
  if ("box" in form) {
    return { key: "box", size: new THREE.Vector3(...form.box), make: () => new THREE.BoxGeometry(2, 2, 2) };
  }
  if ("cylinder" in form) {
    const [foot, top, half] = form.cylinder;
    const r = Math.max(foot, top);
    if (!(r > 0)) return null;
    const [f, t] = [Math.round((foot / r) * 100) / 100, Math.round((top / r) * 100) / 100];
    return {
      key: `cylinder ${f} ${t}`,
      size: new THREE.Vector3(r, r, half),
      make: (fine) => upright(new THREE.CylinderGeometry(t, f, 2, [6, 10, 32][fine])),
    };
  }
  if ("capsule" in form) {
    const [r, half] = form.capsule;
    if (!(r > 0)) return null;
    const ratio = Math.round((half / r) * 50) / 50;
    return {
      key: `capsule ${ratio}`,
      size: new THREE.Vector3(r, r, r),
      make: (fine) => upright(new THREE.CapsuleGeometry(1, 2 * ratio, [2, 4, 8][fine], [6, 10, 24][fine])),
    };
  }
  const { points, triangles } = form.mesh;
  return { key: `mesh ${number}`, size: new THREE.Vector3(1, 1, 1), make: () => meshOf(points, triangles, false) };
}

/** Triangles with faces as flat as they are, or smooth as terrain is. Places out of range are left out. */
export function meshOf(points: number[], triangles: number[], smooth: boolean): THREE.BufferGeometry {
  const count = Math.floor(points.length / 3);
  const index: number[] = [];
  for (let i = 0; i + 2 < triangles.length; i += 3) {
    const t = triangles.slice(i, i + 3);
    if (t.every((p) => p >= 0 && p < count)) index.push(...t);
  }
  let g = new THREE.BufferGeometry();
  g.setAttribute("position", new THREE.Float32BufferAttribute(points.slice(0, count * 3), 3));
  g.setIndex(index);
  if (!smooth) g = g.toNonIndexed();
  g.computeVertexNormals();
  return g;
}

/** Pieces as one geometry in the frame they stand in; null if there is nothing to see. */
export function bodyOf(pieces: Piece[], forms: Form[], fine: Fineness): THREE.BufferGeometry | null {
  const soup: Soup = { position: [], normal: [], tint: [] };
  for (const piece of pieces) {
    const form = forms[piece.form];
    const outline = form && outlineOf(form, piece.form);
    if (outline) put(soup, outline.make(fine), matrixOf(piece, outline.size), OWN);
  }
  return soup.position.length > 0 ? finish(soup) : null;
}

const at = (x: number, y: number, z: number, sx = 1, sy = 1, sz = 1): THREE.Matrix4 =>
  new THREE.Matrix4().makeTranslation(x, y, z).scale(new THREE.Vector3(sx, sy, sz));

/** A flyer of radius 1, nose along x: a striped body, a light face, four rotors on their arms. About 330 triangles. */
export function flyer(): THREE.BufferGeometry {
  const soup: Soup = { position: [], normal: [], tint: [] };
  const dark = [0.08, 0.08, 0.1, 0.85];
  const body = new THREE.SphereGeometry(1, 10, 12).rotateZ(-Math.PI / 2);
  const stripes = (x: number): readonly number[] =>
    x > 0.72 ? [1, 1, 0.97, 0.92] : x < 0.42 && Math.floor((x + 1) * 4.2) % 2 === 0 ? dark : OWN;
  put(soup, body, at(0.02, 0, 0, 0.62, 0.3, 0.27), stripes);
  for (const [x, y] of [[1, 1], [1, -1], [-1, 1], [-1, -1]] as const) {
    const tip = [x * 0.52, y * 0.56] as const;
    const arm = new THREE.Matrix4()
      .makeTranslation(tip[0] / 2, tip[1] / 2, 0.1)
      .multiply(new THREE.Matrix4().makeRotationZ(Math.atan2(tip[1], tip[0])))
      .scale(new THREE.Vector3(Math.hypot(...tip), 0.06, 0.06));
    put(soup, new THREE.BoxGeometry(1, 1, 1), arm, dark);
    // Rotors in front are lighter than those behind: the way it flies is seen from far.
    put(soup, new THREE.CircleGeometry(0.33, 14), at(tip[0], tip[1], 0.17), x > 0 ? [1, 1, 1, 0.3] : [0.04, 0.04, 0.05, 0.35]);
    const rim = new THREE.RingGeometry(0.29, 0.335, 14);
    put(soup, rim, at(tip[0], tip[1], 0.175), [0.05, 0.06, 0.08, 0.8]);
  }
  return finish(soup);
}

const LEAF = [0.34, 0.55, 0.2, 0.9] as const;

/** The stem of a flower, radius 1, half height 1: green, without ends; `leaves`: with two of them. */
export function stem(leaves: boolean): THREE.BufferGeometry {
  const soup: Soup = { position: [], normal: [], tint: [] };
  put(soup, upright(new THREE.CylinderGeometry(1, 1, 2, leaves ? 6 : 3, 1, true)), new THREE.Matrix4(), LEAF);
  if (leaves) {
    for (const turn of [0.4, 3.4]) {
      const leaf = new THREE.BufferGeometry();
      leaf.setAttribute("position", new THREE.Float32BufferAttribute([0, 0, -0.75, 3.2, 1.6, -0.4, 6, 0, -0.3, 0, 0, -0.75, 6, 0, -0.3, 3.2, -1.6, -0.4], 3));
      leaf.computeVertexNormals();
      put(soup, leaf, new THREE.Matrix4().makeRotationZ(turn), LEAF);
    }
  }
  return finish(soup);
}

/** The head of a flower, radius 1, half height 1: petals around a yellow middle, cupped. Seen from both sides. */
export function bloom(fine: boolean): THREE.BufferGeometry {
  const soup: Soup = { position: [], normal: [], tint: [] };
  const petals = fine ? 7 : 5;
  const push = (r: number, phi: number, z: number, tint: readonly number[]): void => {
    soup.position.push(r * Math.cos(phi), r * Math.sin(phi), z);
    soup.normal.push(-0.3 * Math.cos(phi), -0.3 * Math.sin(phi), 0.95);
    soup.tint.push(...tint);
  };
  const yolk = [0.98, 0.76, 0.1, 0.95];
  const deep = [0.25, 0.02, 0.12, 0.3];
  const light = [1, 1, 1, 0.22];
  for (let i = 0; i < petals; i++) {
    const phi = (2 * Math.PI * i) / petals;
    const half = (Math.PI / petals) * 0.86;
    // A petal is a kite: narrow at the middle, widest at two thirds, round enough at its tip.
    push(0.12, phi, 0, deep);
    push(0.72, phi - half, 0.7, OWN);
    push(1, phi, 1, light);
    push(0.12, phi, 0, deep);
    push(1, phi, 1, light);
    push(0.72, phi + half, 0.7, OWN);
    if (fine) {
      push(0.72, phi - half, 0.7, OWN);
      push(0.95, phi - half * 0.6, 0.95, light);
      push(1, phi, 1, light);
      push(1, phi, 1, light);
      push(0.95, phi + half * 0.6, 0.95, light);
      push(0.72, phi + half, 0.7, OWN);
    }
  }
  const sides = fine ? 8 : 4;
  for (let i = 0; i < sides; i++) {
    push(0.3, (2 * Math.PI * i) / sides, 0.6, yolk);
    push(0.3, (2 * Math.PI * (i + 1)) / sides, 0.6, yolk);
    push(0, 0, 1.6, yolk);
  }
  return finish(soup);
}
