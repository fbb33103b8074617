// What stands in the world: props as few draw calls.
//
// Pieces of equal form are drawn in one call, each with its own place, size and colour (100,000 flowers are two calls);
// forms that occur seldom are put together into one geometry. Textures lie on the surface by its size in metres.

import * as THREE from "three";
import type { Form, Hello, Piece, Prop } from "../wire";
import { colourOf } from "./colours";
import { bloom, matrixOf, meshOf, outlineOf, stem } from "./forms";
import { GRID } from "./grid";
import { LIGHT, SHADOW, type Shared } from "./light";
import type { Textures } from "./textures";
import { TONE } from "./tone";

/** Fewer pieces of a form than this are put together with others. */
const FEW = 12;
/** Above so many flowers each has fewer triangles. */
const MANY_FLOWERS = 3000;

const VERTEX = /* glsl */ `
attribute vec4 colour;
#ifndef MANY
attribute vec3 local, localNormal;
#endif
attribute vec4 tint;
attribute float foot;
uniform mat4 uSee;
uniform float uFlat, uCeiling;
varying vec4 vColour;
varying vec3 vNormal2, vWorld, vLocal, vLocalNormal;
varying float vAway;
void main() {
  #ifdef MANY
  vec3 size = vec3(length(instanceMatrix[0].xyz), length(instanceMatrix[1].xyz), length(instanceMatrix[2].xyz));
  vec3 safe = max(size, 1e-6);
  vec4 world = instanceMatrix * vec4(position, 1.0);
  vNormal2 = mat3(instanceMatrix) * (normal / (safe * safe));
  vLocal = position * size;
  vLocalNormal = normal / safe;
  #else
  vec4 world = vec4(position, 1.0);
  vNormal2 = normal;
  vLocal = local;
  vLocalNormal = localNormal;
  #endif
  vColour = vec4(mix(colour.rgb, tint.rgb, tint.a), colour.a);
  vWorld = world.xyz;
  gl_Position = foot < uCeiling ? uSee * world : vec4(2.0, 2.0, 2.0, 1.0);
  vAway = uFlat > 0.5 ? 0.0 : gl_Position.w;
}
`;

const FRAGMENT = /* glsl */ `
${LIGHT}
${SHADOW}
#ifdef TERRAIN
${GRID}
${TONE}
uniform vec3 uLine, uViewport;
#endif
uniform float uWorldTone, uTile, uReady;
uniform sampler2D uTexture;
varying vec4 vColour;
varying vec3 vNormal2, vWorld, vLocal, vLocalNormal;
varying float vAway;
void main() {
  vec3 n = normalize(vNormal2);
  vec3 base = fromSrgb(vColour.rgb);
  #ifdef TEXTURED
  vec3 w = abs(normalize(vLocalNormal));
  vec2 at = w.z > w.x && w.z > w.y ? vLocal.xy : w.x > w.y ? vLocal.yz : vLocal.xz;
  vec3 picture = texture2D(uTexture, at / uTile).rgb;
  // A thing that is grey shows the picture as it is; one with a colour of its own is dyed.
  float high = max(vColour.r, max(vColour.g, vColour.b));
  float low = min(vColour.r, min(vColour.g, vColour.b));
  float dyed = smoothstep(0.08, 0.3, high > 0.0 ? (high - low) / high : 0.0);
  vec3 natural = fromSrgb(picture);
  base = mix(base, mix(natural, base * dot(picture, vec3(0.65, 1.2, 0.5)), dyed), uReady);
  #endif
  #ifdef BOTH_SIDES
  if (!gl_FrontFacing) n = -n;
  #endif
  float sun = sunAt(vWorld + n * 0.02);
  #ifdef TERRAIN
  base = fromSrgb(toned(toSrgb(base)));
  vec3 colour = lit(base, n, sun) / lit(vec3(1.0), uSun, 1.0);
  colour = mix(colour, uLine, 0.5 * gridAt(vWorld.xy, max(fwidth(vWorld.xy), 1e-9) * uViewport.z));
  #else
  vec3 colour = lit(base * uWorldTone, n, sun);
  // Less sky is seen close to the ground.
  colour *= 0.82 + 0.18 * smoothstep(0.0, 0.5, vWorld.z);
  #endif
  gl_FragColor = vec4(toSrgb(hazed(colour, vAway)), vColour.a);
}
`;

