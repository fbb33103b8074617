// Ground with a metric grid, and the sky.
//
// The grid has lines every 1, 10, 100, ... m: the finest that are some pixels apart at the target fade in as one comes
// near.

import * as THREE from "three";
import type { Orbit } from "./camera";
import { colourOf, linear } from "./colours";
import { LIGHT, SHADOW, type Shared } from "./light";

/** Metric lines; on terrain too. */
export const GRID = /* glsl */ `
uniform vec3 uLine, uViewport;
uniform float uGrid, uGridFade, uShowGrid;
/** How much of a line of a grid so wide covers this pixel, which is \`w\` wide. */
float lines(vec2 at, vec2 w, float spacing, float px) {
  vec2 d = abs(fract(at / spacing - 0.5) - 0.5) * spacing / w;
  vec2 l = clamp(px + 0.5 - d, 0.0, 1.0) * clamp(1.4 - w / spacing * 3.5, 0.0, 1.0);
  return max(l.x, l.y);
}
float gridAt(vec2 at, vec2 w) {
  float fine = lines(at, w, uGrid, 0.5) * uGridFade * 0.18;
  float middle = lines(at, w, uGrid * 10.0, 0.6) * mix(0.22, 0.36, uGridFade);
  float wide = lines(at, w, uGrid * 100.0, 0.9) * 0.42;
  return max(max(fine, middle), wide);
}
`;

const GROUND_VERTEX = /* glsl */ `
uniform vec3 uCentre;
uniform mat4 uSee;
varying vec2 vAt;
varying float vAway;
void main() {
  vec3 world = vec3(position.xy * uCentre.z + uCentre.xy, 0.0);
  vAt = world.xy;
  gl_Position = uSee * vec4(world, 1.0);
  vAway = isOrthographic ? 0.0 : gl_Position.w;
}
`;

const GROUND_FRAGMENT = /* glsl */ `
${LIGHT}
${SHADOW}
uniform vec3 uColour;
uniform float uWorldTone, uWorldRadius;
uniform sampler2D uNoise;
varying vec2 vAt;
varying float vAway;
${GRID}
void main() {
  vec3 base = uColour * (uWorldTone * (0.88 + 0.24 * texture2D(uNoise, vAt / 61.0).r));
  vec2 w = max(fwidth(vAt), 1e-9) * uViewport.z;
  float r = length(vAt);
  // Beyond the edge of the world the ground pales.
  bool beyond = r > uWorldRadius;
  if (beyond) base = mix(base, vec3(dot(base, vec3(0.3, 0.6, 0.1)) * 0.75), 0.6);
  vec3 colour = lit(base, vec3(0.0, 0.0, 1.0), sunAt(vec3(vAt, 0.0)));
  if (uShowGrid > 0.0) {
    float line = gridAt(vAt, w);
    colour = mix(colour, uLine, beyond ? line * 0.4 : line);
    vec2 axis = clamp(1.4 - abs(vAt.yx) / w.yx, 0.0, 1.0) * 0.55;
    colour = mix(colour, vec3(0.75, 0.16, 0.1), axis.x);
    colour = mix(colour, vec3(0.1, 0.42, 0.16), axis.y);
  }
  float edge = clamp(1.6 - abs(r - uWorldRadius) / max(w.x, w.y), 0.0, 1.0);
  colour = mix(colour, uLine, edge * 0.6);
  gl_FragColor = vec4(toSrgb(hazed(colour, vAway)), 1.0);
}
`;

const SKY_VERTEX = /* glsl */ `
varying vec2 vScreen;
void main() { vScreen = position.xy; gl_Position = vec4(position.xy, 0.999999, 1.0); }
`;

const SKY_FRAGMENT = /* glsl */ `
${LIGHT}
uniform vec3 uZenith, uBack, uRight, uUp, uColour;
uniform float uWorldTone, uTargetHeight, uHalfHeight, uPlane;
uniform vec2 uTan;
varying vec2 vScreen;
void main() {
  vec3 colour;
  if (isOrthographic) {
    // From the side there is no horizon but the ground, cut through.
    float z = uTargetHeight + vScreen.y * uHalfHeight;
    float side = 1.0 - smoothstep(0.02, 0.1, abs(uBack.z));
    colour = mix(uHaze, uZenith, 0.35 * clamp(vScreen.y * 0.5 + 0.5, 0.0, 1.0));
    if (z < 0.0 && uPlane > 0.0) colour = mix(colour, uColour * uWorldTone * 0.5, side);
  } else {
    vec3 d = normalize(-uBack + uRight * vScreen.x * uTan.x + uUp * vScreen.y * uTan.y);
    float h = clamp(d.z, 0.0, 1.0);
    float g = 1.0 - h;
    colour = mix(uZenith, uHaze, g * g * g);
    float s = max(dot(d, uSun), 0.0);
    s *= s;
    s *= s;
    colour += uSunLight * (0.16 * s * s);
  }
  gl_FragColor = vec4(toSrgb(colour), 1.0);
}
`;

