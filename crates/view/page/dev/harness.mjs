// The scene by itself (dev.ts) in a browser, and what each of its pictures costs: for measuring and for tests.
import { build } from "esbuild";
import { readFileSync } from "node:fs";
import { createServer } from "node:http";
import { fileURLToPath } from "node:url";

const here = (path) => fileURLToPath(new URL(path, import.meta.url));

/** Serves dev.ts; `close` ends it. */
export async function serveScene() {
  const built = await build({ entryPoints: [here("dev.ts")], bundle: true, format: "esm", write: false, target: "es2022" });
  const script = built.outputFiles[0].text;
  const server = createServer((request, response) => {
    const js = request.url.startsWith("/dev.js");
    if (!js && !/^\/(\?|$)/.test(request.url)) return response.writeHead(404).end();
    response.writeHead(200, { "content-type": js ? "text/javascript" : "text/html" }).end(js ? script : readFileSync(here("index.html")));
  });
  await new Promise((done) => server.listen(0, "127.0.0.1", done));
  return { url: `http://127.0.0.1:${server.address().port}/`, close: () => server.close() };
}

/**
 * Runs in the page before all else. Notes in `window.pictures` what each picture asks of the graphics card: draw calls,
 * triangles, bytes sent, and the time of its scripts. `blind`: the card is spared drawing, so that where there is none
 * the time is that of the scripts alone.
 */
export function watch(blind) {
  const pictures = (window.pictures = []);
  const now = { calls: 0, triangles: 0, bytes: 0, script_ms: 0 };
  const gl = WebGL2RenderingContext.prototype;
  const wrap = (name, note, skip) => {
    const real = gl[name];
    gl[name] = function (...args) {
      note(args);
      return skip ? undefined : real.apply(this, args);
    };
  };
  const drawn = (mode, corners, times = 1) => {
    now.calls += 1;
    if (mode === gl.TRIANGLES) now.triangles += (corners / 3) * times;
  };
  wrap("drawArrays", ([mode, , count]) => drawn(mode, count), blind);
  wrap("drawElements", ([mode, count]) => drawn(mode, count), blind);
  wrap("drawArraysInstanced", ([mode, , count, times]) => drawn(mode, count, times), blind);
  wrap("drawElementsInstanced", ([mode, count, , , times]) => drawn(mode, count, times), blind);
  const sent = (view, first = 0, count = 0) => {
    if (ArrayBuffer.isView(view)) now.bytes += count > 0 ? count * view.BYTES_PER_ELEMENT : view.byteLength - first * view.BYTES_PER_ELEMENT;
  };
  wrap("bufferData", ([, data]) => sent(data));
  wrap("bufferSubData", ([, , data, first, count]) => sent(data, first, count));
  for (const name of ["texImage2D", "texSubImage2D", "texImage3D", "texSubImage3D"]) wrap(name, (args) => sent(args.findLast((x) => ArrayBuffer.isView(x))));
  const request = window.requestAnimationFrame.bind(window);
  window.requestAnimationFrame = (act) =>
    request((time) => {
      const began = performance.now();
      act(time);
      now.script_ms += performance.now() - began;
      if (now.calls === 0) return;
      pictures.push({ ...now });
      Object.assign(now, { calls: 0, triangles: 0, bytes: 0, script_ms: 0 });
    });
}

/** Makes ready what `fly` shows, `ticks` ticks, and switches on everything that the page can show. */
export async function prepare(page, ticks = 40) {
  await page.evaluate((ticks) => {
    const d = window.dev;
    d.view.setLayers({ ...d.layers, links: true, wind: true });
    d.view.setWind(d.wind());
    d.view.select(9);
    d.view.setDetails(d.details(9, 6));
    d.ticks = Array.from({ length: ticks }, (_, k) => d.frame(6 + 0.1 * k));
    d.air = Array.from({ length: 4 }, (_, k) => ({ links: d.links(6 + k), packets: d.packets(6 + k, 16) }));
  }, ticks);
}

/**
 * The swarm flies: `pictures` pictures, three a tick. Returns what each cost;
 * the first ones, while the scene is made and warms up, are left out.
 */
export async function fly(page, pictures, warm = 30) {
  return page.evaluate(
    ([wanted, warm]) =>
      new Promise((done) => {
        const d = window.dev;
        let k = 0;
        const step = () => {
          const tick = Math.floor(k / 3) % (d.ticks.length - 1);
          // Back to the beginning, time jumps: not measured, but allowed.
          d.view.show(d.ticks[tick], d.ticks[tick + 1], (k % 3) / 3);
          if (k % 30 === 0) d.view.setLinks(d.air[(k / 30) % 4].links);
          if (k % 15 === 0) d.view.addPackets(d.air[(k / 15) % 4].packets, 1);
          k += 1;
          if (window.pictures.length < wanted + warm) requestAnimationFrame(step);
          else done(window.pictures.slice(warm, warm + wanted));
        };
        window.pictures.length = 0;
        step();
      }),
    [pictures, warm],
  );
}