/** A piece with what it needs of its prop. */
interface Item {
  prop: number;
  matrix: THREE.Matrix4;
  /** How high its lowest point is, m; terrain is never above anything. */
  foot_m: number;
  colour: [number, number, number, number];
}

interface Batch {
  texture: string;
  clear: boolean;
  both: boolean;
  terrain: boolean;
  make(): THREE.BufferGeometry;
  items: Item[];
}

/** What picking needs of a piece: its geometry's triangles, where it stands, and a ball around it. */
export interface Target {
  prop: number;
  matrix: THREE.Matrix4;
  triangles: () => ArrayLike<number>;
  ball: [x: number, y: number, z: number, radius: number];
  foot_m: number;
}

export class World {
  readonly group = new THREE.Group();
  readonly targets: Target[] = [];
  readonly props: Prop[];
  /** The corners of all that stands here; empty if nothing does. */
  readonly bounds = new THREE.Box3();
  /** Pieces that begin above this are cut away, m. */
  ceiling_m = Infinity;
  private materials: THREE.ShaderMaterial[] = [];

  constructor(
    hello: Hello,
    private shared: Shared,
    private textures: Textures,
    /** Those of `GRID` and `TONE`, for terrain. */
    private grid: Record<string, THREE.IUniform>,
  ) {
    this.props = hello.stage.props;
    const batches = this.sort(hello.stage.props, hello.forms);
    const together = new Map<string, { batch: Batch; geometry: THREE.BufferGeometry }[]>();
    for (const batch of batches.values()) {
      const geometry = this.withTint(batch.make());
      this.noteTargets(batch, geometry);
      if (batch.items.length >= FEW) this.addMany(batch, geometry);
      else {
        const key = `${batch.texture}|${batch.clear}|${batch.both}|${batch.terrain}`;
        const list = together.get(key);
        if (list) list.push({ batch, geometry });
        else together.set(key, [{ batch, geometry }]);
      }
    }
    for (const list of together.values()) this.addTogether(list);
  }

  /** Whether there is anything that begins above this. */
  reachesAbove(height_m: number): boolean {
    return this.targets.some((target) => target.foot_m >= height_m);
  }

  /** Cuts away what begins above this; `Infinity`: nothing. Whether that changes anything. */
  cut(ceiling_m: number): boolean {
    const [low, high] = [Math.min(ceiling_m, this.ceiling_m), Math.max(ceiling_m, this.ceiling_m)];
    this.ceiling_m = ceiling_m;
    this.shared.uCeiling.value = Math.min(ceiling_m, 1e9);
    return this.targets.some(({ foot_m }) => foot_m >= low && foot_m < high);
  }

  dispose(): void {
    this.group.traverse((o) => {
      if (o instanceof THREE.Mesh) {
        o.geometry.dispose();
        if (o instanceof THREE.InstancedMesh) o.dispose();
      }
    });
    for (const m of this.materials) m.dispose();
  }

