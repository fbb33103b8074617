// The parts of the scene that only compute: colours, turns, picking, the camera.
import { build } from "esbuild";
import assert from "node:assert/strict";
import { test } from "node:test";
import { fileURLToPath } from "node:url";

const folder = fileURLToPath(new URL("..", import.meta.url));
const { outputFiles } = await build({
  stdin: {
    contents: ["math", "colours", "paint", "picking", "camera", "beams", "radio", "overlay", "near", "darts", "pace", "wind"].map((f) => `export * as ${f} from "./src/scene/${f}";`).join("\n"),
    resolveDir: folder,
  },
  bundle: true,
  format: "esm",
  platform: "neutral",
  mainFields: ["module", "main"],
  write: false,
});
const { math, colours, paint, picking, camera, beams, radio, overlay, near: nearby, darts, pace, wind } = await import(`data:text/javascript;base64,${Buffer.from(outputFiles[0].text).toString("base64")}`);

const near = (a, b, within = 1e-6) => {
  assert.equal(a.length, b.length);
  a.forEach((x, i) => assert.ok(Math.abs(x - b[i]) <= within, `${a} is not ${b}`));
};
const half = Math.SQRT1_2;

test("a quarter turn to the left takes east to north", () => {
  near(math.rotate([half, 0, 0, half], [1, 0, 0]), [0, 1, 0]);
});

test("turns one after the other are the product, the last on the left", () => {
  const [a, b] = [[half, 0, 0, half], [half, half, 0, 0]];
  const v = [0.3, -2, 5];
  near(math.rotate(math.multiply(a, b), v), math.rotate(a, math.rotate(b, v)));
  near(math.rotate(math.conjugate(a), math.rotate(a, v)), v);
});

test("between two attitudes it goes the short way round, whatever their signs", () => {
  const to = [Math.cos(0.2), 0, 0, Math.sin(0.2)];
  const minus = to.map((x) => -x);
  const between = [Math.cos(0.1), 0, 0, Math.sin(0.1)];
  near(math.slerp([1, 0, 0, 0], to, 0.5), between);
  near(math.slerp([1, 0, 0, 0], minus, 0.5), between);
  near(math.slerp([0, 0, 0, 0], [0, 0, 0, 0], 0.5), [1, 0, 0, 0]);
});

test("between two attitudes it turns at an even rate", () => {
  const at = (angle) => [Math.cos(angle / 2), 0, 0, Math.sin(angle / 2)];
  for (const f of [0, 0.25, 0.5, 0.9, 1]) near(math.slerp(at(0), at(2.8), f), at(2.8 * f));
  near(math.slerp(at(1), at(1.01), 0.3), at(1.003));
});

test("x can be turned into every direction, backwards too", () => {
  for (const d of [[1, 0, 0], [-1, 0, 0], [0, 0, 1], [0, -1, 0], [3, -4, 12]]) {
    near(math.rotate(math.fromX(d), [1, 0, 0]), math.unit(d), 1e-5);
  }
});

test("a ray hits a triangle from both sides, and not beside or behind it", () => {
  const t = [[0, 0, 0], [1, 0, 0], [0, 1, 0]];
  assert.equal(math.rayTriangle([0.2, 0.2, 3], [0, 0, -1], ...t), 3);
  assert.equal(math.rayTriangle([0.2, 0.2, -2], [0, 0, 1], ...t), 2);
  assert.equal(math.rayTriangle([0.8, 0.8, 3], [0, 0, -1], ...t), Infinity);
  assert.equal(math.rayTriangle([0.2, 0.2, 3], [0, 0, 1], ...t), Infinity);
  assert.equal(math.rayTriangle([0.2, 0.2, 3], [1, 0, 0], ...t), Infinity);
});

test("a ball is met in front, not behind, and not beyond what hides it", () => {
  const meets = (x, limit) => math.rayMeetsBall([0, 0, 0], [1, 0, 0], x, 0.5, 0, 1, limit);
  assert.ok(meets(5, 100));
  assert.ok(!meets(-5, 100));
  assert.ok(!meets(5, 3));
  assert.ok(!math.rayMeetsBall([0, 0, 0], [1, 0, 0], 5, 1.5, 0, 1, 100));
});

