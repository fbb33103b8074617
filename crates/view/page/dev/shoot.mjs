// Takes pictures of the scene by itself (dev.ts) into test/out, and measures: node dev/shoot.mjs [part of a name]
import { build } from "esbuild";
import { chromium } from "playwright-core";
import { createServer } from "node:http";
import { mkdirSync, readFileSync, readdirSync } from "node:fs";

const only = process.argv[2] ?? "";
const built = await build({ entryPoints: ["dev/dev.ts"], bundle: true, format: "esm", write: false, target: "es2022", sourcemap: "inline" });
const js = built.outputFiles[0].text;
const server = createServer((request, response) => {
  const js_ = request.url.startsWith("/dev.js");
  if (!js_ && request.url !== "/" && !request.url.startsWith("/?")) return response.writeHead(404).end();
  response.writeHead(200, { "content-type": js_ ? "text/javascript" : "text/html" }).end(js_ ? js : readFileSync("dev/index.html"));
});
await new Promise((done) => server.listen(0, "127.0.0.1", done));
const at = `http://127.0.0.1:${server.address().port}/`;

const own = await chromium.launchServer({
  executablePath: "/usr/bin/chromium",
  args: ["--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--disable-quic", "--no-first-run",
    "--disable-background-networking", "--disable-component-update", "--disable-sync"],
});
const browser = await chromium.connect(own.wsEndpoint());

/** What the browser's graphics process has used of the processors, ms: other programs do not count. */
function graphics_ms() {
  const parents = new Map();
  for (const pid of readdirSync("/proc").filter((d) => /^\d+$/.test(d))) {
    try {
      const fields = readFileSync(`/proc/${pid}/stat`, "utf8").split(") ")[1].split(" ");
      parents.set(Number(pid), { parent: Number(fields[1]), ms: 10 * (Number(fields[11]) + Number(fields[12])) });
    } catch {
      // It has ended.
    }
  }
  const ours = (pid) => pid === own.process().pid || (parents.has(pid) && ours(parents.get(pid).parent));
  for (const [pid, { ms }] of parents) {
    if (ours(pid) && readFileSync(`/proc/${pid}/cmdline`, "utf8").includes("--type=gpu-process")) return ms;
  }
  return NaN;
}

mkdirSync("test/out", { recursive: true });

/** name, address, what to do before the picture. */
const shots = [
  ["hundred", "?n=100", null],
  ["hundred-dark", "?n=100&dark=1", null],
  ["layers", "?n=60", () => {
    const d = window.dev;
    d.view.setLayers({ ...d.layers, labels: true, links: true, wind: true });
    d.view.setLinks(d.links(6));
    d.view.setWind(d.wind());
    d.view.select(9);
    d.view.setDetails(d.details(9, 6));
  }],
  ["layers-dark", "?n=60&dark=1", () => {
    const d = window.dev;
    d.view.setLayers({ ...d.layers, labels: true, links: true, wind: true });
    d.view.setLinks(d.links(6));
    d.view.setWind(d.wind());
    d.view.select(9);
    d.view.setDetails(d.details(9, 6));
  }],
  ["close", "?n=40", () => {
    const d = window.dev;
    d.view.select(9);
    const p = d.frame(6).positions.slice(27, 30);
    d.view.setCamera({ from: [p[0] + 1.1, p[1] - 1.2, p[2] + 0.7], at: [...p], flat: false });
  }],
  ["flowers-close", "?n=40", () => window.dev.view.setCamera({ from: [6.2, -8.4, 1.1], at: [5, -5, 0.2], flat: false })],
  ["yard", "?n=40", () => window.dev.view.setCamera({ from: [4, -9, 2.6], at: [0, 2, 0.8], flat: false })],
  ["top", "?n=100", () => window.dev.view.setView("top")],
  ["south", "?n=100", () => window.dev.view.setView("south")],
  ["ground-brick", "?n=40&ground=brick", null],
  ["ground-grass", "?n=40&ground=grass", null],
  ["ground-dark", "?n=40&ground=stone&dark=1", null],
  ["ten-thousand", "?n=10000", null],
  ["ten-thousand-dark", "?n=10000&dark=1", () => window.dev.view.setColour("speed", "speed", "m/s")],
  ["wide", "?n=300&extent=250&world=none", null],
  ["town", "?n=300&extent=200&world=town", null],
  ["flowers", "?n=100&flowers=100000", null],
  ["hills", "?n=60&world=hills", null],
  ["packets", "?n=100", () => {
    // Half-way between sender and receivers, however long the picture takes.
    const now = performance.now();
    performance.now = () => now;
    window.dev.view.addPackets(window.dev.packets(6, 12), 1);
    performance.now = () => now + 150;
  }],
];

