// A live run in a real browser: it moves, stops, steps and changes its pace when the page says so.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { launch, open, place, rest, scenario, serve, still, time, until, untilTime } from "./browser.mjs";

let browser, run, page;

before(async () => {
  browser = await launch();
});
after(async () => {
  await browser?.close();
  await run?.kill();
});

const state = (word) => until(page, (word) => document.getElementById("run-state").textContent === word, word);

test("a run started paused waits, says so, and starts when it is told to", async () => {
  run = await serve("run", scenario("first-swarm"), "--view", "--paused", "--no-record");
  page = await open(browser, run.url);
  await page.locator("#waiting").waitFor();
  await state("waits for start");
  assert.match(await page.textContent("#waiting"), /ready, and waits for you/);
  assert.equal(await page.getAttribute("#pause", "aria-label"), "Start");
  assert.equal(await page.title(), "first-swarm · live · Simbeeotic");
  assert.equal(await time(page), 0);
  const { events } = await page.evaluate(() => window.simbeeotic.state());
  await page.click("#start");
  await page.locator("#waiting").waitFor({ state: "hidden" });
  await state("live");
  await until(page, (events) => window.simbeeotic.state().events > events, events);
});

test("time moves, and so do the vehicles", async () => {
  const at = () => page.evaluate(() => [...window.simbeeotic.frame().positions.slice(0, 300)]);
  const before = await at();
  // The newest frame may be some time ahead of the one that is shown.
  const { time: t } = await page.evaluate(() => window.simbeeotic.frame());
  await untilTime(page, t + 0.5);
  const after = await at();
  assert.ok(before.some((x, k) => Math.abs(x - after[k]) > 0.01));
  assert.equal(await page.textContent("#vehicle-count"), "101 vehicles");
});

test("pause stops it, resume lets it go on", async () => {
  await page.click("#pause");
  await state("live, paused");
  await still(page);
  const t = await time(page);
  await page.click("#pause");
  await state("live");
  await untilTime(page, t + 0.1);
});

test("who presses twice at once pauses and resumes, however slow the answer is", async () => {
  const t = await time(page);
  await page.keyboard.press("Space");
  await page.keyboard.press("Space");
  await state("live");
  await untilTime(page, t + 0.5);
  // What the program says, too: it may have been told of a pause in between.
  await until(page, () => !window.simbeeotic.state().paused);
});

test("a step goes 0.1 s, or to the next instant", async () => {
  await page.keyboard.press("Space");
  await state("live, paused");
  await still(page);
  const before = await time(page);
  await page.click("#step-tenth");
  await untilTime(page, before + 0.0999);
  // Frames on the way there are shown, too.
  await still(page);
  const tenth = await time(page);
  assert.ok(Math.abs(tenth - before - 0.1) < 1e-6, `${before} to ${tenth}`);
  await page.keyboard.press(".");
  await until(page, (t) => window.simbeeotic.time_s() > t, tenth);
  assert.ok((await time(page)) < tenth + 0.1);
  await state("live, paused");
});

test("the speed of the run is set by buttons, keys and from a list", async () => {
  // What the program says, and what the page shows.
  const pace = (factor) => until(page, (factor) => window.simbeeotic.state().factor === factor && document.getElementById("pace").value === String(factor), factor);
  await pace(1);
  await page.click("#faster");
  await page.click("#faster");
  await pace(5);
  for (let k = 0; k < 3; k += 1) await page.keyboard.press("-");
  await pace(0.5);
  await page.selectOption("#pace", { label: "as fast as possible" });
  await pace(null);
  await page.keyboard.press("0");
  await pace(1);
});

test("a vehicle is found by its name, and told about", async () => {
  await page.keyboard.press("/");
  await page.keyboard.type("bee-17");
  await page.keyboard.press("Enter");
  await page.locator("#inspector").waitFor();
  assert.equal(await page.textContent("#selected-name"), "bee-17");
  assert.match(await page.textContent("#selected-kind"), /bee/);
  await until(page, () => /[0-9]/.test(document.getElementById("now-x")?.textContent ?? ""));
  await page.locator("#sensors").getByText("compass").first().waitFor();
  await page.locator("#parameters").getByText("max_speed").first().waitFor();
});

