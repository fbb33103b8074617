// The ground: the plane z = 0 without end, in the world's colour or with its picture, with metric lines.

import * as THREE from "three";
import type { Orbit } from "./camera";
import { colourOf } from "./colours";
import { GRID, setSpacing, type GridUniforms } from "./grid";
import { LIGHT, SHADOW, type Shared } from "./light";
import { noise } from "./noise";
import type { Surface } from "./textures";
import { TONE, type ToneUniforms } from "./tone";

const VERTEX = /* glsl */ `
uniform vec3 uCentre;
uniform mat4 uSee;
uniform float uFlat;
varying vec2 vAt;
varying float vAway;
void main() {
  vec3 world = vec3(position.xy * uCentre.z + uCentre.xy, 0.0);
  vAt = world.xy;
  gl_Position = uSee * vec4(world, 1.0);
  vAway = uFlat > 0.5 ? 0.0 : gl_Position.w;
}
`;

const FRAGMENT = /* glsl */ `
${LIGHT}
${SHADOW}
${TONE}
${GRID}
uniform vec3 uColour, uLine, uViewport, uShade;
uniform float uWorldRadius, uAxis, uTile, uReady;
uniform sampler2D uNoise, uTexture;
varying vec2 vAt;
varying float vAway;
void main() {
  vec3 own = uColour;
  float detail = 0.0;
  #ifdef TEXTURED
  // Twice, at widths that do not divide each other: the eye finds no tiles.
  vec3 picture = mix(texture2D(uTexture, vAt / uTile).rgb, texture2D(uTexture, vAt / (uTile * 7.3)).rgb, 0.35);
  own = mix(own, picture, uReady);
  // What is lighter or darker than the picture as a whole stays so, however much hues are toned down.
  vec3 whole = textureLod(uTexture, vec2(0.5), 16.0).rgb;
  detail = dot(picture - whole, vec3(0.3, 0.6, 0.1)) * uReady;
  #endif
  vec2 w = max(fwidth(vAt), 1e-9) * uViewport.z;
  float wide = max(w.x, w.y);
  float patches = texture2D(uNoise, vAt / 61.0).r + texture2D(uNoise, vAt.yx / 407.0).r - 1.0;
  vec3 base = toned(own);
  float r = length(vAt);
  // The world ends: beyond it the ground pales, and has no lines.
  float beyond = smoothstep(uWorldRadius, uWorldRadius * 1.15, r);
  base = mix(base * (1.0 + 0.045 * patches + 0.8 * detail), vec3(dot(base, vec3(0.3, 0.6, 0.1))), beyond * 0.5);
  // Where the sun shines it is as light as the theme has it.
  vec3 colour = fromSrgb(base) * mix(uShade, vec3(1.0), sunAt(vec3(vAt, 0.0)));
  float line = gridAt(vAt, w) * (1.0 - beyond);
  colour = mix(colour, uLine, line * 0.5);
  if (uShowGrid > 0.0) {
    // East and north from the origin, as far as there is anything.
    vec2 arm = clamp(1.2 - abs(vAt.yx) / w.yx, 0.0, 1.0) * (1.0 - smoothstep(0.3, 1.0, abs(vAt) / uAxis)) * step(0.0, vAt) * 0.6;
    colour = mix(colour, vec3(0.62, 0.11, 0.09), arm.x);
    colour = mix(colour, vec3(0.06, 0.34, 0.14), arm.y);
    float edge = clamp(1.5 - abs(r - uWorldRadius) / wide, 0.0, 1.0);
    colour = mix(colour, uLine, edge * 0.3);
  }
  gl_FragColor = vec4(toSrgb(hazed(colour, vAway)), 1.0);
}
`;

export class Ground {
  readonly mesh: THREE.Mesh<THREE.PlaneGeometry, THREE.ShaderMaterial>;
  private own;
  private noise = noise();

  constructor(colour: string, surface: Surface | null, plane: boolean, worldRadius_m: number, shared: Shared, private grid: GridUniforms, tone: ToneUniforms) {
    const [r, g, b] = colourOf(colour);
    this.own = {
      uColour: { value: new THREE.Vector3(r / 255, g / 255, b / 255) },
      uWorldRadius: { value: worldRadius_m },
      uNoise: { value: this.noise },
      uCentre: { value: new THREE.Vector3() },
      uAxis: { value: 10 },
    };
    const material = new THREE.ShaderMaterial({
      vertexShader: VERTEX,
      fragmentShader: FRAGMENT,
      defines: surface ? { TEXTURED: 1 } : {},
      uniforms: {
        ...shared,
        ...grid,
        ...tone,
        ...this.own,
        uTexture: { value: surface?.texture ?? null },
        uReady: surface?.ready ?? { value: 0 },
        uTile: { value: surface?.tile_m ?? 1 },
      },
      side: THREE.DoubleSide,
      polygonOffset: true,
      polygonOffsetFactor: 1,
      polygonOffsetUnits: 8,
    });
    this.mesh = new THREE.Mesh(new THREE.PlaneGeometry(2, 2, 8, 8), material);
    this.mesh.frustumCulled = false;
    this.mesh.visible = plane;
    this.mesh.renderOrder = 1;
  }

  showGrid(on: boolean): void {
    this.grid.uShowGrid.value = on ? 1 : 0;
  }

  /** Before each picture: so far around the target, and the axes as long as there is anything. */
  update(orbit: Orbit, far_m: number, content_m: number): void {
    const target = orbit.target();
    this.own.uCentre.value.set(target[0], target[1], far_m);
    this.own.uAxis.value = content_m;
    setSpacing(this.grid, orbit.pixel());
  }

  dispose(): void {
    this.noise.dispose();
    this.mesh.geometry.dispose();
    this.mesh.material.dispose();
  }
}