test("round lengths are 1, 2, 5 times a power of ten", () => {
  assert.deepEqual([0.7, 1, 1.9, 4.99, 7, 130].map(math.niceBelow), [0.5, 1, 1, 2, 5, 100]);
  assert.deepEqual([0.0042, 0.5, 12.345, 20000].map(overlay.metres), ["4.2 mm", "50 cm", "12.3 m", "20 km"]);
});

test("a scale of colours runs from its first to its last, and NaN is grey", () => {
  const stops = colours.SCALES.value;
  assert.equal(colours.css(colours.sample(stops, 0)), stops[0]);
  assert.equal(colours.css(colours.sample(stops, -3)), stops[0]);
  assert.equal(colours.css(colours.sample(stops, 1)), stops.at(-1));
  assert.equal(colours.css(colours.sample(stops, 0.5)), stops[(stops.length - 1) / 2]);
  assert.deepEqual(colours.sample(stops, NaN), colours.GREY);
});

test("the scale for values grows lighter from low to high, for eyes of every kind", () => {
  const light = (c) => 0.2126 * colours.linear(c[0]) + 0.7152 * colours.linear(c[1]) + 0.0722 * colours.linear(c[2]);
  let last = -1;
  for (let i = 0; i <= 20; i++) {
    const now = light(colours.sample(colours.SCALES.value, i / 20));
    assert.ok(now > last, `step ${i}`);
    last = now;
  }
});

test("colours are read with and without opacity, and nothing else is one", () => {
  assert.deepEqual(colours.parseColour("#ff8000"), [255, 128, 0, 255]);
  assert.deepEqual(colours.parseColour("#FF800040"), [255, 128, 0, 64]);
  for (const bad of ["", "red", "#fff", "#12345g", "#1234567", "url(x)"]) assert.equal(colours.parseColour(bad), null, bad);
});

test("a range leaves outliers out, and its ends are round", () => {
  const values = Float32Array.from({ length: 1000 }, (_, i) => i / 100);
  values[500] = 1e6;
  values[501] = NaN;
  const [low, high] = colours.robustRange(values);
  assert.deepEqual([low, high], [0, 10]);
  assert.equal(colours.robustRange(new Float32Array([NaN, NaN])), null);
  const [a, b] = colours.robustRange(new Float32Array([3, 3, 3]));
  assert.ok(a < 3 && b > 3);
});

test("a range stays while values wander within it, and follows them when they leave", () => {
  assert.deepEqual(colours.steadyRange([0, 10], [1, 9]), [0, 10]);
  assert.deepEqual(colours.steadyRange([0, 10], [1, 12]), [0, 12]);
  assert.deepEqual(colours.steadyRange([0, 10], [4, 5]), [4, 5]);
  assert.deepEqual(colours.steadyRange([0, 10], [20, 30]), [20, 30]);
  assert.deepEqual(colours.steadyRange([0, 10], null), [0, 10]);
});

test("kinds get colours that differ, and keep those of the run that tell them apart", () => {
  const hello = (colors) => ({ vehicles: { kinds: ["a", "b", "a"], colors } });
  const same = paint.coloursOfKinds(hello(["#101010", "#101010", "#101010"]));
  assert.deepEqual(same.colours[0], [16, 16, 16]);
  assert.notDeepEqual(same.colours[0], same.colours[1]);
  assert.deepEqual(same.colours[0], same.colours[2]);
  const given = paint.coloursOfKinds(hello(["#ff0000", "#00ff00", "#0000ff"]));
  assert.deepEqual(given.colours, [[255, 0, 0], [0, 255, 0], [0, 0, 255]]);
  const many = paint.coloursOfKinds({ vehicles: { kinds: [..."abcdefg"], colors: Array(7).fill("#f0b21e") } });
  assert.equal(new Set(many.names.map(([, c]) => c)).size, 7);
  assert.deepEqual(given.names, [["a", "#ff0000"], ["b", "#00ff00"], ["a", "#0000ff"]]);
});

