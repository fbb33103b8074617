// Surfaces: the built-in pictures, painted here on a canvas, and picture files of the world.

import * as THREE from "three";

export interface Surface {
  texture: THREE.Texture;
  /** The width of one picture on the surface, m. */
  tile_m: number;
  /** 1 as soon as it can be seen. */
  ready: THREE.IUniform<number>;
}

const SIZE = 256;
const FILE_TILE_M = 2;

type Paint = (c: CanvasRenderingContext2D, random: () => number) => void;

/** Numbers from 0 to 1, the same at each load. */
function chance(seed: number): () => number {
  let s = seed >>> 0;
  return () => {
    s = (s + 0x6d2b79f5) >>> 0;
    let t = Math.imul(s ^ (s >>> 15), 1 | s);
    t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
    return ((t ^ (t >>> 14)) >>> 0) / 2 ** 32;
  };
}

const shade = (r: number, g: number, b: number, by: number): string =>
  `rgb(${Math.round(r * by)} ${Math.round(g * by)} ${Math.round(b * by)})`;

function fill(c: CanvasRenderingContext2D, colour: string): void {
  c.fillStyle = colour;
  c.fillRect(0, 0, SIZE, SIZE);
}

/** Many small marks, wrapped around the edges so that the picture repeats without a seam. */
function speckle(random: () => number, n: number, mark: (x: number, y: number) => void): void {
  for (let i = 0; i < n; i++) {
    const [x, y] = [random() * SIZE, random() * SIZE];
    for (const dx of [0, -SIZE, SIZE]) {
      for (const dy of [0, -SIZE, SIZE]) {
        if (Math.abs(x + dx - SIZE / 2) < SIZE * 0.75 && Math.abs(y + dy - SIZE / 2) < SIZE * 0.75) mark(x + dx, y + dy);
      }
    }
  }
}

const PAINTINGS: Record<string, [tile_m: number, paint: Paint]> = {
  brick: [
    1,
    (c, random) => {
      fill(c, "#b9b0a3");
      const [rows, columns] = [8, 4];
      const [h, w] = [SIZE / rows, SIZE / columns];
      for (let row = 0; row < rows; row++) {
        for (let column = 0; column < columns; column++) {
          const x = column * w + (row % 2 ? w / 2 : 0);
          c.fillStyle = shade(168, 84, 62, 0.82 + 0.32 * random());
          for (const at of [x, x - SIZE]) c.fillRect(at + 2, row * h + 2, w - 4, h - 4);
        }
      }
    },
  ],
  grass: [
    3,
    (c, random) => {
      fill(c, "#5d8c3f");
      for (let i = 0; i < 3; i++) {
        speckle(random, 1600, (x, y) => {
          c.strokeStyle = shade(104 - 14 * i, 152 - 10 * i, 66, 0.65 + 0.5 * ((x * 7 + y * 13) % 1));
          c.beginPath();
          c.moveTo(x, y);
          c.lineTo(x + 3 - ((x * 3.1) % 6), y - 7);
          c.stroke();
        });
      }
    },
  ],
  metal: [
    2,
    (c, random) => {
      fill(c, "#a9b0b6");
      for (let y = 0; y < SIZE; y++) {
        c.fillStyle = `rgb(255 255 255 / ${0.12 * random()})`;
        c.fillRect(0, y, SIZE, 1);
      }
      c.fillStyle = "#7f868c";
      for (const x of [0, SIZE / 2]) c.fillRect(x, 0, 3, SIZE);
      c.fillRect(0, 0, SIZE, 3);
    },
  ],
  sky: [
    40,
    (c, random) => {
      fill(c, "#8fc0ea");
      speckle(random, 60, (x, y) => {
        const g = c.createRadialGradient(x, y, 0, x, y, 34);
        g.addColorStop(0, "rgb(255 255 255 / 0.35)");
        g.addColorStop(1, "rgb(255 255 255 / 0)");
        c.fillStyle = g;
        c.fillRect(x - 34, y - 34, 68, 68);
      });
    },
  ],
  stone: [
    2,
    (c, random) => {
      fill(c, "#6e6a64");
      const n = 6;
      const w = SIZE / n;
      for (let j = 0; j < n; j++) {
        for (let i = 0; i < n; i++) {
          c.fillStyle = shade(158, 153, 144, 0.78 + 0.36 * random());
          const x = i * w + (j % 2 ? w / 2 : 0) + 2 * random();
          for (const at of [x, x - SIZE]) {
            c.beginPath();
            c.roundRect(at + 2, j * w + 2, w - 4 - 4 * random(), w - 4, 9);
            c.fill();
          }
        }
      }
      speckle(random, 900, (x, y) => {
        c.fillStyle = "rgb(0 0 0 / 0.08)";
        c.fillRect(x, y, 2, 2);
      });
    },
  ],
  tree: [
    1.5,
    (c, random) => {
      fill(c, "#2f5a2a");
      for (let i = 0; i < 4; i++) {
        speckle(random, 420, (x, y) => {
          c.fillStyle = shade(70 + 14 * i, 118 + 16 * i, 52, 0.6 + 0.14 * i);
          c.beginPath();
          c.ellipse(x, y, 6, 3.4, (x * y) % Math.PI, 0, 6.3);
          c.fill();
        });
      }
    },
  ],
  wood: [
    1,
    (c, random) => {
      fill(c, "#a8774a");
      const planks = 4;
      const h = SIZE / planks;
      for (let p = 0; p < planks; p++) {
        c.fillStyle = shade(174, 126, 80, 0.84 + 0.26 * random());
        c.fillRect(0, p * h, SIZE, h - 2);
        for (let i = 0; i < 9; i++) {
          c.strokeStyle = `rgb(70 40 15 / ${0.12 + 0.16 * random()})`;
          const y = p * h + h * random();
          const bend = 4 * random();
          c.beginPath();
          c.moveTo(0, y);
          c.bezierCurveTo(SIZE / 3, y + bend, (2 * SIZE) / 3, y - bend, SIZE, y);
          c.stroke();
        }
        c.fillStyle = "#5f3f22";
        c.fillRect(0, (p + 1) * h - 2, SIZE, 2);
      }
    },
  ],
};

