// What a picture costs, without the time to draw it:
//   node dev/cost.mjs [VEHICLES ...]
// Draw calls, triangles, bytes sent, the time of scripts, and the garbage they leave.
import { launch } from "../test/browser.mjs";
import { fly, prepare, serveScene, watch } from "./harness.mjs";

const PICTURES = 150;
const counts = process.argv.slice(2).map(Number);
const scene = await serveScene();
const browser = await launch();
const mean = (list) => list.reduce((a, b) => a + b, 0) / list.length;

console.log("vehicles  draw calls  triangles  KiB sent  script, ms (median, 95 %)  garbage, KiB a picture");
for (const n of counts.length > 0 ? counts : [100, 1000, 10_000, 100_000]) {
  const page = await browser.newPage({ viewport: { width: 1280, height: 720 } });
  page.on("pageerror", (error) => console.error(error));
  await page.addInitScript(watch, true);
  await page.goto(`${scene.url}?n=${n}`);
  await page.waitForFunction(() => window.dev, undefined, { timeout: 120_000 });
  await prepare(page);
  const list = await fly(page, PICTURES);
  const most = (key) => Math.round(Math.max(...list.map((x) => x[key])));
  const times = list.map((x) => x.script_ms).sort((a, b) => a - b);
  const at = (share) => times[Math.floor(share * (times.length - 1))].toFixed(2);
  // Once more, with each allocation noted; that costs time of its own.
  const cdp = await page.context().newCDPSession(page);
  await cdp.send("HeapProfiler.startSampling", { samplingInterval: 512, includeObjectsCollectedByMajorGC: true, includeObjectsCollectedByMinorGC: true });
  await fly(page, PICTURES);
  const { profile } = await cdp.send("HeapProfiler.stopSampling");
  const by = new Map();
  const sum = ({ callFrame, selfSize, children }) => {
    const name = `${callFrame.functionName || "(nameless)"}:${callFrame.lineNumber}`;
    by.set(name, (by.get(name) ?? 0) + selfSize);
    children.forEach(sum);
  };
  sum(profile.head);
  // What the measuring itself makes is no garbage of the scene.
  const own = [...by].filter(([name]) => !/^(frame|links|packets|details|wind|random|at|gl\.<computed>|sent|note|drawn|step|\(root\)|\(IDLE\)|\(nameless\)|from)?:/.test(name));
  const garbage = own.reduce((all, [, bytes]) => all + bytes, 0) / (PICTURES + 30) / 1024;
  console.log(
    `${String(n).padStart(8)}  ${String(most("calls")).padStart(10)}  ${String(most("triangles")).padStart(9)}  ` +
      `${(mean(list.map((x) => x.bytes)) / 1024).toFixed(0).padStart(8)}  ${`${at(0.5)}, ${at(0.95)}`.padStart(26)}  ${garbage.toFixed(1).padStart(23)}`,
  );
  if (process.env.WHERE) for (const [name, bytes] of own.sort((a, b) => b[1] - a[1]).slice(0, 25)) console.log(`    ${(bytes / (PICTURES + 30) / 1024).toFixed(2)} KiB  ${name}`);
  await page.close();
}
await browser.close();
scene.close();
