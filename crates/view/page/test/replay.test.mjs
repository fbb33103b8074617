// A recording in a real browser: played, scrubbed, stepped, linked to, drawn.
import assert from "node:assert/strict";
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { compare, difference, kept, pixels, verdict } from "./pictures.mjs";
import { execute, launch, open, place, rest, said, save, saved, scenario, serve, time, until, untilTime } from "./browser.mjs";

let browser, folder, run, page;

before(async () => {
  folder = mkdtempSync(join(tmpdir(), "simbeeotic-replay-"));
  const recording = join(folder, "meadow.mcap");
  await execute("run", scenario("meadow"), "--end-time", "20 s", "--record", recording, "--quiet");
  [browser, run] = await Promise.all([launch(), serve("view", recording)]);
});
after(async () => {
  await browser?.close();
  await run?.kill();
  if (folder) rmSync(folder, { recursive: true, force: true });
});

const near = (t) => until(page, (t) => Math.abs(window.simbeeotic.time_s() - t) < 1e-6, t);
const state = (word) => until(page, (word) => document.getElementById("run-state").textContent === word, word);

test("a recording opens at its beginning, and stands", async () => {
  page = await open(browser, run.url);
  assert.equal(await page.title(), "meadow · replay · Simbeeotic");
  await state("replay, paused");
  assert.equal(await time(page), 0);
});

test("what is chosen before there is anything to see holds when the swarm comes", async () => {
  const to = (camera) => Math.hypot(...camera.at.map((x, k) => x - camera.from[k]));
  const above = await open(browser, run.url, { early: ["t"] });
  assert.ok(await above.evaluate(() => window.hastened), "the keys came first");
  await rest(above);
  const { camera } = await place(above);
  assert.ok(camera.flat && camera.from[2] - camera.at[2] > 0.999 * to(camera), "from above");
  await above.context().close();
  const near = await open(browser, `${run.url}#select=scout-3`, { early: ["f"] });
  assert.ok(await near.evaluate(() => window.hastened), "the keys came first");
  await rest(near);
  assert.match(await near.textContent("#now-x"), /[0-9]/, "where it is, though time stands");
  const off = await near.evaluate(() => {
    const { frame, place, vehicle } = window.simbeeotic;
    const at = 3 * vehicle("scout-3");
    return Math.hypot(...place().camera.at.map((x, k) => x - frame().positions[at + k]));
  });
  assert.ok(off < 0.01, `it looks ${off} m beside whom it follows`);
  await near.context().close();
});

test("playing moves the time and the vehicles, and stops when it is told to", async () => {
  const before = await page.evaluate(() => [...window.simbeeotic.frame().positions]);
  await page.click("#play");
  await state("replay");
  await untilTime(page, 1);
  const after = await page.evaluate(() => [...window.simbeeotic.frame().positions]);
  assert.ok(before.some((x, k) => Math.abs(x - after[k]) > 0.05));
  await page.keyboard.press("Space");
  await state("replay, paused");
});

test("scrubbing shows the time under the pointer", async () => {
  const box = await page.locator("#timeline").boundingBox();
  const y = box.y + box.height / 2;
  await page.mouse.move(box.x + 10, y);
  await page.mouse.down();
  await page.mouse.move(box.x + box.width * 0.25, y, { steps: 3 });
  await page.mouse.move(box.x + box.width * 0.75, y, { steps: 3 });
  await until(page, () => Math.abs(window.simbeeotic.time_s() - 15) < 0.6);
  await page.mouse.up();
  await until(page, () => Math.abs(window.simbeeotic.frame().time - window.simbeeotic.time_s()) <= 0.2 + 1e-9);
  await state("replay, paused");
});

test("steps go from tick to tick, keys to both ends", async () => {
  await page.keyboard.press("Home");
  await near(0);
  await page.click("#tick-on");
  await near(0.2);
  await page.keyboard.press(".");
  await near(0.4);
  await page.keyboard.press(",");
  await near(0.2);
  await page.keyboard.press("End");
  await near(20);
});

test("speed is chosen by buttons and keys, and a fast replay reaches the end", async () => {
  await page.keyboard.press("Home");
  await near(0);
  await page.click("#faster");
  await page.keyboard.press("+");
  await page.keyboard.press("+");
  assert.equal(await page.textContent("#speed"), "10 ×");
  await page.keyboard.press("Space");
  await near(20);
  await state("replay, paused");
  await page.keyboard.press("0");
  assert.equal(await page.textContent("#speed"), "1 ×");
});

