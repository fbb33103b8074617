// What is behind all things: the sky with its horizon; in a view from the side a sheet with a grid of heights, and the
// ground cut through.

import * as THREE from "three";
import type { Orbit } from "./camera";
import { GRID, type GridUniforms } from "./grid";
import { LIGHT, type Shared } from "./light";

const VERTEX = /* glsl */ `
uniform float uMiddle;
varying vec2 vScreen;
void main() { vScreen = vec2(position.x - uMiddle, position.y); gl_Position = vec4(position.xy, 0.999999, 1.0); }
`;

const FRAGMENT = /* glsl */ `
${LIGHT}
${GRID}
uniform vec3 uZenith, uBack, uRight, uUp, uTarget, uLine, uViewport, uCut;
uniform float uHalfHeight, uPlane;
uniform vec2 uTan;
varying vec2 vScreen;
void main() {
  vec3 colour;
  if (uFlat > 0.5) {
    vec2 half_ = vec2(uHalfHeight * uViewport.x / uViewport.y, uHalfHeight);
    float side = 1.0 - smoothstep(0.02, 0.1, abs(uBack.z));
    colour = mix(uHaze, uZenith, 0.3 * clamp(vScreen.y * 0.5 + 0.5, 0.0, 1.0));
    vec2 at = vec2(dot(uTarget, uRight), uTarget.z) + vScreen * half_;
    vec2 w = vec2(2.0 * uHalfHeight / uViewport.y * uViewport.z);
    bool cut = at.y < 0.0 && uPlane > 0.0;
    if (cut) colour = mix(colour, uCut, side);
    colour = mix(colour, uLine, gridAt(at, w) * side * (cut ? 0.0 : 0.55));
  } else {
    vec3 d = normalize(-uBack + uRight * vScreen.x * uTan.x + uUp * vScreen.y * uTan.y);
    float g = 1.0 - clamp(d.z, 0.0, 1.0);
    g *= g;
    // Pale at the horizon, quickly deeper above it, and the same below where there is no ground.
    colour = mix(uZenith, uHaze, g * g * (0.35 + 0.65 * g));
    if (d.z < 0.0) colour = mix(uHaze, uCut, 0.5 * smoothstep(0.0, 0.6, -d.z));
    float s = max(dot(d, uSun), 0.0);
    s *= s;
    s *= s;
    colour += uSunLight * (0.1 * s * s);
  }
  gl_FragColor = vec4(toSrgb(colour), 1.0);
}
`;

export class Sky {
  readonly mesh: THREE.Mesh<THREE.PlaneGeometry, THREE.ShaderMaterial>;
  private own;

  constructor(plane: boolean, shared: Shared, grid: GridUniforms) {
    this.own = {
      uBack: { value: new THREE.Vector3() },
      uRight: { value: new THREE.Vector3() },
      uUp: { value: new THREE.Vector3() },
      uTarget: { value: new THREE.Vector3() },
      uTan: { value: new THREE.Vector2() },
      uMiddle: { value: 0 },
      uHalfHeight: { value: 1 },
      uPlane: { value: plane ? 1 : 0 },
    };
    const material = new THREE.ShaderMaterial({
      vertexShader: VERTEX,
      fragmentShader: FRAGMENT,
      uniforms: { ...shared, ...grid, ...this.own },
      depthWrite: false,
    });
    this.mesh = new THREE.Mesh(new THREE.PlaneGeometry(2, 2), material);
    this.mesh.frustumCulled = false;
    // Last of what hides: only where nothing else is.
    this.mesh.renderOrder = 4;
  }

  /** Before each picture. */
  update(orbit: Orbit, shared: Shared): void {
    const u = this.own;
    const [back, right, up] = orbit.axes();
    u.uBack.value.set(back[0], back[1], back[2]);
    u.uRight.value.set(right[0], right[1], right[2]);
    u.uUp.value.set(up[0], up[1], up[2]);
    const lens = orbit.lens();
    u.uMiddle.value = orbit.middle();
    u.uTan.value.set(lens.tan * lens.aspect, lens.tan);
    const target = orbit.target();
    u.uTarget.value.set(target[0], target[1], target[2]);
    u.uHalfHeight.value = (orbit.pixel() * shared.uViewport.value.y) / shared.uViewport.value.z / 2;
  }

  dispose(): void {
    this.mesh.geometry.dispose();
    this.mesh.material.dispose();
  }
}