export class Textures {
  private known = new Map<string, Surface | null>();

  constructor(private changed: () => void) {}

  /** By name: built in (`brick`, `grass_1`), or a file of the world; null for none. */
  get(name: string): Surface | null {
    if (name === "") return null;
    let surface = this.known.get(name);
    if (surface === undefined) this.known.set(name, (surface = this.make(name)));
    return surface;
  }

  dispose(): void {
    for (const s of this.known.values()) s?.texture.dispose();
  }

  private make(name: string): Surface | null {
    const [, kind, number] = /^([a-z]+?)(?:_(\d+))?$/.exec(name) ?? [];
    const painting = kind === undefined ? undefined : PAINTINGS[kind];
    const ready = { value: painting ? 1 : 0 };
    const texture = painting ? this.paint(painting[1], Number(number ?? 0)) : this.load(name, ready);
    texture.wrapS = texture.wrapT = THREE.RepeatWrapping;
    texture.minFilter = THREE.LinearMipmapLinearFilter;
    texture.generateMipmaps = true;
    texture.anisotropy = 4;
    return { texture, tile_m: painting ? painting[0] : FILE_TILE_M, ready };
  }

  private paint(paint: Paint, seed: number): THREE.Texture {
    const canvas = document.createElement("canvas");
    canvas.width = canvas.height = SIZE;
    const c = canvas.getContext("2d");
    if (c) paint(c, chance(seed + 7));
    return new THREE.CanvasTexture(canvas);
  }

  /** Until the file has come there is the colour alone; for ever, if it does not come. */
  private load(name: string, ready: THREE.IUniform<number>): THREE.Texture {
    const texture = new THREE.Texture();
    const image = new Image();
    image.onload = () => {
      texture.image = image;
      texture.needsUpdate = true;
      ready.value = 1;
      this.changed();
    };
    const token = new URLSearchParams(location.search).get("token");
    const path = name.split("/").map(encodeURIComponent).join("/");
    image.src = `textures/${path}${token ? `?token=${encodeURIComponent(token)}` : ""}`;
    return texture;
  }
}
