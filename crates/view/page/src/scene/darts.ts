// Small flyers from afar: a dart each, nose along the way the body faces, that never gets too small to see. Two
// triangles each: a hundred thousand of them are still drawn.
//
// A dart is drawn flat on the screen with a rim that keeps it apart from what is behind it, whatever its colour. One
// that faces the eye, or away from it, is a round dot. What is near enough to be seen as it is (near.ts) has none.

import * as THREE from "three";
import { instances } from "./bodies";
import { SWARM, type Frames } from "./frames";
import { LIGHT, type Shared } from "./light";

const VERTEX = /* glsl */ `
${SWARM}
attribute float vehicle, hollow;
uniform vec3 uViewport;
uniform float uLeast, uNear, uTargetDepth;
varying vec3 vColour;
varying vec2 vAt;
varying vec4 vHow;
void main() {
  vec4 place = placeOf(vehicle);
  vec4 middle = uSee * vec4(place.xyz, 1.0);
  float pixel = 2.0 * middle.w / (projectionMatrix[1][1] * uViewport.y) * uViewport.z;
  float own = place.w / pixel;
  // Nearer ones a little larger, also where all have their least size.
  float depth = uFlat > 0.5 ? 1.0 : clamp(pow(uTargetDepth / max(middle.w, 1e-9), 0.4), 0.75, 1.35);
  float r = max(own, uLeast * depth);
  vec4 nose = uSee * vec4(turned(turnOf(vehicle), vec3(1.0, 0.0, 0.0)), 0.0);
  vec2 way = (nose.xy * middle.w - middle.xy * nose.w) / (middle.w * middle.w) * uViewport.xy * (0.5 / uViewport.z);
  float l = length(way);
  way = l > 0.0 ? way / l : vec2(0.0, 1.0);
  float margin = (r + 2.5) / r;
  vAt = position.xy * margin;
  vHow = vec4(r * uViewport.z, l * pixel, middle.w, hollow);
  vColour = colourOf(vehicle).rgb;
  vec2 off = (way * vAt.x + vec2(-way.y, way.x) * vAt.y) * r;
  gl_Position = middle;
  gl_Position.xy += off * (2.0 * uViewport.z) / uViewport.xy * middle.w;
  bool hidden = hollow < 0.5 && own > uNear;
  if (hidden || !(middle.w > 0.0)) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
}
`;

const FRAGMENT = /* glsl */ `
${LIGHT}
uniform vec4 uRim;
varying vec3 vColour;
varying vec2 vAt;
varying vec4 vHow;
void main() {
  float facing = vHow.y;
  vec2 p = vec2(vAt.x / mix(0.66, 1.0, smoothstep(0.2, 0.9, facing)), abs(vAt.y));
  // Nose (1, 0), wing tip (-0.85, 0.72), notch (-0.45, 0).
  float dart = max(dot(p - vec2(1.0, 0.0), vec2(0.3627, 0.9319)), dot(p - vec2(-0.45, 0.0), vec2(-0.8742, -0.4856)));
  float dot_ = length(vAt) - 0.6;
  float d = mix(dot_, dart, smoothstep(0.1, 0.3, facing)) * vHow.x;
  float rim = clamp(0.18 * vHow.x, 0.4, 1.8);
  float all_ = clamp(0.5 + rim - d, 0.0, 1.0);
  float fill = clamp(0.5 - d, 0.0, 1.0);
  vec3 colour = fromSrgb(vColour) * (vAt.y > 0.0 ? 1.1 : 0.78);
  colour = mix(colour, uHaze, 0.45 * (1.0 - exp(min((uHazeRange.x - vHow.z) / uHazeRange.y, 0.0))));
  float inside = fill * (vHow.w > 0.5 ? 0.25 : 1.0);
  float edge = (all_ - fill) * uRim.a;
  vec3 rimColour = vHow.w > 0.5 ? colour * 0.6 : uRim.rgb;
  float a = inside + edge;
  if (a < 0.02) discard;
  gl_FragColor = vec4(toSrgb((colour * inside + rimColour * edge) / a), a);
}
`;

export class Darts {
  readonly mesh: THREE.Mesh<THREE.InstancedBufferGeometry, THREE.ShaderMaterial>;
  private own;

  /** `hollow`: those that are only announced, drawn as outlines. */
  constructor(who: number[], hollow: (i: number) => boolean, least_px: number, frames: Frames, shared: Shared) {
    this.own = { uLeast: { value: least_px }, uNear: { value: Infinity }, uTargetDepth: { value: 1 } };
    const square = new THREE.PlaneGeometry(2, 2);
    square.deleteAttribute("normal");
    square.deleteAttribute("uv");
    const g = instances(square, who);
    g.setAttribute("hollow", new THREE.InstancedBufferAttribute(Uint8Array.from(who, (i) => (hollow(i) ? 1 : 0)), 1));
    const material = new THREE.ShaderMaterial({
      vertexShader: VERTEX,
      fragmentShader: FRAGMENT,
      uniforms: { ...shared, ...frames.uniforms, ...this.own },
      transparent: true,
      side: THREE.DoubleSide,
    });
    this.mesh = new THREE.Mesh(g, material);
    this.mesh.frustumCulled = false;
    this.mesh.renderOrder = 6;
  }

  /** Before each picture. `near_px`: whose radius on the screen is larger is drawn as it is. */
  update(near_px: number, targetDepth: number): void {
    this.own.uNear.value = near_px;
    this.own.uTargetDepth.value = targetDepth;
  }

  /** How large a dart is at a clip depth, CSS pixels: as the shader has it. */
  static least(least_px: number, depth: number, targetDepth: number, flat: boolean): number {
    if (flat) return least_px;
    return least_px * Math.min(1.35, Math.max(0.75, (targetDepth / Math.max(depth, 1e-9)) ** 0.4));
  }

  dispose(): void {
    this.mesh.geometry.dispose();
    this.mesh.material.dispose();
  }
}