test("the colour of speed is of the frame's velocities, and its legend says so", () => {
  const legends = [];
  const hello = { vehicles: { kinds: ["a", "a", "a"], colors: ["#101010", "#101010", "#101010"] } };
  const p = new paint.Paint(hello, 3, (l) => legends.push(l));
  p.set("speed", "speed", "");
  const frame = { time: 0, n: 3, positions: new Float32Array(9), velocities: new Float32Array([0, 0, 0, 3, 4, 0, NaN, 0, 0]), values: null, attitudes: new Int16Array(12) };
  p.update(frame);
  assert.equal(colours.css(p.colour(0)), colours.SCALES.speed[0]);
  assert.equal(colours.css(p.colour(1)), colours.SCALES.speed.at(-1));
  assert.deepEqual(p.colour(2), [...colours.GREY]);
  assert.deepEqual([legends.at(-1).low, legends.at(-1).high, legends.at(-1).unit], [0, 5, "m/s"]);
  const before = legends.length;
  p.update({ ...frame });
  assert.equal(legends.length, before, "an unchanged legend is not told again");
});

test("the camera's own matrices put the target into the middle, with and without perspective", () => {
  for (const flat of [false, true]) {
    const orbit = new camera.Orbit();
    orbit.resize(800, 600);
    orbit.set({ from: [10, -20, 30], at: [1, 2, 3], flat });
    orbit.apply();
    const view = orbit.camera.projectionMatrix.clone().multiply(orbit.camera.matrixWorldInverse).elements;
    const at = math.project(view, [1, 2, 3], 800, 600);
    near([at.x, at.y], [400, 300], 1e-3);
    const { from, along } = orbit.ray(0, 0);
    const away = math.sub([1, 2, 3], from);
    near(math.unit(away), along, 1e-4);
    near(orbit.state().from, [10, -20, 30], 1e-3);
    assert.equal(orbit.state().flat, flat);
  }
});

test("from the top, north is up and east is right, and a metre is as long everywhere", () => {
  const orbit = new camera.Orbit();
  orbit.resize(800, 600);
  orbit.set({ from: [0, 0, 50], at: [0, 0, 0], flat: true });
  orbit.apply();
  const view = orbit.camera.projectionMatrix.clone().multiply(orbit.camera.matrixWorldInverse).elements;
  const at = (p) => math.project(view, p, 800, 600);
  assert.ok(at([0, 1, 0]).y < 299 && Math.abs(at([0, 1, 0]).x - 400) < 1e-3);
  assert.ok(at([1, 0, 0]).x > 401);
  near([at([1, 0, 0]).x - 400], [at([1, 0, 20]).x - 400], 1e-3);
  near([at([1, 0, 0]).x - 400], [1 / orbit.pixel()], 1e-3);
});

test("all points are in sight after a fit, and not lost in the middle", () => {
  const points = [];
  for (let i = 0; i < 200; i++) points.push([30 + 9 * Math.sin(i * 1.7), -5 + 40 * Math.cos(i * 2.3), 6 + 5 * Math.sin(i * 3.1)]);
  for (const flat of [false, true]) {
    const orbit = new camera.Orbit();
    orbit.resize(1280, 720);
    orbit.set({ from: [20, -30, 12], at: [0, 0, 0], flat });
    orbit.fit(points, 0.2, true);
    orbit.reach = 200;
    orbit.apply();
    const view = orbit.camera.projectionMatrix.clone().multiply(orbit.camera.matrixWorldInverse).elements;
    const seen = points.map((p) => math.project(view, p, 1280, 720));
    assert.ok(seen.every((s) => s && s.x > 0 && s.x < 1280 && s.y > 0 && s.y < 720), `flat ${flat}`);
    const wide = Math.max(...seen.map((s) => s.x)) - Math.min(...seen.map((s) => s.x));
    const high = Math.max(...seen.map((s) => s.y)) - Math.min(...seen.map((s) => s.y));
    assert.ok(wide > 640 || high > 360, `${wide} x ${high}`);
  }
});