for (const [name, query, act] of shots) {
  if (!name.includes(only)) continue;
  const page = await browser.newPage({ viewport: { width: 1280, height: 760 } });
  page.on("console", (m) => ["error", "warning"].includes(m.type()) && !/GPU stall|404/.test(m.text()) && console.log(name, m.text().slice(0, 600)));
  page.on("pageerror", (e) => console.log(name, "ERROR", e.message));
  await page.goto(at + query);
  await page.waitForFunction(() => window.dev, undefined, { timeout: 60_000 });
  await page.waitForTimeout(700);
  if (act) await page.evaluate(act);
  await page.waitForTimeout(name === "packets" ? 120 : 1500);
  const start = Date.now();
  await page.screenshot({ path: `test/out/${name}.png` });
  const told = await page.evaluate(() => ({ ...window.dev.view.stats(), ...window.dev.told, camera: undefined }));
  console.log(name, `${Date.now() - start} ms`, JSON.stringify(told).slice(0, 300));
  await page.close();
}
if (only === "parts") {
  const page = await browser.newPage({ viewport: { width: 1280, height: 720 } });
  await page.goto(`${at}?n=${process.argv[3] ?? 100}`);
  await page.waitForFunction(() => window.dev, undefined, { timeout: 60_000 });
  await page.waitForTimeout(2500);
  console.log(await page.evaluate(() => window.dev.view.renderer.getContext().getContextAttributes().antialias));
  for (const part of ["none", "ground", "sky", "world", "vehicles", "trails", "all"]) {
    const before = graphics_ms();
    await page.evaluate((part) => {
      const { view } = window.dev;
      view.setRatio(1);
      const gl = view.renderer.getContext();
      const [sky, ground] = view.ground.group.children;
      const all = { sky: [sky], ground: [ground], world: [view.world.group], vehicles: [view.vehicles.group], trails: view.trails.meshes() };
      for (const [name, list] of Object.entries(all)) for (const o of list) o.visible = part === "all" || name === part;
      for (let i = 0; i < 10; i++) {
        view.draw(performance.now());
        gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
      }
    }, part);
    console.log(part, (graphics_ms() - before) / 10, "ms of processor");
  }
}
if (only === "measure") {
  for (const n of [100, 1000, 10000]) {
    const page = await browser.newPage({ viewport: { width: 1280, height: 720 } });
    await page.goto(`${at}?n=${n}`);
    await page.waitForFunction(() => window.dev, undefined, { timeout: 60_000 });
    await page.waitForTimeout(2500);
    for (const ratio of [1, 0.5]) {
    const before = graphics_ms();
    const times = await page.evaluate((ratio) => {
      const { view, goTo } = window.dev;
      const gl = view.renderer.getContext();
      const pixel = new Uint8Array(4);
        const list = [];
        view.setRatio(ratio);
        for (let i = 0; i < 12; i++) {
          goTo(7 + (ratio === 1 ? 0 : 1) + i * 0.03);
          const start = performance.now();
          view.draw(start);
          gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
          list.push(performance.now() - start);
        }
        list.sort((a, b) => a - b);
      const { calls, triangles } = view.renderer.info.render;
      return { least: Math.round(list[0]), median: Math.round(list[6]), calls, triangles };
    }, ratio);
    const cpu = Math.round((graphics_ms() - before) / 12);
    console.log(`${n} vehicles, ${1280 * ratio} x ${720 * ratio}: ${cpu} ms of processor a picture,`, JSON.stringify(times));
    }
    await page.close();
  }
}
await browser.close();
await own.close();
server.close();
