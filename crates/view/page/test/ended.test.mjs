// A live run after its end, in a real browser: what is chosen then is answered, of the time at which it ended.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { launch, open, scenario, serve, time, until } from "./browser.mjs";

let browser, run, page;

before(async () => {
  browser = await launch();
  run = await serve("run", scenario("meadow"), "--view", "--paused", "--no-record", "--end-time", "5 s");
  page = await open(browser, run.url);
  await page.keyboard.press("9");
  await page.keyboard.press("Space");
  await until(page, () => window.simbeeotic.state()?.ended);
  await until(page, () => window.simbeeotic.time_s() === window.simbeeotic.state().time_s);
});
after(async () => {
  await browser?.close();
  await run?.kill();
});

test("a colour that is chosen after the end is of its own numbers, and so is the next", async () => {
  // Forty have a battery, and at most ten a radio that knows neighbours.
  for (const [colour, least, most] of [["battery", 40, 40], ["value:neighbors", 1, 10], ["battery", 40, 40]]) {
    await page.selectOption("#colour-by", colour);
    await until(
      page,
      ([least, most]) => {
        const known = [...(window.simbeeotic.frame().values ?? [])].filter(Number.isFinite).length;
        return known >= least && known <= most;
      },
      [least, most],
    );
    assert.equal(await page.evaluate(() => window.simbeeotic.frame().time === window.simbeeotic.state().time_s), true);
  }
});

test("a vehicle that is selected after the end is told about, as it was then", async () => {
  for (const name of ["scout-5", "talker-4"]) {
    await page.keyboard.press("/");
    await page.keyboard.type(name);
    await page.keyboard.press("Enter");
    await until(page, (name) => document.getElementById("selected-name").textContent === name, name);
    await page.locator("#parameters summary").first().waitFor();
    assert.equal(await page.getByText("Waiting for its details").isVisible(), false);
  }
});

test("all went without an error on the console", async () => {
  assert.ok((await time(page)) > 0);
  assert.deepEqual(page.faults, []);
});