test("what a panel covers is no place for points after a fit, and the target is in the middle of the rest", () => {
  const points = [];
  for (let i = 0; i < 200; i++) points.push([30 * Math.sin(i * 1.7), 30 * Math.cos(i * 2.3), 6 + 5 * Math.sin(i * 3.1)]);
  for (const flat of [false, true]) {
    const orbit = new camera.Orbit();
    orbit.resize(1000, 600);
    orbit.covered_px = 250;
    orbit.set({ from: [20, -30, 12], at: [0, 0, 0], flat });
    orbit.fit(points, 0.2, true);
    orbit.reach = 200;
    orbit.apply();
    const view = orbit.camera.projectionMatrix.clone().multiply(orbit.camera.matrixWorldInverse).elements;
    const seen = points.map((p) => math.project(view, p, 1000, 600));
    assert.ok(seen.every((s) => s && s.x > 250 && s.x < 1000 && s.y > 0 && s.y < 600), `flat ${flat}`);
    near([math.project(view, orbit.target(), 1000, 600).x], [625], 1e-6);
    const { along } = orbit.ray(0.25, 0);
    near(along, orbit.axes()[0].map((x) => -x), 1e-6);
  }
});

test("a picture that stands is as fine as patience allows, and never coarser than one that moves", () => {
  assert.equal(pace.atRest(0.5, 0, 2), 2, "before anything was measured");
  assert.equal(pace.atRest(0.5, 50, 2), 2);
  assert.equal(pace.atRest(0.5, 130, 2), 1.5);
  assert.equal(pace.atRest(0.5, 2000, 2), 1, "as fine as the screen, however long that takes");
  assert.equal(pace.atRest(1, 1e5, 1), 1);
});

test("the camera comes to rest, and exactly where it was sent", () => {
  const orbit = new camera.Orbit();
  orbit.resize(800, 600);
  orbit.setView("north");
  let steps = 0;
  while (orbit.step(0.016) && steps < 1000) steps++;
  assert.ok(steps > 3 && steps < 200, `${steps} steps`);
  const { from, at, flat } = orbit.state();
  assert.ok(flat);
  near(math.unit(math.sub(from, at)), [0, 1, 0], 1e-3);
  assert.ok(!orbit.step(0.016));
});

test("a camera that follows keeps its distance, and can be turned meanwhile", () => {
  const orbit = new camera.Orbit();
  orbit.resize(800, 600);
  orbit.set({ from: [0, -10, 5], at: [0, 0, 0], flat: false });
  let bee = [3, 0, 1];
  orbit.follow(() => bee);
  while (orbit.step(0.016));
  near(orbit.state().at, [3, 0, 1], 1e-3);
  bee = [100, 50, 7];
  const { from, at } = orbit.state();
  near(at, bee, 1e-3);
  near(math.sub(from, at), [0, -10, 5], 0.01);
  orbit.orbit(100, 0);
  while (orbit.step(0.016));
  near(orbit.state().at, bee, 1e-3);
  orbit.follow(null);
  bee = [0, 0, 0];
  while (orbit.step(0.016));
  near(orbit.state().at, [100, 50, 7], 1e-3);
});

test("a camera that follows looks at whom it follows after a fit, too", () => {
  const orbit = new camera.Orbit();
  orbit.resize(800, 600);
  orbit.follow(() => [50, 60, 7]);
  orbit.fit([[0, 0, 0], [10, 10, 10]], 0, true);
  near(orbit.state().at, [50, 60, 7], 1e-3);
});

test("from the side a floor is near the lower edge, unless it is out of sight or the view is another", () => {
  const orbit = new camera.Orbit();
  orbit.resize(800, 600);
  const fit = (view, low, high) => {
    orbit.setView(view);
    orbit.fit([[-20, 0, low], [20, 0, high]], 0, true);
    const before = orbit.state().at[2];
    orbit.standOn(0, true);
    const half = orbit.distance() * Math.tan(Math.PI / 9);
    return [before, orbit.state().at[2], half];
  };
  const [middle, at, half] = fit("south", 0, 4);
  near([middle, at], [2, 0.8 * half], 1e-3);
  for (const [view, low, high] of [["south", 100, 104], ["top", 0, 4], ["orbit", 0, 4]]) {
    const [before, after] = fit(view, low, high);
    near([after], [before], 1e-6);
  }
});

