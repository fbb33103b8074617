// What pictures cost: how much is asked of the graphics card, which is counted, not timed; and that nothing is asked
// for nothing. `node dev/cost.mjs` prints the numbers, and times.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { fly, prepare, serveScene, watch } from "../dev/harness.mjs";
import { PATIENCE_MS, launch, open, scenario, serve, stands } from "./browser.mjs";

let browser, scene;

before(async () => {
  browser = await launch();
  scene = await serveScene();
});
after(async () => {
  scene?.close();
  await browser?.close();
});

/** What pictures cost from each of these places; `null`: from where the scene is first seen. */
async function costOf(vehicles, pictures, places = [null]) {
  const page = await browser.newPage({ viewport: { width: 1000, height: 640 } });
  const faults = [];
  page.on("pageerror", (error) => faults.push(String(error)));
  await page.addInitScript(watch, true);
  await page.goto(`${scene.url}?n=${vehicles}`);
  await page.waitForFunction(() => window.dev, undefined, { timeout: PATIENCE_MS });
  await prepare(page, 8);
  const costs = [];
  for (const from of places) {
    if (from) await page.evaluate((from) => window.dev.view.setCamera({ from, at: [0, 0, 10], flat: false }), from);
    const list = await fly(page, pictures, 5);
    const most = (key) => Math.max(...list.map((picture) => picture[key]));
    costs.push({ calls: most("calls"), triangles: most("triangles"), bytes: list.reduce((sum, picture) => sum + picture.bytes, 0) / list.length });
  }
  await page.close();
  assert.deepEqual(faults, []);
  return costs;
}

test("ten thousand vehicles with trails, links, packets and beams are few draw calls, from afar and from within", async () => {
  for (const { calls, triangles, bytes } of await costOf(10_000, 60, [null, [6, 0, 12]])) {
    assert.ok(calls > 5 && calls < 60, `${calls} draw calls`);
    assert.ok(triangles > 20_000 && triangles < 500_000, `${triangles} triangles`);
    assert.ok(bytes < 400 * 1024, `${bytes} bytes a picture`);
  }
});

test("a hundred thousand vehicles are no more draw calls than a hundred, and two triangles each", async () => {
  const [few] = await costOf(100, 20);
  const [many] = await costOf(100_000, 20);
  assert.ok(many.calls <= few.calls, `${many.calls} and ${few.calls} draw calls`);
  assert.ok(many.triangles > 200_000 && many.triangles < 600_000, `${many.triangles} triangles`);
});

test("nothing is drawn while nothing changes, and something as soon as it does", async () => {
  const run = await serve("run", scenario("meadow"), "--view", "--paused", "--no-record");
  try {
    const page = await open(browser, run.url);
    const count = () => page.evaluate(() => window.simbeeotic.stats().drawn);
    await stands(page);
    const last = await count();
    await page.keyboard.press("7");
    await page.waitForFunction((last) => window.simbeeotic.stats().drawn > last, last, { timeout: PATIENCE_MS });
    assert.deepEqual(page.faults, []);
  } finally {
    await run.kill();
  }
});
