// A swarm under a roof, in a real browser: the world is shown cut open, and a view from the side stands on the ground.
import assert from "node:assert/strict";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { launch, open, place, rest, saved, scenario, serve, until } from "./browser.mjs";
import { difference } from "./pictures.mjs";

let browser, folder, run, page;

before(async () => {
  folder = mkdtempSync(join(tmpdir(), "simbeeotic-roof-"));
  const roof = 'label = "roof"\nposition = ["0 m", "0 m", "9 m"]\nshape = { box = { length = "60 m", width = "60 m", height = "0.3 m" } }';
  const wall = 'label = "wall"\nposition = ["0 m", "30 m", "0 m"]\nshape = { box = { length = "60 m", width = "0.3 m", height = "9 m" } }';
  writeFileSync(join(folder, "hall.toml"), `[[obstacle]]\n${roof}\n\n[[obstacle]]\n${wall}\n`);
  const bees = readFileSync(scenario("first-swarm"), "utf8").replace("[run]", 'world = "hall.toml"\n[run]');
  writeFileSync(join(folder, "indoors.toml"), bees);
  [browser, run] = await Promise.all([launch(), serve("run", join(folder, "indoors.toml"), "--view", "--paused", "--no-record")]);
  page = await open(browser, run.url, { viewport: { width: 1000, height: 640 } });
});
after(async () => {
  await browser?.close();
  await run?.kill();
  if (folder) rmSync(folder, { recursive: true, force: true });
});

const cut = () => page.locator("#layer-cut").isChecked();

test("a swarm under a roof is seen: the world is cut open, once, and says so", async () => {
  await until(page, () => document.getElementById("layer-cut").checked);
  assert.match(await page.textContent(".notice"), /under a roof/);
  assert.equal(await page.textContent("#layers label:has(#layer-cut) kbd"), "x");
  await rest(page);
  const open = await saved(page);
  await page.keyboard.press("x");
  assert.equal(await cut(), false);
  await rest(page);
  const closed = await saved(page);
  const { mean } = await difference(page, open, closed);
  assert.ok(mean > 10, `a roof is another picture: ${mean}`);
  // The shadow goes with what throws it.
  await page.keyboard.press("x");
  await rest(page);
  const again = await difference(page, open, await saved(page));
  assert.ok(again.mean < 0.5, `as it was: ${again.mean}`);
});

test("who has closed it finds it closed, and a link says which", async () => {
  await page.keyboard.press("x");
  await page.keyboard.press(".");
  await page.locator("#waiting").waitFor({ state: "hidden" });
  await rest(page);
  assert.equal(await cut(), false);
  await page.click("#copy-link");
  const other = await open(browser, page.url());
  await other.locator("#layer-cut").waitFor();
  await rest(other);
  assert.equal((await place(other)).layers.cut, false);
  await other.context().close();
});

test("from the side the ground is a narrow strip, and the swarm is in sight", async () => {
  await page.keyboard.press("w");
  await rest(page);
  const { camera } = await place(page);
  assert.ok(camera.flat && Math.abs(camera.from[2] - camera.at[2]) < 1e-3 && camera.from[0] < camera.at[0], JSON.stringify(camera));
  const half = Math.hypot(...camera.from.map((x, k) => x - camera.at[k])) * Math.tan(Math.PI / 9);
  const below = (half - camera.at[2]) / (2 * half);
  assert.ok(below > 0 && below < 0.12, `${100 * below} % of the picture are below the ground`);
  const heights = await page.evaluate(() => [...window.simbeeotic.frame().positions].filter((_, k) => k % 3 === 2));
  assert.ok(heights.every((z) => Math.abs(z - camera.at[2]) < half), "all are in the picture");
});

test("all went without an error on the console", () => {
  assert.deepEqual(page.faults, []);
});