test("a wheel keeps what is under the pointer where it is", () => {
  const orbit = new camera.Orbit();
  orbit.resize(800, 600);
  orbit.set({ from: [0, 0, 50], at: [0, 0, 0], flat: true });
  orbit.apply();
  const place = () => {
    const { from, along } = orbit.ray(0.5, -0.25);
    return math.add(from, math.scale(along, -from[2] / along[2])).slice(0, 2);
  };
  const before = place();
  orbit.zoomBy(0.3, 0.5, -0.25);
  while (orbit.step(0.016));
  orbit.apply();
  near(place(), before, 1e-3);
  near([orbit.distance()], [15], 1e-3);
});

test("a click takes the nearest vehicle within reach, and the one in front of two", () => {
  const orbit = new camera.Orbit();
  orbit.resize(800, 600);
  orbit.set({ from: [0, 0, 50], at: [0, 0, 0], flat: false });
  orbit.apply();
  const view = orbit.camera.projectionMatrix.clone().multiply(orbit.camera.matrixWorldInverse).elements;
  const places = [[0, 0, 0], [0, 0, 10], [10, 0, 0], [NaN, 0, 0]];
  const at = (x, y) => picking.nearest(4, (i) => (places[i].every(Number.isFinite) ? places[i] : null), view, 800, 600, x, y, () => 3);
  assert.equal(at(400, 300), 1);
  const right = math.project(view, places[2], 800, 600);
  assert.equal(at(right.x + 9, right.y), 2);
  assert.equal(at(right.x + 40, right.y), null);
});

test("rays are as long as the column of metres says, if there is a row for each", () => {
  const sensor = { columns: [["angle", "rad"], ["range", "m"]], reading: [0, 1.5, 0.1, null], lost: false };
  assert.deepEqual(beams.rayLengths(sensor, 2), [1.5, null]);
  assert.equal(beams.rayLengths(sensor, 3), null);
  assert.equal(beams.rayLengths({ ...sensor, lost: true }, 2), null);
  assert.equal(beams.rayLengths({ ...sensor, reading: null }, 2), null);
  assert.equal(beams.rayLengths({ ...sensor, columns: [["", "rad"], ["", "rad"]] }, 2), null);
});

test("a stronger signal is drawn stronger, between nothing and all", () => {
  assert.equal(radio.strength(-200), 0);
  assert.equal(radio.strength(0), 1);
  assert.ok(radio.strength(-60) > radio.strength(-80));
});

test("the scale of links goes from the weakest signal, faint, to the strongest", () => {
  const { stops, low, high } = radio.linkScale(false);
  const opacities = stops.map((text) => Number(/\/ ([\d.]+)\)$/.exec(text)[1]));
  assert.ok(opacities.every((x, k) => k === 0 || x > opacities[k - 1]), `${opacities}`);
  assert.deepEqual([low, high, opacities.at(-1)], ["−95", "−45\u00a0dBm", 1]);
  assert.equal(radio.strength(-95), 0);
  assert.equal(radio.strength(-45), 1);
});

/** Three layers of nine places, 10 m apart, wind to the east, faster the higher. */
const air = [0, 10, 20].flatMap((z) => [-10, 0, 10].flatMap((y) => [-10, 0, 10].map((x) => [x, y, z, 1 + z / 10, 0, 0])));

test("from above and from a side there are arrows of the layer that is looked at, and of all else", () => {
  const shown = new wind.Wind({});
  shown.set(air);
  assert.equal(shown.mesh.count, 27);
  for (const [axis, target, at] of [[2, [0, 0, 12], 10], [2, [0, 0, 400], 20], [1, [3, -9, 5], -10], [0, [4, 0, 0], 0]]) {
    shown.look(axis, target);
    assert.equal(shown.mesh.count, 9, `along ${axis}`);
    assert.ok(shown.drawn.every(({ from }) => from[axis] === at), `along ${axis}: ${JSON.stringify(shown.drawn[0])}`);
  }
  shown.set([]);
  assert.equal(shown.mesh.count, 0);
  shown.look(null, [0, 0, 0]);
  shown.set(air);
  assert.equal(shown.mesh.count, 27);
});

