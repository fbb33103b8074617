// Light, haze and the colours of both themes; what all shaders of the scene share.
//
// Shaders compute with light (linear), and turn it into sRGB at their end, both with a
// gamma of 2, which is cheap; three.js' own colour management is off.

import * as THREE from "three";
import { linear } from "./colours";

/** Uniforms that every material of the scene has. They are the same objects: set once, seen everywhere. */
export interface Shared {
  [name: string]: THREE.IUniform;
  uSun: THREE.IUniform<THREE.Vector3>;
  uSunLight: THREE.IUniform<THREE.Vector3>;
  uSkyLight: THREE.IUniform<THREE.Vector3>;
  uEarthLight: THREE.IUniform<THREE.Vector3>;
  uHaze: THREE.IUniform<THREE.Vector3>;
  uZenith: THREE.IUniform<THREE.Vector3>;
  /** Where haze begins and where nothing else is seen, m from the eye. */
  uHazeRange: THREE.IUniform<THREE.Vector2>;
  /** Width and height of the picture, and the size of a CSS pixel, in its pixels. */
  uViewport: THREE.IUniform<THREE.Vector3>;
  /** Darkens the colours of the world, so that vehicles stand out. */
  uWorldTone: THREE.IUniform<number>;
  /** From the world to the picture. */
  uSee: THREE.IUniform<THREE.Matrix4>;
  /** Wall time, s. */
  uClock: THREE.IUniform<number>;
  uShadow: THREE.IUniform<THREE.Texture | null>;
  uShadowFrom: THREE.IUniform<THREE.Matrix4>;
  /** 0: there are no shadows. */
  uShadowDepth: THREE.IUniform<number>;
  /** 1: their edges are smooth. */
  uShadowFine: THREE.IUniform<number>;
}

function rgb(text: string, gain = 1): THREE.Vector3 {
  const n = (at: number): number => linear(parseInt(text.slice(at, at + 2), 16)) * gain;
  return new THREE.Vector3(n(1), n(3), n(5));
}

export function createShared(dark: boolean): Shared {
  const empty = new THREE.DataTexture(new Uint8Array([255, 255, 255, 255]), 1, 1);
  empty.needsUpdate = true;
  const shared: Shared = {
    uSun: { value: new THREE.Vector3(-0.52, -0.36, 0.77).normalize() },
    uSunLight: { value: new THREE.Vector3() },
    uSkyLight: { value: new THREE.Vector3() },
    uEarthLight: { value: new THREE.Vector3() },
    uHaze: { value: new THREE.Vector3() },
    uZenith: { value: new THREE.Vector3() },
    uHazeRange: { value: new THREE.Vector2(1e4, 2e4) },
    uViewport: { value: new THREE.Vector3(1, 1, 1) },
    uWorldTone: { value: 1 },
    uSee: { value: new THREE.Matrix4() },
    uClock: { value: 0 },
    uShadow: { value: empty },
    uShadowFrom: { value: new THREE.Matrix4() },
    uShadowDepth: { value: 0 },
    uShadowFine: { value: 1 },
  };
  setTheme(shared, dark);
  return shared;
}

export function setTheme(shared: Shared, dark: boolean): void {
  if (dark) {
    shared.uSunLight.value.set(0.62, 0.7, 0.95).multiplyScalar(0.5);
    shared.uSkyLight.value.set(0.42, 0.52, 0.78).multiplyScalar(0.5);
    shared.uEarthLight.value.set(0.2, 0.22, 0.27).multiplyScalar(0.5);
    shared.uHaze.value.copy(rgb("#1a2433"));
    shared.uZenith.value.copy(rgb("#070b14"));
    shared.uWorldTone.value = 0.62;
  } else {
    shared.uSunLight.value.set(0.86, 0.8, 0.69);
    shared.uSkyLight.value.set(0.46, 0.52, 0.6);
    shared.uEarthLight.value.set(0.25, 0.24, 0.22);
    shared.uHaze.value.copy(rgb("#dfe8ee"));
    shared.uZenith.value.copy(rgb("#8fb8de"));
    shared.uWorldTone.value = 1;
  }
}

/** What fragment shaders begin with. */
export const LIGHT = /* glsl */ `
uniform vec3 uSun, uSunLight, uSkyLight, uEarthLight, uHaze;
uniform vec2 uHazeRange;
vec3 fromSrgb(vec3 c) { return c * c; }
vec3 toSrgb(vec3 c) { return sqrt(min(c, 1.0)); }
/** A matt surface in the sun and under the sky. */
vec3 lit(vec3 colour, vec3 n, float sun) {
  vec3 sky = mix(uEarthLight, uSkyLight, n.z * 0.5 + 0.5);
  return colour * (sky + uSunLight * (max(dot(n, uSun), 0.0) * sun));
}
vec3 hazed(vec3 colour, float away) {
  float h = smoothstep(uHazeRange.x, uHazeRange.y, away);
  return mix(colour, uHaze, h);
}
`;

/** Sun (1) or shadow (0) at a place of the world, for surfaces that do not move. */
export const SHADOW = /* glsl */ `
uniform sampler2D uShadow;
uniform mat4 uShadowFrom;
uniform float uShadowDepth, uShadowFine;
float sunAt(vec3 world) {
  if (uShadowDepth <= 0.0) return 1.0;
  vec3 s = (uShadowFrom * vec4(world, 1.0)).xyz * 0.5 + 0.5;
  if (any(lessThan(s, vec3(0.002))) || any(greaterThan(s, vec3(0.998)))) return 1.0;
  vec2 texel = 1.0 / vec2(textureSize(uShadow, 0));
  vec2 at = s.xy / texel - 0.5;
  vec2 f = fract(at);
  vec2 c = (floor(at) + 0.5) * texel;
  float z = s.z - uShadowDepth;
  if (uShadowFine < 0.5) return step(z, texture2D(uShadow, s.xy).r);
  float a = step(z, texture2D(uShadow, c).r);
  float b = step(z, texture2D(uShadow, c + vec2(texel.x, 0.0)).r);
  float d = step(z, texture2D(uShadow, c + vec2(0.0, texel.y)).r);
  float e = step(z, texture2D(uShadow, c + texel).r);
  return mix(mix(a, b, f.x), mix(d, e, f.x), f.y);
}
`;
