// Opens a recording in Foxglove Studio 1.48, the last that is open source, with the layout of the book, takes a
// picture, and counts what of it the vehicles and the world are.
//
//   npm install
//   node foxglove.mjs RUN.mcap PICTURE.png [PART-OF-THE-TIME-LINE, 0 to 1]
//
// CHROMIUM names the browser, /usr/bin/chromium if it is not said. Nothing is fetched from elsewhere: the page is
// served on loopback from node_modules.
import fs from "node:fs";
import http from "node:http";
import path from "node:path";
import { chromium } from "playwright-core";

const here = import.meta.dirname ?? path.dirname(new URL(import.meta.url).pathname);
const [, , recording, picture, part = "0.5"] = process.argv;
if (!recording || !picture || !(part >= 0 && part <= 1)) {
  console.error("usage: node foxglove.mjs RUN.mcap PICTURE.png [PART, 0 to 1]");
  process.exit(2);
}
const modules = path.join(here, "node_modules");
const files = {
  "/": path.join(here, "foxglove.html"),
  "/run.mcap": recording,
  "/layout.json": path.join(here, "../../docs/book/src/foxglove-layout.json"),
  "/react.js": path.join(modules, "react/umd/react.production.min.js"),
  "/react-dom.js": path.join(modules, "react-dom/umd/react-dom.production.min.js"),
};
const kinds = { ".html": "text/html", ".js": "text/javascript", ".wasm": "application/wasm", ".json": "application/json" };

const server = http.createServer((request, response) => {
  const name = new URL(request.url, "http://localhost").pathname;
  // Chunks and workers of the page lie where it does, or among its assets.
  const file = files[name] ?? path.join(modules, "@foxglove/studio-base/assets", path.basename(name));
  if (!fs.existsSync(file)) return response.writeHead(404).end();
  const size = fs.statSync(file).size;
  const head = { "content-type": kinds[path.extname(file)] ?? "application/octet-stream", "accept-ranges": "bytes" };
  const range = /bytes=(\d+)-(\d*)/.exec(request.headers.range ?? "");
  const start = range ? Number(range[1]) : 0;
  const end = range?.[2] ? Math.min(Number(range[2]), size - 1) : size - 1;
  if (range) head["content-range"] = `bytes ${start}-${end}/${size}`;
  response.writeHead(range ? 206 : 200, { ...head, "content-length": end - start + 1 });
  if (request.method === "HEAD") return response.end();
  fs.createReadStream(file, { start, end }).pipe(response);
});
await new Promise((ready) => server.listen(0, "127.0.0.1", ready));
const home = `http://127.0.0.1:${server.address().port}/`;

const browser = await chromium.launch({
  executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
  args: ["--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist"],
});

// A picture of the page without some topics, and what it complained of.
async function shot(without) {
  const page = await browser.newPage({ viewport: { width: 1400, height: 860 } });
  const errors = [];
  page.on("pageerror", (error) => errors.push(String(error)));
  const query = new URLSearchParams(without.map((topic) => ["without", topic]));
  await page.goto(`${home}?${query}`);
  await page.getByText("/poses", { exact: true }).waitFor({ timeout: 120_000 });
  await page.waitForTimeout(8_000);
  await page.mouse.click(8 + part * 1384, 804);
  await page.mouse.click(1151, 58);
  await page.mouse.click(25, 25);
  await page.mouse.move(300, 400);
  await page.waitForTimeout(8_000);
  const bytes = await page.screenshot();
  await page.close();
  return { bytes, errors };
}

// How many pixels of two pictures differ.
async function differ(a, b) {
  const page = await browser.newPage();
  const count = await page.evaluate(async (pictures) => {
    const [a, b] = await Promise.all(pictures.map(async (picture) => {
      const image = await createImageBitmap(await (await fetch(`data:image/png;base64,${picture}`)).blob());
      const pen = new OffscreenCanvas(image.width, image.height).getContext("2d");
      pen.drawImage(image, 0, 0);
      return new Uint32Array(pen.getImageData(0, 0, image.width, image.height).data.buffer);
    }));
    return a.reduce((sum, pixel, at) => sum + (pixel === b[at] ? 0 : 1), 0);
  }, [a, b].map((picture) => picture.toString("base64")));
  await page.close();
  return count;
}

const whole = await shot([]);
fs.writeFileSync(picture, whole.bytes);
let failed = whole.errors.length > 0;
for (const error of whole.errors) console.log(`the page complains: ${error}`);
for (const [what, topics] of [["vehicles", ["/poses", "/poses/points"]], ["world", ["/world"]]]) {
  const pixels = await differ(whole.bytes, (await shot(topics)).bytes);
  // Fewer may be a blinking cursor.
  const seen = pixels >= 100;
  failed ||= !seen;
  console.log(`${what}: ${pixels} pixels${seen ? "" : ": NOT SEEN"}`);
}
console.log(`the picture is ${picture}: look at it`);
await browser.close();
server.close();
process.exit(failed ? 1 : 0);
