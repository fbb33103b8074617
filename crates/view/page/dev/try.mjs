// Uses the scene by itself as people do, and says what came of it: node dev/try.mjs
import { build } from "esbuild";
import { chromium } from "playwright-core";
import { createServer } from "node:http";
import { readFileSync } from "node:fs";

const built = await build({ entryPoints: ["dev/dev.ts"], bundle: true, format: "esm", write: false, target: "es2022" });
const server = createServer((request, response) => {
  const script = request.url.startsWith("/dev.js");
  response.writeHead(200, { "content-type": script ? "text/javascript" : "text/html" }).end(script ? built.outputFiles[0].text : readFileSync("dev/index.html"));
});
await new Promise((done) => server.listen(0, "127.0.0.1", done));
const browser = await chromium.launch({
  executablePath: "/usr/bin/chromium",
  args: ["--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--disable-quic", "--no-first-run",
    "--disable-background-networking", "--disable-component-update", "--disable-sync"],
});
const page = await browser.newPage({ viewport: { width: 640, height: 400 } });
const faults = [];
page.on("pageerror", (e) => faults.push(e.message));
page.on("console", (m) => m.type() === "error" && !/404/.test(m.text()) && faults.push(m.text()));
await page.goto(`http://127.0.0.1:${server.address().port}/?n=30&flowers=60`);
await page.waitForFunction(() => window.dev);

const drawn = () => page.evaluate(() => window.dev.view.stats().drawn);
const rest = async () => {
  for (let last = -1, now = await drawn(); now !== last; ) {
    last = now;
    await page.waitForTimeout(1200);
    now = await drawn();
  }
};
const camera = () => page.evaluate(() => window.dev.view.camera());
let failed = 0;
const say = (what, ok, more = "") => {
  if (!ok) failed++;
  console.log(ok ? "yes" : "NO ", what, more);
};

await rest();
const still = await drawn();
await page.waitForTimeout(1500);
say("nothing is drawn while nothing changes", (await drawn()) === still);

await page.evaluate(() => window.dev.view.setView("top"));
await rest();
say("the view from the top is flat", (await camera()).flat);
const place = await page.evaluate(() => {
  const { view } = window.dev;
  const p = view.frames.place(9);
  const m = view.view.elements;
  const w = m[3] * p[0] + m[7] * p[1] + m[11] * p[2] + m[15];
  return { x: ((m[0] * p[0] + m[4] * p[1] + m[8] * p[2] + m[12]) / w / 2 + 0.5) * 640, y: (0.5 - (m[1] * p[0] + m[5] * p[1] + m[9] * p[2] + m[13]) / w / 2) * 400 };
});
await page.mouse.click(place.x + 2, place.y + 2);
say("a click picks a vehicle", (await page.evaluate(() => window.dev.told.pick)) === 9, JSON.stringify(await page.evaluate(() => window.dev.told.pick)));
await page.mouse.click(4, 4);
say("a click beside picks nothing", (await page.evaluate(() => window.dev.told.pick)) === null);
await page.mouse.move(place.x, place.y);
await page.waitForTimeout(300);
say("the pointer names a vehicle", /scout-9/.test(await page.evaluate(() => window.dev.told.hover)), await page.evaluate(() => window.dev.told.hover));
await page.evaluate(() => window.dev.view.setCamera({ from: [6, 3, 30], at: [6, 3, 0], flat: true }));
await rest();
await page.mouse.move(320, 200);
await page.mouse.move(321, 200);
await page.waitForTimeout(400);
say("the pointer names a thing of the world", /stone · obstacle/.test(await page.evaluate(() => window.dev.told.hover)), await page.evaluate(() => window.dev.told.hover));

const before = await camera();
await page.mouse.move(320, 200);
await page.mouse.down();
await page.mouse.move(380, 200, { steps: 4 });
await page.mouse.up();
await rest();
const shifted = await camera();
say("dragging in a flat view shifts it", shifted.flat && shifted.at[0] < before.at[0] - 0.5 && Math.abs(shifted.at[2] - before.at[2]) < 1e-3);
await page.mouse.wheel(0, -400);
await rest();
const nearer = await camera();
say("the wheel goes nearer", nearer.from[2] - nearer.at[2] < (shifted.from[2] - shifted.at[2]) * 0.8);
await page.evaluate(() => window.dev.view.setView("orbit"));
await rest();
const orbit = await camera();
await page.mouse.move(320, 200);
await page.mouse.down();
await page.mouse.move(420, 230, { steps: 4 });
await page.mouse.up();
await rest();
const turned = await camera();
say("dragging turns around the target", !turned.flat && Math.hypot(...turned.at.map((x, i) => x - orbit.at[i])) < 1e-3 && Math.hypot(...turned.from.map((x, i) => x - orbit.from[i])) > 0.5);

await page.evaluate(() => {
  window.dev.view.select(9);
  window.dev.view.follow(9);
});
await rest();
await page.evaluate(() => window.dev.goTo(9));
await rest();
const [followed, bee] = await page.evaluate(() => [window.dev.view.camera(), window.dev.view.frames.place(9)]);
say("it follows a vehicle", Math.hypot(...followed.at.map((x, i) => x - bee[i])) < 0.01);
await page.evaluate(() => window.dev.view.follow(null));
const size = await page.evaluate(() => window.dev.view.png({ title: "", rows: [] }).then((b) => [b.type, b.size]));
say("there is a picture", size[0] === "image/png" && size[1] > 20_000, `${size}`);
await page.setViewportSize({ width: 500, height: 500 });
await rest();
say("it takes the size of its host", await page.evaluate(() => Math.abs(window.dev.view.renderer.domElement.clientWidth - 500) < 1 && window.dev.view.renderer.domElement.width >= 250));
await page.evaluate(() => window.dev.view.dispose());
say("it leaves nothing behind", await page.evaluate(() => document.querySelectorAll("canvas").length === 0));
say("no faults", faults.length === 0, faults.join("\n"));
await browser.close();
server.close();
process.exitCode = failed ? 1 : 0;