test("jumps go to the marks", async () => {
  await page.keyboard.press("Home");
  await near(0);
  await page.click("#next-mark");
  await until(page, () => window.simbeeotic.time_s() > 0);
  const first = await time(page);
  await page.keyboard.press("]");
  await until(page, (t) => window.simbeeotic.time_s() > t, first);
  await page.click("#previous-mark");
  await near(first);
  await page.keyboard.press("m");
  const row = page.locator("#panel-marks .row").nth(4);
  await row.waitFor();
  await row.click();
  await until(page, (t) => window.simbeeotic.time_s() > t, first);
  await until(page, () => window.simbeeotic.place().select !== undefined);
  // Who is selected matters only where it was said so.
  await page.keyboard.press("Home");
  await near(0);
  await page.keyboard.press("]");
  await near(first);
  await page.locator("#mark-own").check();
  const own = await page.locator("#panel-marks .row").count();
  assert.equal(await page.locator("#panel-marks .row.mine").count(), own);
  await page.keyboard.press("Home");
  await near(0);
  await page.keyboard.press("]");
  await until(page, (t) => window.simbeeotic.time_s() > t, first);
  assert.equal(await page.locator("#panel-marks .row.mine[aria-current=true]").count(), 1, "the list is where the jump went");
  await page.locator("#mark-own").uncheck();
  await page.keyboard.press("v");
});

