// Fingers on the picture, and a graphics card that takes the picture away, in a real browser.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { launch, open, place, rest as atRest, scenario, serve, still, until } from "./browser.mjs";
import { difference } from "./pictures.mjs";

let browser, run, page, touch;

before(async () => {
  browser = await launch();
  run = await serve("run", scenario("first-swarm"), "--view", "--paused", "--no-record");
  // At this size no panel lies over the picture.
  page = await open(browser, `${run.url}#panels=`, { hasTouch: true, viewport: { width: 700, height: 500 }, newcomer: true });
  const session = await page.context().newCDPSession(page);
  touch = (type, ...points) => session.send("Input.dispatchTouchEvent", { type, touchPoints: points.map(([x, y], id) => ({ x, y, id })) });
  await page.keyboard.press(".");
  await page.locator("#waiting").waitFor({ state: "hidden" });
});
after(async () => {
  await browser?.close();
  await run?.kill();
});

const distance = ({ from, at }) => Math.hypot(...from.map((x, k) => x - at[k]));
const moved = (a, b) => Math.hypot(...a.map((x, k) => x - b[k]));

/** The camera, once it has arrived and nothing is drawn any more. */
async function rest() {
  await atRest(page);
  return (await place(page)).camera;
}

/** Fingers go from places to others, in steps, and leave. */
async function fingers(from, to, steps = 4) {
  await touch("touchStart", ...from);
  for (let k = 1; k <= steps; k += 1) {
    await touch("touchMove", ...from.map(([x, y], n) => [x + ((to[n][0] - x) * k) / steps, y + ((to[n][1] - y) * k) / steps]));
  }
  await touch("touchEnd");
  return rest();
}

test("a newcomer is told what the picture can do, until it was used", async () => {
  assert.equal(await page.locator("#first-steps").isVisible(), true);
  assert.match(await page.textContent("#first-steps"), /Drag to turn/);
});

test("one finger turns around the middle", async () => {
  const before = await rest();
  const after = await fingers([[300, 250]], [[400, 270]]);
  assert.ok(moved(before.at, after.at) < 1e-3, "it looks at the same place");
  assert.ok(Math.abs(distance(before) - distance(after)) < 1e-2 * distance(before), "from as far");
  assert.ok(moved(before.from, after.from) > 0.05 * distance(before), "from elsewhere");
  await page.locator("#first-steps").waitFor({ state: "hidden" });
});

test("two fingers that part go nearer, and away when they meet", async () => {
  const before = await rest();
  const near = await fingers([[300, 250], [360, 250]], [[250, 250], [410, 250]]);
  assert.ok(distance(near) < 0.6 * distance(before), `${distance(before)} to ${distance(near)}`);
  const far = await fingers([[250, 250], [410, 250]], [[300, 250], [360, 250]]);
  assert.ok(Math.abs(distance(far) / distance(before) - 1) < 0.02, `${distance(before)} to ${distance(far)}`);
});

test("two fingers side by side move the picture with them", async () => {
  const before = await rest();
  const after = await fingers([[300, 200], [360, 200]], [[380, 230], [440, 230]]);
  assert.ok(moved(before.at, after.at) > 0.02 * distance(before), "it looks elsewhere");
  assert.ok(Math.abs(distance(after) / distance(before) - 1) < 0.02, "from as far");
  const turned = (state) => state.from.map((x, k) => (x - state.at[k]) / distance(state));
  assert.ok(moved(turned(before), turned(after)) < 0.02, "in the same direction");
});

test("a finger that is lifted while the other stays makes no jump", async () => {
  await touch("touchStart", [300, 250], [400, 250]);
  await touch("touchMove", [290, 250], [410, 250]);
  await touch("touchEnd", [290, 250]);
  const before = await rest();
  await touch("touchMove", [292, 250]);
  await touch("touchEnd");
  const after = await rest();
  assert.ok(moved(before.from, after.from) < 0.1 * distance(before), `${before.from} to ${after.from}`);
});

test("a tap selects a vehicle, and a tap beside it nobody", async () => {
  await page.evaluate(() => (location.hash = `#select=bee-17&follow=1&panels=`));
  await until(page, () => window.simbeeotic.place().follow);
  await page.keyboard.press("t");
  await rest();
  await page.keyboard.press("Escape");
  await until(page, () => window.simbeeotic.place().select === undefined);
  const box = await page.locator("#scene canvas").first().boundingBox();
  await page.touchscreen.tap(box.x + box.width / 2, box.y + box.height / 2);
  await until(page, () => window.simbeeotic.place().select !== undefined);
  assert.equal((await place(page)).select, "bee-17");
  await page.touchscreen.tap(box.x + 40, box.y + box.height - 90);
  await until(page, () => window.simbeeotic.place().select === undefined);
});

test("a graphics card that takes the picture away gives it back, and all is drawn again", async () => {
  await still(page);
  await page.keyboard.press("a");
  await rest();
  const picture = async () => {
    // Fine, as it is drawn when nothing moves.
    await rest();
    return page.locator("#scene").screenshot({ animations: "disabled" });
  };
  const before = await picture();
  const { drawn } = await page.evaluate(() => window.simbeeotic.stats());
  await page.evaluate(() => {
    const gl = document.querySelector("#scene canvas").getContext("webgl2");
    window.card = gl.getExtension("WEBGL_lose_context");
    window.card.loseContext();
  });
  await until(page, () => document.querySelector("#scene canvas").getContext("webgl2").isContextLost());
  await page.locator(".notice").getByText(/picture/).waitFor();
  await page.evaluate(() => window.card.restoreContext());
  await until(page, (drawn) => window.simbeeotic.stats().drawn > drawn, drawn);
  const { size, mean, other } = await difference(page, before, await picture());
  assert.equal(size, "");
  assert.ok(mean < 2 && other < 0.01, `the picture afterwards differs: mean ${mean}, ${100 * other} % of blocks`);
  // It lives: what is asked for is drawn.
  const now = await page.evaluate(() => window.simbeeotic.stats().drawn);
  await page.keyboard.press("s");
  await until(page, (now) => window.simbeeotic.stats().drawn > now, now);
  const side = await difference(page, before, await picture());
  assert.ok(side.mean > 2, `from the south it looks otherwise: ${side.mean}`);
});

test("all went without an error on the console", () => {
  assert.deepEqual(page.faults.filter((text) => !/context (was )?(lost|restored)/i.test(text)), []);
});
