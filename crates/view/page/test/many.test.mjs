// Ten thousand vehicles in a real browser: the page loads, draws, lists and finds them.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { drawn, launch, open, scenario, serve, time, until } from "./browser.mjs";

let browser, run;

before(async () => {
  browser = await launch();
  run = await serve("run", scenario("first-swarm"), "--view", "--paused", "--no-record", "--set", "model.bee.count=10000", "--set", "model.bee.start.ball=20 m", "--set", "model.bee.vehicle.bee_collisions=false");
});
after(async () => {
  await browser?.close();
  await run?.kill();
});

test("ten thousand vehicles are drawn, listed and found", async () => {
  const page = await open(browser, run.url);
  assert.equal(await page.evaluate(() => window.simbeeotic.frame().n), 10_001);
  assert.ok((await page.locator("#vehicles .row").count()) < 100, "rows exist only in sight");
  await page.keyboard.press("/");
  await page.keyboard.type("bee-9999");
  await page.keyboard.press("Enter");
  await until(page, () => document.getElementById("selected-name").textContent === "bee-9999");
  const before = (await page.evaluate(() => window.simbeeotic.stats())).drawn;
  const t = await time(page);
  await page.keyboard.press(">");
  await until(page, (t) => window.simbeeotic.time_s() >= t + 0.0999, t);
  await drawn(page, before + 1);
  assert.deepEqual(page.faults, []);
  await page.context().close();
});

test("no vehicle, one vehicle: what there is not is not shown", async () => {
  for (const [count, words] of [[0, "1 vehicle"], [1, "2 vehicles"]]) {
    const few = await serve("run", scenario("first-swarm"), "--view", "--paused", "--no-record", "--set", `model.bee.count=${count}`);
    try {
      const page = await open(browser, few.url);
      assert.equal(await page.textContent("#vehicle-count"), words);
      assert.equal(await page.locator("#layer-links").isVisible(), false, "no radio, no links");
      assert.equal(await page.locator("#layer-wind").isVisible(), false, "still air");
      assert.deepEqual(page.faults, []);
      await page.context().close();
    } finally {
      await few.kill();
    }
  }
});
