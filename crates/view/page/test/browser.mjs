// A program and a browser for the tests: the real ones. SIMBEEOTIC and CHROMIUM say where they are; with FRESH=1
// the page comes from dist.
import { chromium } from "playwright-core";
import { spawn } from "node:child_process";
import { existsSync, readFileSync } from "node:fs";
import { fileURLToPath } from "node:url";

const root = fileURLToPath(new URL("../../../../", import.meta.url));
export const program = process.env.SIMBEEOTIC ?? `${root}target/debug/simbeeotic`;
export const scenario = (name) => `${root}scenarios/${name}.toml`;
export const here = (path) => fileURLToPath(new URL(path, import.meta.url));

/** For whatever is waited for: this machine may be slow, busy, and without a graphics card. */
export const PATIENCE_MS = Number(process.env.PATIENCE_MS ?? 60_000);

const chromiumPath =
  process.env.CHROMIUM ??
  ["/usr/bin/chromium", "/usr/bin/chromium-browser", "/usr/bin/google-chrome"].find((path) => existsSync(path));

export async function launch() {
  return chromium.launch({
    executablePath: chromiumPath,
    timeout: PATIENCE_MS,
    args: [
      "--no-sandbox",
      // Shared memory may be small where tests run; a picture that does not fit ends the browser.
      "--disable-dev-shm-usage",
      "--disable-quic",
      "--no-first-run",
      "--disable-background-networking",
      "--disable-component-update",
      "--disable-sync",
      "--use-gl=angle",
      "--use-angle=swiftshader",
      "--enable-unsafe-swiftshader",
      "--force-color-profile=srgb",
    ],
  });
}

/** Starts the program with a page on a free port; its `url` is what it printed. */
export async function serve(...args) {
  const port = args.includes("--port") ? [] : ["--port", "0"];
  const child = spawn(program, [...args, ...port], { stdio: ["ignore", "pipe", "pipe"] });
  let said = "";
  const url = await new Promise((resolve, reject) => {
    const timer = setTimeout(() => reject(new Error(`no address within ${PATIENCE_MS} ms:\n${said}`)), PATIENCE_MS);
    const hear = (bytes) => {
      said += bytes;
      const found = /https?:\/\/[^\s"']+/.exec(said);
      if (found && said.includes("\n", found.index)) {
        clearTimeout(timer);
        resolve(found[0]);
      }
    };
    child.stdout.on("data", hear);
    child.stderr.on("data", hear);
    const fail = (error) => {
      clearTimeout(timer);
      reject(error);
    };
    child.on("error", fail);
    child.on("exit", (code) => fail(new Error(`${program} ${args.join(" ")} ended with ${code}:\n${said}`)));
  });
  const exited = new Promise((resolve) => child.on("exit", resolve));
  return {
    url,
    said: () => said,
    exited,
    async kill() {
      if (child.exitCode === null && child.signalCode === null) child.kill("SIGKILL");
      await exited;
    },
  };
}

/** Runs the program to its end. */
export async function execute(...args) {
  const child = spawn(program, args, { stdio: ["ignore", "ignore", "pipe"] });
  let said = "";
  child.stderr.on("data", (bytes) => (said += bytes));
  const code = await new Promise((resolve, reject) => {
    child.on("error", reject);
    child.on("exit", resolve);
  });
  if (code !== 0) throw new Error(`${program} ${args.join(" ")} ended with ${code}:\n${said}`);
}

/** A tab with the page, drawn at least once, as for somebody who knows it, or a `newcomer`. What goes wrong in it is in `faults`. */
export async function open(browser, url, options = {}) {
  const { newcomer = false, ...rest } = options;
  const context = await browser.newContext({ viewport: { width: 1000, height: 640 }, reducedMotion: "reduce", acceptDownloads: true, ...rest });
  // The first hints are gone where somebody has used the page.
  if (!newcomer) await context.addInitScript(() => location.protocol.startsWith("http") && localStorage.setItem("simbeeotic.met", "yes"));
  // While one works on the page: what lies in dist, not what the program embeds.
  if (process.env.FRESH) {
    const types = { "page.js": "text/javascript", "page.css": "text/css" };
    await context.route(/\/page\.(js|css)(\?.*)?$/, (route) => {
      const name = new URL(route.request().url()).pathname.slice(1);
      return route.fulfill({ path: here(`../dist/${name}`), contentType: types[name] });
    });
  }
  const page = await context.newPage();
  page.setDefaultTimeout(PATIENCE_MS);
  page.faults = [];
  page.on("console", (message) => {
    if (["error", "warning"].includes(message.type()) && !unavoidable(message.text())) page.faults.push(message.text());
  });
  page.on("pageerror", (error) => page.faults.push(String(error.stack ?? error)));
  await page.goto(url);
  await drawn(page).catch(async (error) => {
    const shown = await page.evaluate(() => document.body.innerText.slice(0, 500));
    throw new Error(`${error.message}\non the console: ${page.faults.join("\n")}\nshown: ${shown}`);
  });
  return page;
}

/** Drawing without a graphics card is slow, and the browser says so; that is no fault of the page. */
function unavoidable(text) {
  return /GPU stall due to ReadPixels|GL Driver Message|software WebGL|swiftshader/i.test(text);
}

export async function drawn(page, more = 1) {
  await page.waitForFunction((count) => (window.simbeeotic?.stats()?.drawn ?? 0) >= count, more, { timeout: PATIENCE_MS });
}

export const time = (page) => page.evaluate(() => window.simbeeotic.time_s());
export const place = (page) => page.evaluate(() => window.simbeeotic.place());

/** Waits until `holds` (in the page, with `argument`) is true. */
export async function until(page, holds, argument) {
  await page.waitForFunction(holds, argument, { timeout: PATIENCE_MS });
}

/** Has the page save its picture, which is as fine as can be however busy the machine is. */
export async function save(page) {
  const [download] = await Promise.all([page.waitForEvent("download"), page.click("#save-picture")]);
  return download;
}

/** That picture's PNG. */
export const saved = async (page) => readFileSync(await (await save(page)).path());

/** Waits until nothing is drawn any more, for twice a time: what stands costs nothing. */
export async function rest(page, polling = 600) {
  await page.evaluate(() => (window.before = ["", ""]));
  await page.waitForFunction(
    () => {
      const { place, stats } = window.simbeeotic;
      const now = JSON.stringify([place().camera, stats().drawn]);
      const same = window.before.every((it) => it === now);
      window.before = [window.before[1], now];
      return same;
    },
    null,
    // Longer than a picture waits for its finer successor.
    { polling, timeout: PATIENCE_MS },
  );
}

/** Waits until the run is held and the page shows where: what was under way has arrived. */
export async function still(page) {
  await page.evaluate(() => (window.stood = NaN));
  await page.waitForFunction(
    () => {
      const { state, time_s, frame } = window.simbeeotic;
      const held = state();
      const here = held?.paused && Math.abs(held.time_s - time_s()) < 1e-6 && frame()?.time === time_s();
      // The instant that goes on while it is asked to hold comes a little later.
      const stood = here && window.stood === time_s();
      window.stood = here ? time_s() : NaN;
      return stood;
    },
    null,
    { polling: 300, timeout: PATIENCE_MS },
  );
}

export async function untilTime(page, least_s) {
  await until(page, (t) => window.simbeeotic.time_s() >= t, least_s);
}
