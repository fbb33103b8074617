// Takes the pictures of the page for the book.
//   SIMBEEOTIC=program node test/gallery.mjs FOLDER [NAME ...]
// NAME: live, replay, dark, many; without names all. One JPEG each, `page-NAME.jpg`.
import { mkdirSync, mkdtempSync, rmSync, statSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { execute, launch, open, scenario, serve, still, until, untilTime } from "./browser.mjs";

/** How long a picture is waited for to stand still. */
const STILL_MS = 60_000;
const BYTES_MAX = 300 * 1024;
const [folder, ...names] = process.argv.slice(2);
if (!folder) {
  console.error("usage: node test/gallery.mjs FOLDER [NAME ...]");
  process.exit(2);
}
const wanted = (name) => names.length === 0 || names.includes(name);
const size = { width: 1280, height: 760 };

mkdirSync(folder, { recursive: true });
const scratch = mkdtempSync(join(tmpdir(), "simbeeotic-gallery-"));
const browser = await launch();

async function select(page, name) {
  await page.keyboard.press("/");
  await page.keyboard.type(name);
  await page.keyboard.press("Enter");
  await page.locator("#parameters").waitFor({ state: "attached" });
}

/** Takes the picture once nothing moves any more: fine, not as coarse as it is drawn in motion. */
async function take(page, name) {
  await page.mouse.move(size.width / 2, 4);
  const until_ms = Date.now() + STILL_MS;
  let before = -1;
  while (Date.now() < until_ms) {
    const { drawn } = await page.evaluate(() => window.simbeeotic.stats());
    if (drawn === before) break;
    before = drawn;
    await page.waitForTimeout(1500);
  }
  const path = join(folder, `page-${name}.jpg`);
  await page.screenshot({ path, type: "jpeg", quality: 86, animations: "disabled", timeout: 120_000 });
  const bytes = statSync(path).size;
  console.log(`${path}: ${Math.round(bytes / 1024)} KiB`);
  if (bytes > BYTES_MAX) console.error(`${path} has more than ${BYTES_MAX / 1024} KiB`);
  if (page.faults.length > 0) throw new Error(page.faults.join("\n"));
  await page.context().close();
}

try {
  if (wanted("live")) {
    const run = await serve("run", scenario("meadow"), "--view", "--paused", "--no-record", "--real-time", "5");
    const page = await open(browser, `${run.url}#camera=30,-34,22,0,2,3&layers=links,packets,beams,trails,grid,world&theme=light`, { viewport: size });
    await page.keyboard.press("Space");
    await untilTime(page, 30);
    await page.keyboard.press("0");
    await select(page, "bee-3");
    await untilTime(page, (await page.evaluate(() => window.simbeeotic.time_s())) + 2);
    await page.keyboard.press("Space");
    await still(page);
    await take(page, "live");
    await run.kill();
  }
  if (wanted("replay") || wanted("dark")) {
    const recording = join(scratch, "meadow.mcap");
    await execute("run", scenario("meadow"), "--end-time", "60 s", "--record", recording, "--quiet");
    for (const [name, view] of [
      ["replay", "#t=32&select=scout-3&camera=30,-34,22,0,2,3&layers=links,packets,beams,trails,grid,world&colour=kind&theme=light"],
      ["dark", "#t=41&select=bee-7&camera=-24,-30,18,0,0,3&layers=links,packets,beams,trails,grid,world&colour=battery&theme=dark"],
    ]) {
      if (!wanted(name)) continue;
      // One each: the program ends some time after its last page.
      const run = await serve("view", recording);
      const page = await open(browser, run.url + view, { viewport: size });
      await page.locator("#parameters").waitFor({ state: "attached" });
      await until(page, () => {
        const frame = window.simbeeotic.frame();
        return frame && Math.abs(frame.time - window.simbeeotic.time_s()) < 0.01;
      });
      await take(page, name);
      await run.kill();
    }
  }
  if (wanted("many")) {
    const run = await serve(
      "run", scenario("first-swarm"), "--view", "--paused", "--no-record",
      "--set", "model.bee.count=10000", "--set", "model.bee.start.ball=20 m", "--set", "model.bee.start.center=[\"0 m\", \"0 m\", \"22 m\"]",
    );
    const page = await open(browser, `${run.url}#theme=light&colour=speed`, { viewport: size });
    await page.keyboard.press("Space");
    await untilTime(page, 2);
    await page.keyboard.press("Space");
    await still(page);
    await page.keyboard.press("a");
    await take(page, "many");
    await run.kill();
  }
} finally {
  await browser.close();
  rmSync(scratch, { recursive: true, force: true });
}
