// Metric lines for shaders: on the ground, on terrain, and on the backdrop of views from the side.
//
// There are lines every 1, 10, 100, ... m: the finest that are some pixels apart at the target fade in as one comes
// near, and all fade where they would lie closer than pixels can show.

import type { IUniform } from "three";

/** What `GRID` reads. */
export interface GridUniforms {
  [name: string]: IUniform;
  /** The finest spacing shown, m. */
  uGrid: IUniform<number>;
  /** How much of the finest lines is seen, 0 to 1. */
  uGridFade: IUniform<number>;
  /** How strong all lines are; 0: none. */
  uShowGrid: IUniform<number>;
}

export function gridUniforms(): GridUniforms {
  return { uGrid: { value: 1 }, uGridFade: { value: 0 }, uShowGrid: { value: 1 } };
}

/** The spacing for a picture whose pixel at the target is so wide. Returns the width of the finest, m. */
export function setSpacing(uniforms: GridUniforms, pixel_m: number): number {
  const level = Math.log10(pixel_m * 12);
  const whole = Math.ceil(level);
  uniforms.uGrid.value = 10 ** whole;
  uniforms.uGridFade.value = Math.min(1, (whole - level) * 1.6);
  return 10 ** whole;
}

/** `gridAt(place, width of a pixel)`: how much of a line is there, 0 to 1. */
export const GRID = /* glsl */ `
uniform float uGrid, uGridFade, uShowGrid;
/** How much of a line of a grid so wide covers this pixel, which is \`w\` wide. */
float lines(vec2 at, vec2 w, float spacing, float px) {
  vec2 d = abs(fract(at / spacing - 0.5) - 0.5) * spacing / w;
  vec2 l = clamp(px + 0.5 - d, 0.0, 1.0) * clamp(1.3 - w / spacing * 4.5, 0.0, 1.0);
  return max(l.x, l.y);
}
float gridAt(vec2 at, vec2 w) {
  float fine = lines(at, w, uGrid, 0.5) * uGridFade * 0.34;
  float middle = lines(at, w, uGrid * 10.0, 0.55) * mix(0.4, 0.78, uGridFade);
  float wide = lines(at, w, uGrid * 100.0, 0.75);
  return max(max(fine, middle), wide) * uShowGrid;
}
`;
