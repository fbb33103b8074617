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
  /** Lines on the ground. */
  uLine: THREE.IUniform<THREE.Vector3>;
  /** The ground from within: below the horizon, and cut through in a view from the side. */
  uCut: THREE.IUniform<THREE.Vector3>;
  /** What a shadow leaves of the light on level ground. */
  uShade: THREE.IUniform<THREE.Vector3>;
  /** Rims of small things, that keep them apart from what is behind. */
  uRim: THREE.IUniform<THREE.Vector4>;
  /** Where haze begins, and the way on which it takes all but a third, m from the eye. */
  uHazeRange: THREE.IUniform<THREE.Vector2>;
  /** Width and height of the picture, and the size of a CSS pixel, in its pixels. */
  uViewport: THREE.IUniform<THREE.Vector3>;
  /** Darkens the colours of the world, so that vehicles stand out. */
  uWorldTone: THREE.IUniform<number>;
  /** From the world to the picture. */
  uSee: THREE.IUniform<THREE.Matrix4>;
  /** 1: without perspective. */
  uFlat: THREE.IUniform<number>;
  /** Pieces of the world that begin above this are cut away, m. */
  uCeiling: THREE.IUniform<number>;
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
    uLine: { value: new THREE.Vector3() },
    uCut: { value: new THREE.Vector3() },
    uShade: { value: new THREE.Vector3() },
    uRim: { value: new THREE.Vector4() },
    uHazeRange: { value: new THREE.Vector2(1e4, 2e4) },
    uViewport: { value: new THREE.Vector3(1, 1, 1) },
    uWorldTone: { value: 1 },
    uSee: { value: new THREE.Matrix4() },
    uFlat: { value: 0 },
    uCeiling: { value: 1e9 },
    uClock: { value: 0 },
    uShadow: { value: empty },
    uShadowFrom: { value: new THREE.Matrix4() },
    uShadowDepth: { value: 0 },
    uShadowFine: { value: 1 },
  };
  setTheme(shared, dark);
  return shared;
}

/** What a theme is made of: lights as they are, colours as sRGB. */
interface Theme {
  sun: [number, number, number];
  sky: [number, number, number];
  earth: [number, number, number];
  haze: string;
  zenith: string;
  line: string;
  cut: string;
  rim: [number, number, number, number];
  worldTone: number;
}

const BRIGHT: Theme = {
  sun: [0.86, 0.8, 0.69],
  sky: [0.46, 0.52, 0.6],
  earth: [0.27, 0.26, 0.24],
  haze: "#dbe6ee",
  zenith: "#7fabd6",
  line: "#3c4a46",
  cut: "#b3b9ae",
  rim: [0.02, 0.03, 0.05, 0.75],
  worldTone: 1,
};

const DARK: Theme = {
  sun: [0.36, 0.4, 0.5],
  sky: [0.28, 0.33, 0.44],
  earth: [0.16, 0.17, 0.2],
  haze: "#2a3644",
  zenith: "#0a0f18",
  line: "#7d90a6",
  cut: "#0f141b",
  rim: [0, 0, 0, 0.75],
  worldTone: 0.9,
};

export function setTheme(shared: Shared, dark: boolean): void {
  const { sun, sky, earth, haze, zenith, line, cut, rim, worldTone } = dark ? DARK : BRIGHT;
  shared.uSunLight.value.set(...sun);
  shared.uSkyLight.value.set(...sky);
  shared.uEarthLight.value.set(...earth);
  shared.uHaze.value.copy(rgb(haze));
  shared.uZenith.value.copy(rgb(zenith));
  shared.uLine.value.copy(rgb(line));
  shared.uCut.value.copy(rgb(cut));
  shared.uRim.value.set(...rim);
  shared.uWorldTone.value = worldTone;
  const slope = shared.uSun.value.z;
  const left = sky.map((light, k) => light / (light + sun[k]! * slope)) as Theme["sky"];
  shared.uShade.value.set(...left);
}

/** What fragment shaders begin with. */
export const LIGHT = /* glsl */ `
uniform vec3 uSun, uSunLight, uSkyLight, uEarthLight, uHaze;
uniform vec2 uHazeRange;
uniform float uFlat;
vec3 fromSrgb(vec3 c) { return c * c; }
vec3 toSrgb(vec3 c) { return sqrt(min(c, 1.0)); }
/** A matt surface in the sun and under the sky. */
vec3 lit(vec3 colour, vec3 n, float sun) {
  vec3 sky = mix(uEarthLight, uSkyLight, n.z * 0.5 + 0.5);
  return colour * (sky + uSunLight * (max(dot(n, uSun), 0.0) * sun));
}
vec3 hazed(vec3 colour, float away) {
  return mix(uHaze, colour, exp(min((uHazeRange.x - away) / uHazeRange.y, 0.0)));
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
