// The bodies of the swarm: one draw call for all small flyers, one for each other look.

import * as THREE from "three";
import type { Hello } from "../wire";
import { bodyOf, dart, flyer } from "./forms";
import { SWARM, type Frames } from "./frames";
import { LIGHT, type Shared } from "./light";

/** Above so many vehicles flyers are darts of few triangles. */
const MANY = 2000;
/** Up to so many have all their details. */
const FEW = 250;
/** Vehicles of a smaller radius are drawn as flyers, m. */
const FLYER_RADIUS_M = 1;

const VERTEX = /* glsl */ `
${SWARM}
attribute vec4 tint;
attribute float vehicle;
uniform vec3 uViewport;
/** The least radius on the screen, in CSS pixels; the radius of the geometry, 0: that of the vehicle. */
uniform float uLeast, uRadius;
varying vec3 vColour, vNormal2, vToEye;
varying float vAway;
void main() {
  vec4 place = placeOf(vehicle);
  vec4 turn = turnOf(vehicle);
  vec4 middle = uSee * vec4(place.xyz, 1.0);
  float pixel = 2.0 * middle.w / (projectionMatrix[1][1] * uViewport.y) * uViewport.z;
  float size = uRadius > 0.0 ? max(1.0, uLeast * pixel / uRadius) : max(place.w, uLeast * pixel);
  vec3 world = place.xyz + turned(turn, position) * size;
  vNormal2 = turned(turn, normal);
  vColour = mix(colourOf(vehicle).rgb, tint.rgb, tint.a);
  vColour *= vColour;
  vToEye = isOrthographic ? vec3(viewMatrix[0][2], viewMatrix[1][2], viewMatrix[2][2]) : cameraPosition - world;
  vAway = middle.w;
  gl_Position = uSee * vec4(world, 1.0);
}
`;

const FRAGMENT = /* glsl */ `
${LIGHT}
uniform float uOpacity, uGlow;
varying vec3 vColour, vNormal2, vToEye;
varying float vAway;
void main() {
  vec3 n = normalize(vNormal2);
  vec3 eye = normalize(vToEye);
  if (dot(n, eye) < 0.0) n = -n;
  vec3 colour = lit(vColour, n, 1.0) + vColour * uGlow;
  // Edges a little darker, so that a body stands out from one of the same colour behind it.
  colour *= mix(0.62, 1.0, smoothstep(0.0, 0.45, dot(n, eye)));
  gl_FragColor = vec4(toSrgb(mix(colour, hazed(colour, vAway), 0.6)), uOpacity);
}
`;

const BLOB_VERTEX = /* glsl */ `
${SWARM}
attribute float vehicle;
uniform vec3 uViewport;
uniform float uLeast;
varying vec2 vAt;
varying float vDark;
void main() {
  vec4 place = placeOf(vehicle);
  vec4 middle = uSee * vec4(place.xy, 0.0, 1.0);
  float pixel = 2.0 * middle.w / (projectionMatrix[1][1] * uViewport.y) * uViewport.z;
  float size = max(place.w, uLeast * pixel);
  float height = max(place.z, 0.0) / size;
  // The higher, the wider and the fainter.
  float wide = size * (1.0 + min(height * 0.03, 1.0));
  vDark = 0.5 / (1.0 + height * 0.035);
  vAt = position.xy;
  gl_Position = uSee * vec4(place.xy + position.xy * wide * 1.15, 0.0, 1.0);
  gl_Position.z -= 1e-5 * gl_Position.w;
  if (place.z < -size) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
}
`;

const BLOB_FRAGMENT = /* glsl */ `
varying vec2 vAt;
varying float vDark;
void main() {
  float r = length(vAt);
  if (r > 1.0) discard;
  gl_FragColor = vec4(0.0, 0.02, 0.05, vDark * (1.0 - smoothstep(0.25, 1.0, r)));
}
`;