  private sort(props: Prop[], forms: Form[]): Map<string, Batch> {
    const batches = new Map<string, Batch>();
    const flowers = props.reduce((n, p) => n + (p.kind === "flower" ? 1 : 0), 0);
    const fine = flowers < MANY_FLOWERS;
    props.forEach((prop, number) => {
      const colour = colourOf(prop.color);
      const clear = colour[3] < 255;
      const head = prop.kind === "flower" && prop.pieces.length > 1 ? highest(prop.pieces) : -1;
      prop.pieces.forEach((piece, which) => {
        const form = forms[piece.form];
        const outline = form && outlineOf(form, piece.form);
        if (!form || !outline) return;
        let key = outline.key;
        let make = (): THREE.BufferGeometry => outline.make(2);
        let both = "mesh" in form;
        let matrix = matrixOf(piece, outline.size);
        if (prop.kind === "flower" && prop.pieces.length > 1 && "cylinder" in form) {
          key = which === head ? "bloom" : "stem";
          make = which === head ? () => bloom(fine) : () => stem(fine);
          both = true;
          // No two flowers look the same way.
          if (which === head) matrix = headOf(piece, outline.size, number);
        } else if (prop.kind === "terrain" && "mesh" in form) {
          make = () => meshOf(form.mesh.points, form.mesh.triangles, true);
        }
        key += `|${prop.texture}|${clear}|${prop.kind === "terrain"}`;
        let batch = batches.get(key);
        if (!batch) batches.set(key, (batch = { texture: prop.texture, clear, both, terrain: prop.kind === "terrain", make, items: [] }));
        batch.items.push({ prop: number, matrix, foot_m: -Infinity, colour: vary(colour, prop, number) });
      });
    });
    return batches;
  }

  private withTint(g: THREE.BufferGeometry): THREE.BufferGeometry {
    if (!g.getAttribute("tint")) {
      g.setAttribute("tint", new THREE.BufferAttribute(new Float32Array(g.getAttribute("position").count * 4), 4));
    }
    return g;
  }

  private noteTargets(batch: Batch, geometry: THREE.BufferGeometry): void {
    geometry.computeBoundingSphere();
    geometry.computeBoundingBox();
    const sphere = geometry.boundingSphere!;
    let flat: ArrayLike<number> | null = null;
    const triangles = (): ArrayLike<number> => {
      flat ??= (geometry.index ? geometry.toNonIndexed() : geometry).getAttribute("position").array;
      return flat;
    };
    const c = new THREE.Vector3();
    for (const item of batch.items) {
      const { prop, matrix } = item;
      const box = geometry.boundingBox!.clone().applyMatrix4(matrix);
      if (!batch.terrain) item.foot_m = box.min.z;
      c.copy(sphere.center).applyMatrix4(matrix);
      const radius = sphere.radius * matrix.getMaxScaleOnAxis();
      this.targets.push({ prop, matrix, triangles, ball: [c.x, c.y, c.z, radius], foot_m: item.foot_m });
      this.bounds.union(box);
    }
  }

  private addMany(batch: Batch, geometry: THREE.BufferGeometry): void {
    const n = batch.items.length;
    const mesh = new THREE.InstancedMesh(geometry, this.material(batch, true), n);
    const colours = new Uint8Array(n * 4);
    geometry.setAttribute("foot", new THREE.InstancedBufferAttribute(Float32Array.from(batch.items, footOf), 1));
    batch.items.forEach((item, i) => {
      mesh.setMatrixAt(i, item.matrix);
      colours.set(item.colour, i * 4);
    });
    geometry.setAttribute("colour", new THREE.InstancedBufferAttribute(colours, 4, true));
    mesh.frustumCulled = false;
    mesh.renderOrder = batch.clear ? 20 : 3;
    this.group.add(mesh);
  }

