// What a designer looks at, in a real browser: nothing is cut, covered or moved about, and all can be reached by keys.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { launch, open, scenario, serve, stands, still, until, untilTime } from "./browser.mjs";

let browser, run, page;

before(async () => {
  browser = await launch();
  run = await serve("run", scenario("first-swarm"), "--view", "--paused", "--no-record");
  page = await open(browser, run.url, { viewport: { width: 1366, height: 768 } });
});
after(async () => {
  await browser?.close();
  await run?.kill();
});

/** What sticks out of the window or of its bar, or lies over its neighbour in a bar. */
function misplaced() {
  const found = [];
  if (document.documentElement.scrollWidth > innerWidth) found.push(`the page is ${document.documentElement.scrollWidth} wide`);
  for (const bar of document.querySelectorAll(".bar")) {
    let end = 0;
    let row = 0;
    for (const it of bar.children) {
      const box = it.getBoundingClientRect();
      if (box.width === 0 || it.hidden) continue;
      const name = it.id || it.textContent || it.className;
      if (box.right > innerWidth + 0.5 || box.left < -0.5) found.push(`${name} sticks out`);
      if (box.top > row + 8) end = 0;
      row = box.top;
      if (box.left < end - 0.5) found.push(`${name} lies over its neighbour`);
      end = it.classList.contains("gap") ? end : box.right;
      if (it.tagName === "BUTTON" && it.scrollWidth > it.clientWidth + 1) found.push(`${name} is cut`);
    }
  }
  return found;
}

test("at each usual size nothing in the bars is cut or covered, with large text too", async () => {
  for (const large of [false, true]) {
    for (const [width, height] of [[1024, 768], [1280, 720], [1366, 768], [1920, 1080], [390, 780]]) {
      await page.setViewportSize({ width, height });
      await until(page, (width) => innerWidth === width, width);
      assert.deepEqual(await page.evaluate(misplaced), [], `${width} by ${height}${large ? ", large text" : ""}`);
    }
    await page.keyboard.press("z");
    await until(page, (large) => document.documentElement.dataset.text === (large ? "normal" : "large"), large);
  }
});

test("the picture keeps its place and size when the run starts, and when a vehicle is selected", async () => {
  await page.setViewportSize({ width: 1366, height: 768 });
  await until(page, () => innerWidth === 1366);
  // The panels come back where there is room for them again, some time after the window has grown.
  const shown = () => ["vehicles", "charts"].every((id) => document.getElementById(id).getBoundingClientRect().height > 0);
  await until(page, shown);
  const box = () => page.locator("#scene").boundingBox();
  const before = await box();
  await page.click("#start");
  await untilTime(page, 0.5);
  await page.locator(".chart").first().waitFor();
  assert.deepEqual(await box(), before);
  await page.keyboard.press("Space");
  await still(page);
  await page.keyboard.press("/");
  await page.keyboard.type("bee-3");
  await page.keyboard.press("Enter");
  await page.locator("#parameters").waitFor({ state: "attached" });
  assert.deepEqual(await box(), before);
});

test("with large text the charts in sight are whole, the names of kinds too, and all of the layers panel", async () => {
  await page.keyboard.press("Escape");
  await page.keyboard.press("z");
  const before = await page.evaluate(() => location.hash);
  await page.evaluate(() => (location.hash = "#charts=speed,contacts,a,b,c,d,e,f"));
  await until(page, () => document.querySelectorAll(".chart").length === 8);
  for (const [width, height] of [[1366, 768], [1024, 768]]) {
    await page.setViewportSize({ width, height });
    await until(page, (width) => innerWidth === width, width);
    await until(page, () => {
      const row = document.getElementById("chart-row").getBoundingClientRect();
      const boxes = [...document.querySelectorAll(".chart")].map((it) => it.getBoundingClientRect());
      const whole = boxes.filter((box) => box.left >= row.left - 1 && box.right <= row.right + 1);
      const cut = boxes.filter((box) => box.left < row.right - 1 && box.right > row.right + 1);
      return whole.length >= 3 && whole.length < 8 && cut.length === 0;
    });
    const panel = await page.evaluate(() => {
      const left = document.getElementById("layers");
      const [entry] = [...document.querySelectorAll("#legend .entry .whole")].filter((it) => it.textContent === "random-walk-bee");
      return { hidden: left.scrollHeight - left.clientHeight, wide: left.scrollWidth - left.clientWidth, cut: entry.scrollWidth - entry.clientWidth };
    });
    assert.ok(panel.hidden <= 1 && panel.wide <= 1 && panel.cut <= 1, `${width} by ${height}: ${JSON.stringify(panel)}`);
  }
  await page.keyboard.press("z");
  await page.setViewportSize({ width: 1366, height: 768 });
  await page.evaluate((hash) => history.replaceState(null, "", hash || "#"), before);
  await page.click("#choose-charts");
  await page.click("#usual-charts");
  await page.keyboard.press("Escape");
});

test("a run that stands is not drawn again, and its selected vehicle neither", async () => {
  await stands(page);
});

test("the tab key goes through bar, layers, controls, charts and list, and shows where it is", async () => {
  await page.focus("#show-layers");
  const seen = [];
  for (let k = 0; k < 70; k += 1) {
    await page.keyboard.press("Tab");
    const at = await page.evaluate(() => {
      const it = document.activeElement;
      if (!it || it === document.body) return null;
      const style = getComputedStyle(it);
      const part = it.closest(".bar.top") ? "top" : it.closest("#layers") ? "layers" : it.closest(".bar.bottom") ? "bottom" : it.closest("#charts") ? "charts" : it.closest("#vehicles") ? "vehicles" : it.className;
      return { part, name: it.id || it.getAttribute("aria-label") || it.textContent, ring: style.outlineStyle !== "none" && Number.parseFloat(style.outlineWidth) >= 1 };
    });
    if (at === null) break;
    assert.ok(at.ring, `${at.name} shows no focus`);
    if (seen.at(-1) !== at.part) seen.push(at.part);
    if (at.part === "vehicles") break;
  }
  assert.deepEqual(seen, ["top", "layers", "bottom", "charts", "vehicles"]);
});

test("all went without an error on the console", () => {
  assert.deepEqual(page.faults, []);
});