function instances(body: THREE.BufferGeometry, who: number[]): THREE.InstancedBufferGeometry {
  const g = new THREE.InstancedBufferGeometry();
  for (const name of Object.keys(body.attributes)) g.setAttribute(name, body.getAttribute(name));
  g.setIndex(body.index);
  g.setAttribute("vehicle", new THREE.InstancedBufferAttribute(new Float32Array(who), 1));
  g.instanceCount = who.length;
  return g;
}

export class Vehicles {
  readonly group = new THREE.Group();
  /** The least radius of each on the screen, CSS pixels. */
  readonly least: number;
  private glow = { value: 0.2 };

  constructor(hello: Hello, frames: Frames, shared: Shared) {
    const { roles, looks } = hello.vehicles;
    const many = roles.length > MANY;
    this.least = roles.length > MANY ? 3.2 : roles.length > 300 ? 5 : 7;
    const batches = new Map<string, number[]>();
    for (let i = 0; i < roles.length; i++) {
      const key = this.keyOf(hello, i, looks[i] ?? -1);
      const list = batches.get(key);
      if (list) list.push(i);
      else batches.set(key, [i]);
    }
    for (const [key, who] of batches) {
      const [look, role] = key.split("|") as [string, string];
      const ghost = role === "ghost";
      const body = look === "flyer" ? (many ? dart() : flyer(roles.length <= FEW)) : bodyOf(hello.looks[Number(look)]?.pieces ?? [], hello.forms, who.length < 200);
      if (!body) continue;
      body.computeBoundingSphere();
      const material = new THREE.ShaderMaterial({
        vertexShader: VERTEX,
        fragmentShader: FRAGMENT,
        uniforms: {
          ...shared,
          ...frames.uniforms,
          uLeast: { value: look === "flyer" ? this.least : 2.5 },
          uRadius: { value: look === "flyer" ? 0 : Math.max(body.boundingSphere?.radius ?? 1, 1e-3) },
          uOpacity: { value: ghost ? 0.42 : 1 },
          uGlow: this.glow,
        },
        transparent: ghost,
        depthWrite: !ghost,
        side: THREE.DoubleSide,
      });
      const mesh = new THREE.Mesh(instances(body, who), material);
      mesh.frustumCulled = false;
      mesh.renderOrder = ghost ? 30 : 5;
      this.group.add(mesh);
    }
    if (hello.stage.plane && roles.length <= MANY && roles.length > 0) this.addBlobs(hello, frames, shared);
  }

  setDark(dark: boolean): void {
    this.glow.value = dark ? 0.5 : 0.16;
  }

  dispose(): void {
    this.group.traverse((o) => {
      if (o instanceof THREE.Mesh) {
        o.geometry.dispose();
        (o.material as THREE.Material).dispose();
      }
    });
  }

  private keyOf(hello: Hello, i: number, look: number): string {
    const role = hello.vehicles.roles[i] ?? "vehicle";
    const small = (hello.vehicles.radii_m[i] ?? 0) < FLYER_RADIUS_M;
    const shapeless = !hello.looks[look]?.pieces.length;
    return `${shapeless || (small && role === "vehicle") ? "flyer" : look}|${role === "ghost" ? "ghost" : ""}`;
  }

  /** A shadow on the ground under each: how high it flies is seen by the distance. */
  private addBlobs(hello: Hello, frames: Frames, shared: Shared): void {
    const disc = new THREE.CircleGeometry(1, 12);
    const material = new THREE.ShaderMaterial({
      vertexShader: BLOB_VERTEX,
      fragmentShader: BLOB_FRAGMENT,
      uniforms: { ...shared, ...frames.uniforms, uLeast: { value: this.least * 0.7 } },
      transparent: true,
      depthWrite: false,
    });
    const who = hello.vehicles.roles.map((_, i) => i).filter((i) => (hello.vehicles.radii_m[i] ?? 0) < FLYER_RADIUS_M);
    const mesh = new THREE.Mesh(instances(disc, who), material);
    mesh.frustumCulled = false;
    mesh.renderOrder = 2;
    this.group.add(mesh);
  }
}