test("marks of one kind are listed, counted and jumped to", async () => {
  await page.keyboard.press("Escape");
  await page.keyboard.press("Home");
  await near(0);
  await page.keyboard.press("m");
  const kinds = await page.locator("#mark-kind option").allTextContents();
  assert.ok(kinds.some((text) => /^contact \([1-9]/.test(text)) && kinds.some((text) => /^log \([1-9]/.test(text)), kinds.join());
  await page.selectOption("#mark-kind", "log");
  await until(page, () => [...document.querySelectorAll("#panel-marks .row .second")].every((it) => /^log/.test(it.textContent)));
  assert.equal((await place(page)).marks, "log");
  await said(page, /^log ·/, () => page.keyboard.press("]"));
  await page.selectOption("#mark-kind", "contact");
  await page.keyboard.press("Home");
  await near(0);
  await said(page, /^contact ·/, () => page.keyboard.press("]"));
  await page.selectOption("#mark-kind", "");
  await page.keyboard.press("v");
});

test("vehicles are coloured by a number that a model publishes", async () => {
  await page.selectOption("#colour-by", { label: "neighbors" });
  await page.keyboard.press("End");
  // Values come with the frames, for those that publish the number: ten of all.
  await until(page, () => window.simbeeotic.frame().values?.filter(Number.isFinite).length === 10);
  await page.locator("#legend .ramp").waitFor();
  assert.match(await page.textContent("#legend"), /no value/);
  await page.selectOption("#colour-by", "kind");
  assert.match(await page.textContent("#legend"), /forager-bee40/);
});

test("a kind in the legend lists its vehicles", async () => {
  await page.locator("#legend").getByText("balloon").click();
  await until(page, () => document.getElementById("search").value === "balloon" && document.querySelectorAll("#panel-vehicles .row").length === 8);
  await page.keyboard.press("Escape");
  await page.keyboard.press("Escape");
});

test("the selected vehicle is told about at the time that is shown", async () => {
  await page.keyboard.press("/");
  await page.keyboard.type("scout-3");
  await page.keyboard.press("Enter");
  await page.locator("#sensors").getByText("ring").first().waitFor();
  await page.locator("#parameters").getByText("max_range").first().waitFor({ state: "attached" });
  const x = await page.textContent("#now-x");
  await page.keyboard.press("Home");
  await until(page, (x) => document.getElementById("now-x").textContent !== x, x);
});

test("what was not recorded says what the recorder needs", async () => {
  // Its ring was recorded, its camera was not.
  await page.locator("#sensors .hint").waitFor();
  assert.match(await page.locator("#sensors .hint").textContent(), /readings = \["scout-3\/\*"\]/);
});

test("a click on a chart goes to that time", async () => {
  const over = page.locator(".chart .u-over").first();
  // Into its middle, wherever that is by then: charts move together when the selected vehicle's come.
  await over.click();
  await until(page, () => Math.abs(window.simbeeotic.time_s() - 10) < 0.5);
});

test("a link restores the view in another tab", async () => {
  await page.keyboard.press("1");
  await page.keyboard.press("e");
  await page.keyboard.press("f");
  await page.selectOption("#colour-by", "speed");
  await page.keyboard.press("d");
  await page.keyboard.press("g");
  await page.locator("#chart-chooser").getByLabel("contacts").setChecked(true);
  await page.locator("#chart-chooser").getByLabel("charge (mean)").setChecked(false);
  await page.keyboard.press("Escape");
  await rest(page);
  await page.click("#copy-link");
  await until(page, () => location.hash.length > 1);
  const link = page.url();
  const here = await place(page);
  assert.ok(here.layers.labels && here.follow && here.camera.flat !== undefined);
  const other = await open(browser, link);
  await until(other, (t) => Math.abs(window.simbeeotic.time_s() - t) < 1e-6, here.t_s);
  const there = await place(other);
  for (const part of ["select", "follow", "layers", "colour", "theme", "charts", "panels"]) assert.deepEqual(there[part], here[part], part);
  const same = (camera) => camera.from.every((x, k) => Math.abs(x - window.simbeeotic.place().camera.from[k]) < 0.5);
  await until(other, same, here.camera);
  // The same to the eye, too.
  await rest(other);
  assert.equal(await verdict(page, await saved(page), await saved(other)), "");
  assert.deepEqual(other.faults, []);
  await other.context().close();
});

test("the theme goes from auto to light to dark, and colours follow", async () => {
  const ground = () => page.evaluate(() => getComputedStyle(document.querySelector(".bar")).backgroundColor);
  await until(page, () => document.documentElement.dataset.theme === "light");
  const light = await ground();
  await page.click("#theme");
  await until(page, () => document.documentElement.dataset.theme === "dark");
  assert.notEqual(await ground(), light);
  await page.click("#theme");
  assert.equal((await place(page)).theme, "auto");
});

test("layers are switched by boxes and keys", async () => {
  const on = async () => (await place(page)).layers.trails;
  const before = await on();
  await page.click("#layer-trails");
  assert.equal(await on(), !before);
  await page.keyboard.press("2");
  assert.equal(await on(), before);
});

test("the wind of a recording is shown, and hidden", async () => {
  await page.locator("#layer-wind").waitFor();
  assert.equal((await place(page)).layers.wind, true);
  await rest(page);
  const windy = await saved(page);
  await page.keyboard.press("6");
  assert.equal((await place(page)).layers.wind, false);
  const { mean } = await difference(page, windy, await saved(page));
  assert.ok(mean > 0.05, `without arrows the picture is another: ${mean}`);
  await page.keyboard.press("6");
  const again = await difference(page, windy, await saved(page));
  assert.ok(again.mean < mean / 4, `with them it is as it was: ${again.mean}`);
});

test("links and wind have a scale while they are shown", async () => {
  const links = page.locator("#links-scale");
  await links.waitFor();
  assert.match(await links.textContent(), /^−95−45\u00a0dBm$/);
  assert.match(await links.locator(".ramp").evaluate((it) => it.style.background), /linear-gradient/);
  const wind = page.locator("#wind-scale");
  assert.match(await wind.textContent(), /^arrows up to [\d.]+\u00a0m\/s$/);
  for (const [key, scale] of [["3", links], ["6", wind]]) {
    await page.keyboard.press(key);
    await scale.waitFor({ state: "hidden" });
    await page.keyboard.press(key);
    await scale.waitFor();
  }
});

test("a link to a time shows the trails that lead there", async () => {
  const other = await open(browser, `${run.url}#t=12&layers=trails&camera=34,-40,26,0,0,4`);
  await until(other, () => window.simbeeotic.frame()?.time === 12);
  await rest(other);
  const trails = await saved(other);
  await other.keyboard.press("2");
  await rest(other);
  const { mean } = await difference(other, trails, await saved(other));
  assert.ok(mean > 0.1, `without trails the picture is another: ${mean}`);
  assert.deepEqual(other.faults, []);
  await other.context().close();
});

test("the help sheet shows the keys, and goes again", async () => {
  await page.keyboard.press("?");
  const help = page.locator("#help");
  await help.waitFor();
  // All that has a key on the page is on the sheet.
  const missing = await page.evaluate(() => {
    const names = { " ": "Space", Escape: "Esc" };
    const listed = [...document.querySelectorAll("#help kbd")].map((it) => it.textContent);
    const keys = [...document.querySelectorAll("[aria-keyshortcuts]")].map((it) => it.getAttribute("aria-keyshortcuts"));
    return keys.map((key) => names[key] ?? key.replace("Shift+", "Shift ")).filter((key) => !listed.includes(key));
  });
  assert.deepEqual(missing, []);
  assert.match(await help.textContent(), /next mark/);
  await page.keyboard.press("Escape");
  await help.waitFor({ state: "hidden" });
  await page.click("#help-button");
  await help.waitFor();
  await page.keyboard.press("Escape");
});

test("a picture is saved as PNG", async () => {
  const download = await save(page);
  assert.match(download.suggestedFilename(), /^meadow-[0-9.]+s\.png$/);
  const bytes = readFileSync(await download.path());
  assert.deepEqual([...bytes.subarray(0, 8)], [0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a]);
  assert.ok(bytes.length > 2000, String(bytes.length));
});

test("a saved picture says what its colours mean, and what is looked at is in its middle", async () => {
  // From the top what is followed is where it looks; the panel on the left does not count.
  const other = await open(browser, `${run.url}#t=10&select=scout-3&follow=1&colour=battery&theme=light&layers=grid`);
  await other.keyboard.press("t");
  await rest(other);
  const seen = await pixels(other, await saved(other));
  const { width, height } = seen;
  const found = (rgb, holds = () => true) => {
    const list = [];
    for (let at = 0; at < width * height; at += 1) {
      const [x, y] = [at % width, Math.floor(at / width)];
      if (holds(x, y) && rgb.every((value, k) => Math.abs(seen.data[4 * at + k] - value) < 8)) list.push([x, y]);
    }
    return list;
  };
  const mean = (list) => list.reduce((sum, [x]) => sum + x / list.length, 0);
  // The ring around it.
  const ring = found([0xd6, 0x00, 0x6c]);
  assert.ok(ring.length > 20 && Math.abs(mean(ring) - width / 2) < 3, `the ring of ${ring.length} pixels is at ${mean(ring)} of ${width}`);
  // The scale of charges in the lower left corner, from red to blue.
  const corner = (x, y) => x < width / 3 && y > height / 2;
  const [low, high] = [found([0xc1, 0x12, 0x1f], corner), found([0x1d, 0x6f, 0xb8], corner)];
  assert.ok(low.length > 5 && high.length > 5 && mean(low) < mean(high), `${low.length} and ${high.length} pixels`);
  await other.context().close();
});

test("buttons and boxes have names that can be read out", async () => {
  const nameless = await page.evaluate(() =>
    [...document.querySelectorAll("button, input, select, [role=slider]")]
      .filter((it) => !(it.getAttribute("aria-label") || it.textContent.trim() || it.closest("label")?.textContent.trim()))
      .map((it) => it.outerHTML.slice(0, 120)),
  );
  assert.deepEqual(nameless, []);
});

test("text stands out from its ground in both themes", async () => {
  for (const theme of ["light", "dark"]) {
    const pairs = await page.evaluate((theme) => {
      const root = document.documentElement;
      const before = root.dataset.theme;
      root.dataset.theme = theme;
      const probe = document.body.appendChild(document.createElement("i"));
      const rgb = (name) => {
        probe.style.color = `var(${name})`;
        return getComputedStyle(probe).color.match(/[\d.]+/g).slice(0, 3).map(Number);
      };
      const light = (name) =>
        rgb(name)
          .map((x) => x / 255)
          .map((x) => (x <= 0.04045 ? x / 12.92 : ((x + 0.055) / 1.055) ** 2.4))
          .reduce((sum, x, k) => sum + x * [0.2126, 0.7152, 0.0722][k], 0);
      const contrast = (a, b) => (Math.max(light(a), light(b)) + 0.05) / (Math.min(light(a), light(b)) + 0.05);
      const list = [["--text", "--panel-solid"], ["--faint", "--panel-solid"], ["--faint", "--field"], ["--accent", "--panel-solid"], ["--on-accent", "--accent"], ["--warn", "--panel-solid"], ["--good", "--panel-solid"], ["--bad", "--bad-ground"]];
      const found = list.map(([a, b]) => [a, b, contrast(a, b)]);
      probe.remove();
      root.dataset.theme = before;
      return found;
    }, theme);
    for (const [a, b, contrast] of pairs) assert.ok(contrast >= 4.5, `${theme}: ${a} on ${b}: ${contrast.toFixed(2)}`);
  }
});

test("all went without an error on the console", () => {
  assert.deepEqual(page.faults, []);
});

test("the picture is the one that is kept, within a tolerance", async () => {
  const view = "#t=10&camera=34,-40,26,0,0,4&layers=grid,world&theme=light&panels=";
  const other = await open(browser, run.url + view, { viewport: { width: 420, height: 300 }, deviceScaleFactor: 1 });
  await until(other, () => window.simbeeotic.frame()?.time === 10);
  await rest(other);
  await compare(other, "meadow");
  // Another picture is refused: without the world, and some metres to the side.
  for (const wrong of ["#layers=grid", "#layers=grid,world&camera=34,-36,26,0,4,4"]) {
    const before = await other.evaluate((hash) => {
      const before = JSON.stringify(window.simbeeotic.place());
      location.hash = hash;
      return before;
    }, wrong);
    await until(other, (from) => JSON.stringify(window.simbeeotic.place()) !== from, before);
    await rest(other);
    const seen = await other.locator("#scene").screenshot({ animations: "disabled" });
    assert.notEqual(await verdict(other, kept("meadow"), seen), "", wrong);
  }
  await other.context().close();
});