  private addTogether(list: { batch: Batch; geometry: THREE.BufferGeometry }[]): void {
    const names = ["position", "normal", "tint", "local", "localNormal", "colour", "foot"] as const;
    const soup: Record<(typeof names)[number], number[]> = { position: [], normal: [], tint: [], local: [], localNormal: [], colour: [], foot: [] };
    const v = new THREE.Vector3();
    for (const { batch, geometry } of list) {
      const g = geometry.index ? geometry.toNonIndexed() : geometry;
      const [p, n, t] = [g.getAttribute("position"), g.getAttribute("normal"), g.getAttribute("tint")];
      for (const item of batch.items) {
        const { matrix, colour } = item;
        const turn = new THREE.Matrix3().getNormalMatrix(matrix);
        const size = new THREE.Vector3().setFromMatrixScale(matrix);
        for (let i = 0; i < p.count; i++) {
          v.fromBufferAttribute(p, i);
          soup.local.push(v.x * size.x, v.y * size.y, v.z * size.z);
          v.applyMatrix4(matrix);
          soup.position.push(v.x, v.y, v.z);
          v.fromBufferAttribute(n, i);
          soup.localNormal.push(v.x / size.x, v.y / size.y, v.z / size.z);
          v.applyMatrix3(turn).normalize();
          soup.normal.push(v.x, v.y, v.z);
          soup.tint.push(t.getX(i), t.getY(i), t.getZ(i), t.getW(i));
          soup.foot.push(footOf(item));
          soup.colour.push(colour[0], colour[1], colour[2], colour[3]);
        }
      }
    }
    const g = new THREE.BufferGeometry();
    for (const name of names) {
      if (name === "colour") g.setAttribute(name, new THREE.Uint8BufferAttribute(soup.colour, 4, true));
      else g.setAttribute(name, new THREE.Float32BufferAttribute(soup[name], name === "tint" ? 4 : name === "foot" ? 1 : 3));
    }
    const batch = list[0]!.batch;
    const mesh = new THREE.Mesh(g, this.material(batch, false));
    mesh.frustumCulled = false;
    mesh.renderOrder = batch.clear ? 20 : 3;
    this.group.add(mesh);
  }

  private material(batch: Batch, many: boolean): THREE.ShaderMaterial {
    const texture = this.textures.get(batch.texture);
    const material = new THREE.ShaderMaterial({
      vertexShader: VERTEX,
      fragmentShader: FRAGMENT,
      defines: { ...(many && { MANY: 1 }), ...(texture && { TEXTURED: 1 }), ...(batch.both && { BOTH_SIDES: 1 }), ...(batch.terrain && { TERRAIN: 1 }) },
      uniforms: {
        ...this.shared,
        ...(batch.terrain && this.grid),
        uTexture: { value: texture?.texture ?? null },
        uReady: texture?.ready ?? { value: 0 },
        uTile: { value: texture?.tile_m ?? 1 },
      },
      transparent: batch.clear,
      side: batch.both ? THREE.DoubleSide : THREE.FrontSide,
    });
    this.materials.push(material);
    return material;
  }
}

/** A flower's head: as wide as it is, but cupped, and leaning a little, so that it is seen from the side too. */
function headOf(piece: Piece, size: THREE.Vector3, number: number): THREE.Matrix4 {
  const way = number * 2.4;
  const lean = 0.25 + 0.2 * Math.sin(number * 1.7);
  const turn = new THREE.Quaternion().setFromAxisAngle(new THREE.Vector3(Math.cos(way), Math.sin(way), 0), lean);
  turn.multiply(new THREE.Quaternion().setFromAxisAngle(new THREE.Vector3(0, 0, 1), way * 3));
  const [w, x, y, z] = piece.turn;
  const own = new THREE.Quaternion(x, y, z, w).normalize().multiply(turn);
  return new THREE.Matrix4().compose(new THREE.Vector3(...piece.at), own, new THREE.Vector3(size.x, size.y, Math.max(size.z, size.x * 0.32)));
}

/** As a number that a shader can compare. */
function footOf({ foot_m }: Item): number {
  return Math.max(foot_m, -1e9);
}

function highest(pieces: Piece[]): number {
  let best = 0;
  pieces.forEach((p, i) => {
    if (p.at[2] > pieces[best]!.at[2]) best = i;
  });
  return best;
}

/** Flowers and leaves differ a little from one another. */
function vary(colour: [number, number, number, number], prop: Prop, number: number): [number, number, number, number] {
  if (prop.kind !== "flower") return colour;
  const f = 0.86 + 0.14 * Math.abs(Math.sin(number * 12.9898) * 43758.5453 % 1);
  return [colour[0] * f, colour[1] * f, colour[2] * f, colour[3]];
}
