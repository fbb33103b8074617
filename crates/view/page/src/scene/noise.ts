// Soft noise that repeats: so that a plain is not one flat colour.

import * as THREE from "three";

const SIZE = 64;

/** A picture of noise, the same at each load; mean about one half. */
export function noise(): THREE.DataTexture {
  const data = new Uint8Array(SIZE * SIZE * 4);
  let state = 12345;
  const random = (): number => ((state = (Math.imul(state, 1664525) + 1013904223) >>> 0) / 2 ** 32);
  const octaves = [octave(5, random), octave(11, random), octave(29, random)] as const;
  for (let y = 0; y < SIZE; y++) {
    for (let x = 0; x < SIZE; x++) {
      const v = octaves[0](x, y) * 0.5 + octaves[1](x, y) * 0.3 + octaves[2](x, y) * 0.2;
      data.fill(Math.round(v * 255), (y * SIZE + x) * 4, (y * SIZE + x) * 4 + 4);
    }
  }
  const t = new THREE.DataTexture(data, SIZE, SIZE);
  t.wrapS = t.wrapT = THREE.RepeatWrapping;
  t.magFilter = THREE.LinearFilter;
  t.minFilter = THREE.LinearMipmapLinearFilter;
  t.generateMipmaps = true;
  t.needsUpdate = true;
  return t;
}

/** Random numbers at so many places a side, smooth between them. */
function octave(cells: number, random: () => number): (x: number, y: number) => number {
  const v = Array.from({ length: cells * cells }, random);
  const s = (t: number): number => t * t * (3 - 2 * t);
  return (x, y) => {
    const [u, w] = [(x / SIZE) * cells, (y / SIZE) * cells];
    const [i, j] = [Math.floor(u), Math.floor(w)];
    const at = (a: number, b: number): number => v[((a + cells) % cells) + ((b + cells) % cells) * cells]!;
    const [f, g] = [s(u - i), s(w - j)];
    return (at(i, j) * (1 - f) + at(i + 1, j) * f) * (1 - g) + (at(i, j + 1) * (1 - f) + at(i + 1, j + 1) * f) * g;
  };
}