/** Soft noise that repeats, mean about one half: so that a plain is not one flat colour. */
function noise(): THREE.DataTexture {
  const n = 64;
  const data = new Uint8Array(n * n * 4);
  let state = 12345;
  const random = (): number => ((state = (Math.imul(state, 1664525) + 1013904223) >>> 0) / 2 ** 32);
  const grid = (cells: number): ((x: number, y: number) => number) => {
    const v = Array.from({ length: cells * cells }, random);
    const s = (t: number): number => t * t * (3 - 2 * t);
    return (x, y) => {
      const [u, w] = [(x / n) * cells, (y / n) * cells];
      const [i, j] = [Math.floor(u), Math.floor(w)];
      const at = (a: number, b: number): number => v[((a + cells) % cells) + ((b + cells) % cells) * cells]!;
      const [f, g] = [s(u - i), s(w - j)];
      return (at(i, j) * (1 - f) + at(i + 1, j) * f) * (1 - g) + (at(i, j + 1) * (1 - f) + at(i + 1, j + 1) * f) * g;
    };
  };
  const octaves = [grid(5), grid(11), grid(29)];
  for (let y = 0; y < n; y++) {
    for (let x = 0; x < n; x++) {
      const v = octaves[0]!(x, y) * 0.5 + octaves[1]!(x, y) * 0.3 + octaves[2]!(x, y) * 0.2;
      data.fill(Math.round(v * 255), (y * n + x) * 4, (y * n + x) * 4 + 4);
    }
  }
  const t = new THREE.DataTexture(data, n, n);
  t.wrapS = t.wrapT = THREE.RepeatWrapping;
  t.magFilter = THREE.LinearFilter;
  t.minFilter = THREE.LinearMipmapLinearFilter;
  t.generateMipmaps = true;
  t.needsUpdate = true;
  return t;
}

export class Ground {
  readonly group = new THREE.Group();
  /** Also those of `GRID`. */
  readonly uniforms;
  private noise = noise();
  private ground: THREE.Mesh;

  constructor(colour: string, plane: boolean, worldRadius_m: number, shared: Shared) {
    const [r, g, b] = colourOf(colour);
    this.uniforms = {
      ...shared,
      uColour: { value: new THREE.Vector3(linear(r), linear(g), linear(b)) },
      uLine: { value: new THREE.Vector3() },
      uGrid: { value: 1 },
      uGridFade: { value: 0 },
      uShowGrid: { value: 1 },
      uWorldRadius: { value: worldRadius_m },
      uNoise: { value: this.noise },
      uCentre: { value: new THREE.Vector3() },
      uBack: { value: new THREE.Vector3() },
      uRight: { value: new THREE.Vector3() },
      uUp: { value: new THREE.Vector3() },
      uTan: { value: new THREE.Vector2() },
      uTargetHeight: { value: 0 },
      uHalfHeight: { value: 1 },
      uPlane: { value: plane ? 1 : 0 },
    };
    const square = new THREE.PlaneGeometry(2, 2, 8, 8);
    this.ground = new THREE.Mesh(
      square,
      new THREE.ShaderMaterial({
        vertexShader: GROUND_VERTEX,
        fragmentShader: GROUND_FRAGMENT,
        uniforms: this.uniforms,
        side: THREE.DoubleSide,
        polygonOffset: true,
        polygonOffsetFactor: 1,
        polygonOffsetUnits: 8,
      }),
    );
    this.ground.frustumCulled = false;
    this.ground.visible = plane;
    this.ground.renderOrder = 1;
    const sky = new THREE.Mesh(
      new THREE.PlaneGeometry(2, 2),
      new THREE.ShaderMaterial({
        vertexShader: SKY_VERTEX,
        fragmentShader: SKY_FRAGMENT,
        uniforms: this.uniforms,
        depthWrite: false,
      }),
    );
    sky.frustumCulled = false;
    // Last of what hides: only where nothing else is.
    sky.renderOrder = 4;
    this.group.add(sky, this.ground);
  }

  setDark(dark: boolean): void {
    this.uniforms.uLine.value.setScalar(dark ? 0.3 : 0.02);
  }

  showGrid(on: boolean): void {
    this.uniforms.uShowGrid.value = on ? 1 : 0;
  }

  /** Before each picture. Returns the width of the finest grid shown, m. */
  update(orbit: Orbit, far_m: number): number {
    const [back, right, up] = orbit.axes();
    const u = this.uniforms;
    u.uBack.value.set(...back);
    u.uRight.value.set(...right);
    u.uUp.value.set(...up);
    const lens = orbit.lens();
    u.uTan.value.set(lens.tan * lens.aspect, lens.tan);
    const target = orbit.target();
    u.uTargetHeight.value = target[2];
    u.uHalfHeight.value = (orbit.pixel() * u.uViewport.value.y) / u.uViewport.value.z / 2;
    u.uCentre.value.set(target[0], target[1], far_m);
    const level = Math.log10(orbit.pixel() * 11);
    const whole = Math.ceil(level);
    u.uGrid.value = 10 ** whole;
    u.uGridFade.value = Math.min(1, (whole - level) * 1.6);
    return 10 ** whole;
  }

  dispose(): void {
    this.noise.dispose();
    this.group.traverse((o) => {
      if (o instanceof THREE.Mesh) {
        o.geometry.dispose();
        (o.material as THREE.Material).dispose();
      }
    });
  }
}
