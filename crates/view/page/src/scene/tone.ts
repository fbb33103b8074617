// How the ground is toned down: it keeps its hue and its pattern, while the theme says how light it is, so that a
// swarm stands out on every ground. Terrain is ground, too.

import * as THREE from "three";

/** What `TONE` reads. */
export interface ToneUniforms {
  [name: string]: THREE.IUniform;
  /** What a ground of middle grey becomes, sRGB. */
  uLevel: THREE.IUniform<THREE.Vector3>;
  /** How much stays of what is lighter or darker, and of the hue. */
  uKeep: THREE.IUniform<THREE.Vector2>;
}

export function toneUniforms(): ToneUniforms {
  return { uLevel: { value: new THREE.Vector3() }, uKeep: { value: new THREE.Vector2() } };
}

export function setTone(uniforms: ToneUniforms, dark: boolean): void {
  if (dark) {
    uniforms.uLevel.value.set(0.15, 0.17, 0.2);
    uniforms.uKeep.value.set(0.12, 0.24);
  } else {
    uniforms.uLevel.value.set(0.765, 0.77, 0.75);
    uniforms.uKeep.value.set(0.26, 0.8);
  }
}

/** `toned(colour)`: from sRGB to sRGB. */
export const TONE = /* glsl */ `
uniform vec3 uLevel;
uniform vec2 uKeep;
vec3 toned(vec3 c) {
  float l = dot(c, vec3(0.3, 0.6, 0.1));
  vec3 hue = c - l;
  float strong = length(hue);
  // A strong hue is held back: no ground shouts.
  hue *= uKeep.y / (1.0 + 2.2 * strong);
  return clamp(uLevel + (l - 0.5) * uKeep.x + hue, 0.0, 1.0);
}
`;
