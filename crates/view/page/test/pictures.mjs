// Compares a picture of the page with one that is kept. Renderers differ in single pixels, so what is compared are
// means of blocks. ACCEPT=1 keeps the new one.
import assert from "node:assert/strict";
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { PATIENCE_MS, here } from "./browser.mjs";

/** Pixels of a block on each side. */
const BLOCK = 8;
/** Mean difference of all blocks, of 255. */
const MEAN_MAX = 4;
/** Share of blocks that may differ by more than `BLOCK_MAX`. */
const OTHER_MAX = 0.02;
const BLOCK_MAX = 40;

/** The picture of the scene alone is as that in `pictures/NAME.png`. */
export async function compare(page, name) {
  const file = here(`pictures/${name}.png`);
  const seen = await page.locator("#scene").screenshot({ timeout: PATIENCE_MS, animations: "disabled" });
  if (process.env.ACCEPT) {
    mkdirSync(here("pictures"), { recursive: true });
    writeFileSync(file, seen);
    return;
  }
  const wrong = await verdict(page, readFileSync(file), seen);
  if (wrong !== "") {
    const now = here(`pictures/${name}.new.png`);
    writeFileSync(now, seen);
    assert.fail(`the picture differs (${wrong}): look at ${now}`);
  }
}

/** In what two PNGs differ by more than the tolerance; empty if they do not. */
export async function verdict(page, a, b) {
  const { size, mean, other } = await difference(page, a, b);
  if (size !== "") return size;
  if (mean > MEAN_MAX) return `mean ${mean.toFixed(1)}`;
  return other > OTHER_MAX ? `${(100 * other).toFixed(1)} % of blocks` : "";
}

export function kept(name) {
  return readFileSync(here(`pictures/${name}.png`));
}

/** How much two PNGs differ; the browser decodes them. */
export async function difference(page, a, b) {
  const blank = await page.context().browser().newPage();
  try {
    return await blank.evaluate(measure, { a: a.toString("base64"), b: b.toString("base64"), block: BLOCK, most: BLOCK_MAX });
  } finally {
    await blank.close();
  }
}

/** The pixels of a PNG: red, green, blue, opacity each. */
export async function pixels(page, png) {
  const { width, height, data } = await page.evaluate(async (text) => {
    const image = new Image();
    image.src = `data:image/png;base64,${text}`;
    await image.decode();
    const canvas = document.createElement("canvas");
    [canvas.width, canvas.height] = [image.width, image.height];
    const c = canvas.getContext("2d");
    c.drawImage(image, 0, 0);
    const { data } = c.getImageData(0, 0, image.width, image.height);
    let bytes = "";
    for (const byte of data) bytes += String.fromCharCode(byte);
    return { width: image.width, height: image.height, data: btoa(bytes) };
  }, png.toString("base64"));
  return { width, height, data: Buffer.from(data, "base64") };
}

/** Runs in the browser. */
async function measure({ a, b, block, most }) {
  const pixels = async (text) => {
    const image = new Image();
    image.src = `data:image/png;base64,${text}`;
    await image.decode();
    const canvas = document.createElement("canvas");
    canvas.width = image.width;
    canvas.height = image.height;
    const c = canvas.getContext("2d");
    c.drawImage(image, 0, 0);
    return c.getImageData(0, 0, image.width, image.height);
  };
  const [one, two] = [await pixels(a), await pixels(b)];
  if (one.width !== two.width || one.height !== two.height) {
    return { size: `${two.width} by ${two.height} in place of ${one.width} by ${one.height}`, mean: 0, other: 0 };
  }
  let sum = 0;
  let blocks = 0;
  let others = 0;
  for (let y = 0; y + block <= one.height; y += block) {
    for (let x = 0; x + block <= one.width; x += block) {
      const means = [one, two].map((image) => {
        const mean = [0, 0, 0];
        for (let v = y; v < y + block; v += 1) {
          for (let u = x; u < x + block; u += 1) {
            for (let k = 0; k < 3; k += 1) mean[k] += image.data[4 * (v * image.width + u) + k] / (block * block);
          }
        }
        return mean;
      });
      const differs = means[0].reduce((all, value, k) => all + Math.abs(value - means[1][k]) / 3, 0);
      sum += differs;
      blocks += 1;
      if (differs > most) others += 1;
    }
  }
  return { size: "", mean: sum / blocks, other: others / blocks };
}
