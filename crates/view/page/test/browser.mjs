// A program and a browser for the tests: the real ones. SIMBEEOTIC and CHROMIUM say where they are; with FRESH=1
// the page comes from dist.
import assert from "node:assert/strict";
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

/**
 * A tab with the page, whose swarm has been drawn, as for somebody who knows it, or a `newcomer`. `early`: keys that are
 * pressed as soon as there is a page, before it has anything to draw. What goes wrong in it is in `faults`.
 */
export async function open(browser, url, options = {}) {
  const { newcomer = false, early = [], ...rest } = options;
  const context = await browser.newContext({ viewport: { width: 1000, height: 640 }, reducedMotion: "reduce", acceptDownloads: true, ...rest });
  // The first hints are gone where somebody has used the page.
  if (!newcomer) await context.addInitScript(() => location.protocol.startsWith("http") && localStorage.setItem("simbeeotic.met", "yes"));
  if (early.length > 0) await context.addInitScript(hasten, early);
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
  const shown = () => window.simbeeotic?.frame() && window.simbeeotic.stats().drawn > 0;
  await until(page, shown).catch(async (error) => {
    const text = await page.evaluate(() => document.body.innerText.slice(0, 500));
    throw new Error(`${error.message}\non the console: ${page.faults.join("\n")}\nshown: ${text}`);
  });
  return page;
}

/** Runs in the page before all else: presses keys between the message that makes the page and its first frame. */
function hasten(keys) {
  const seen = new MutationObserver(() => {
    if (!document.querySelector(".page")) return;
    seen.disconnect();
    window.hastened = window.simbeeotic.frame() === null;
    for (const key of keys) document.dispatchEvent(new KeyboardEvent("keydown", { key, bubbles: true }));
  });
  seen.observe(document, { childList: true, subtree: true });
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

/** Waits until all that is to come has come and is drawn, as fine as it gets, and nothing is drawn any more: what stands costs nothing. */
export async function rest(page) {
  await page.evaluate(() => (window.before = -1));
  await page.waitForFunction(
    () => {
      const { drawn } = window.simbeeotic.stats();
      // Twice: what an event has changed is drawn some time later.
      const same = window.simbeeotic.quiet() && window.before === drawn;
      window.before = window.simbeeotic.quiet() ? drawn : -1;
      return same;
    },
    null,
    { polling: 100, timeout: PATIENCE_MS },
  );
}

/** The same, and nothing is drawn for a second, whatever is told meanwhile. */
export async function stands(page) {
  await rest(page);
  const count = () => page.evaluate(() => window.simbeeotic.stats().drawn);
  const before = await count();
  await page.waitForTimeout(1000);
  assert.equal(await count(), before, "pictures of what stands");
}

/** Does something, and waits until the page has said something like `words`, however soon that goes again. */
export async function said(page, words, act) {
  await page.evaluate(() => {
    const box = document.querySelector(".notice");
    window.said = [];
    new MutationObserver(() => window.said.push(box.textContent)).observe(box, { childList: true, characterData: true, attributes: true, subtree: true });
  });
  await act();
  await until(page, ([source, flags]) => window.said.some((text) => new RegExp(source, flags).test(text)), [words.source, words.flags]);
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
    { polling: 150, timeout: PATIENCE_MS },
  );
}

export async function untilTime(page, least_s) {
  await until(page, (t) => window.simbeeotic.time_s() >= t, least_s);
}