test("the camera goes with the vehicle that is followed, and stays when it is let go", async () => {
  assert.equal(await page.getAttribute("#follow", "aria-pressed"), "false");
  await page.keyboard.press("f");
  await until(page, () => document.getElementById("follow").getAttribute("aria-pressed") === "true");
  await page.keyboard.press("Space");
  await untilTime(page, (await time(page)) + 1);
  await page.keyboard.press("Space");
  await still(page);
  await until(page, () => {
    const { frame, place, vehicle } = window.simbeeotic;
    const at = 3 * vehicle("bee-17");
    const bee = [...frame().positions.slice(at, at + 3)];
    const { camera } = place();
    return Math.hypot(...bee.map((x, k) => x - camera.at[k])) < 0.1;
  });
  await page.keyboard.press("f");
  await until(page, () => document.getElementById("follow").getAttribute("aria-pressed") === "false");
});

test("a click on a vehicle selects it", async () => {
  await page.keyboard.press("f");
  // From above, what is followed comes to be in the middle of what the panel leaves free.
  await page.keyboard.press("t");
  await rest(page);
  assert.ok((await place(page)).camera.flat);
  await page.keyboard.press("Escape");
  await until(page, () => window.simbeeotic.place().select === undefined);
  const box = await page.locator("#scene canvas").first().boundingBox();
  const panel = await page.locator("#layers").boundingBox();
  const left = panel.x + panel.width;
  await page.mouse.click((left + box.x + box.width) / 2, box.y + box.height / 2);
  await until(page, () => window.simbeeotic.place().select !== undefined);
  assert.equal((await place(page)).select, "bee-17");
});

test("charts have data", async () => {
  const chart = page.locator('.chart[data-series="speed"]');
  await chart.waitFor();
  await until(page, () => /[0-9]/.test(document.querySelector('.chart[data-series="speed"] output').textContent));
  await chart.locator("canvas").waitFor();
  const inked = () => {
    const canvas = document.querySelector('.chart[data-series="speed"] canvas');
    const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
    return data.some((value, at) => at % 4 === 3 && value > 0);
  };
  await until(page, inked);
});

test("charts are chosen by name, and taken away", async () => {
  const names = (list) => until(page, (list) => [...document.querySelectorAll(".chart")].map((it) => it.dataset.series).join() === list, list.join());
  const { ticked, focused } = await page.evaluate(() => {
    document.getElementById("choose-charts").click();
    // Who is quick finds it filled, and can type: the browser tells of its opening later.
    const focused = document.activeElement.id;
    const ticked = [...document.querySelectorAll("#chart-chooser input:checked")];
    for (const it of ticked) it.click();
    return { ticked: ticked.length, focused };
  });
  assert.ok(ticked > 0);
  assert.equal(focused, "find-chart");
  await page.locator("#chart-chooser").waitFor();
  await names([]);
  await page.keyboard.type("contacts");
  assert.equal(await page.locator("#chart-chooser .check:visible").count(), 1);
  await page.locator("#chart-chooser").getByLabel("contacts").check();
  await names(["contacts"]);
  assert.deepEqual((await place(page)).charts, [{ name: "contacts", own: false }]);
  await page.click("#usual-charts");
  await until(page, () => window.simbeeotic.place().charts === undefined);
  await page.keyboard.press("Escape");
  await page.locator("#chart-chooser").waitFor({ state: "hidden" });
  await page.locator('.chart[data-series="speed"]').waitFor();
  await page.hover('.chart[data-series="speed"]');
  await page.click('.chart[data-series="speed"] button');
  await until(page, () => document.querySelector('.chart[data-series="speed"]') === null);
});

test("all went without an error on the console", () => {
  assert.deepEqual(page.faults, []);
});

test("a second page sees the same run", async () => {
  const other = await open(browser, run.url, { viewport: { width: 480, height: 800 } });
  assert.ok((await time(other)) >= 0);
  await other.context().close();
});

test("when the program is gone the page says so, and comes back with the next one", async () => {
  await run.kill();
  const lost = page.locator("#lost");
  await lost.waitFor();
  assert.match(await lost.textContent(), /The program is gone/);
  const { port } = new URL(run.url);
  run = await serve("run", scenario("first-swarm"), "--view", "--paused", "--no-record", "--port", port);
  await lost.waitFor({ state: "hidden" });
  await page.locator("#waiting").waitFor();
  assert.equal(await time(page), 0);
  assert.equal((await place(page)).select, "bee-17", "the page looks at what it looked at before");
});