test("an arrow tells its speed by its length, and a breath is no gale", () => {
  const shown = new wind.Wind({});
  const reach = () => Math.max(...shown.drawn.map(({ from, to }) => math.length(math.sub(to, from))));
  shown.set(air);
  const gale = reach();
  const [slow, fast] = [shown.drawn[0], shown.drawn[26]];
  near([(slow.to[0] - slow.from[0]) / (fast.to[0] - fast.from[0])], [Math.sqrt(slow.speed_m_s / fast.speed_m_s)]);
  assert.equal(wind.longest(air), "3\u00a0m/s");
  shown.set(air.map(([x, y, z]) => [x, y, z, 0, 0.04, 0]));
  near([reach() / gale], [0.2]);
  assert.equal(wind.longest([[0, 0, 0, 0, 0, 0]]), "", "still air has no arrows");
  assert.equal(wind.longest([]), "");
});

test("a view knows which axis it looks along, once it is there", () => {
  const orbit = new camera.Orbit();
  orbit.resize(800, 600);
  for (const [view, axis] of [["top", 2], ["north", 1], ["east", 0], ["south", 1], ["west", 0], ["orbit", null]]) {
    orbit.setView(view);
    while (orbit.step(0.016));
    assert.equal(orbit.along(), axis, view);
  }
});

test("a line is pointed at where it is drawn, and not beyond its ends", () => {
  const orbit = new camera.Orbit();
  orbit.resize(800, 600);
  orbit.set({ from: [0, 0, 50], at: [0, 0, 0], flat: true });
  orbit.apply();
  const view = orbit.camera.projectionMatrix.clone().multiply(orbit.camera.matrixWorldInverse).elements;
  const lines = [[[-5, 5, 0], [5, 5, 0]], null, [[-5, 0, 0], [5, 0, 3]]];
  const at = (x, y, off = 0) => {
    const p = math.project(view, [x, y, 0], 800, 600);
    return picking.nearestLine(lines, view, 800, 600, p.x, p.y + off);
  };
  assert.deepEqual([at(0, 5), at(2, 0), at(-4.9, 0, 3), at(2, 0, 9), at(6, 0)], [0, 2, 2, null, null]);
});

test("near are those that are large on the screen and in the picture, whatever else there is", () => {
  const orbit = new camera.Orbit();
  orbit.resize(800, 600);
  orbit.set({ from: [0, 0, 10], at: [0, 0, 0], flat: false });
  orbit.apply();
  const view = orbit.camera.projectionMatrix.clone().multiply(orbit.camera.matrixWorldInverse).elements;
  const scale = (orbit.camera.projectionMatrix.elements[5] * 600) / 2;
  // In the middle, below the ground and far, behind the eye, beside the picture, nowhere, in the middle and tiny.
  const positions = Float32Array.from([0, 0, 8, 0, 0, -900, 0, 0, 12, 500, 0, 8, NaN, 0, 0, 0.1, 0, 8]);
  const frame = { positions, n: 6 };
  const swarm = { a: frame, b: frame, f: 0.5 };
  const out = new Float32Array(4);
  const radii = [0.1, 0.1, 0.1, 0.1, 0.1, 0.001];
  assert.equal(nearby.findNear(swarm, [0, 1, 2, 3, 4, 5, 99], radii, view, scale, 9, out), 1);
  assert.equal(out[0], 0);
  assert.equal(nearby.findNear(swarm, [0, 0, 0, 0, 0, 0], radii, view, scale, 9, out), 6, "more than fit are counted");
});

test("a dart never gets too small to see, and a nearer one is larger", () => {
  const least = (depth) => darts.Darts.least(4, depth, 100, false);
  assert.ok(least(1e6) >= 3 && least(1e6) < least(100) && least(100) < least(60) && least(1e-9) <= 5.4);
  assert.equal(least(100), 4);
  assert.equal(darts.Darts.least(4, 1, 100, true), 4);
});
