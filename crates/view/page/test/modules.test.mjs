// What needs no browser: messages, links, numbers, the cache and the plan of a replay; and that dist is built.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { test } from "node:test";
import { fileURLToPath } from "node:url";
import { sources } from "./sources.mjs";

const { axis, caption, decode, place, format, series, replay, live, keys, run } = await sources({
  axis: "core/axis.ts",
  caption: "ui/caption.ts",
  decode: "decode.ts",
  place: "core/place.ts",
  format: "core/format.ts",
  series: "core/series.ts",
  replay: "player/replay.ts",
  live: "player/live.ts",
  keys: "ui/keys.ts",
  run: "run.ts",
});

function frameBytes(time, n, columns) {
  const size = 16 + 12 * n + (columns & 1 ? 12 * n : 0) + (columns & 2 ? 4 * n : 0) + 8 * n;
  const bytes = new ArrayBuffer(size);
  const view = new DataView(bytes);
  view.setUint8(0, 1);
  view.setUint8(1, columns);
  view.setUint32(4, n, true);
  view.setFloat64(8, time, true);
  for (let k = 0; k < 3 * n; k += 1) view.setFloat32(16 + 4 * k, k + 0.5, true);
  if (columns & 2) for (let k = 0; k < n; k += 1) view.setFloat32(size - 12 * n + 4 * k, 10 * k, true);
  for (let k = 0; k < 4 * n; k += 1) view.setInt16(size - 8 * n + 2 * k, -k, true);
  return bytes;
}

const frameAt = (time) => decode.decode(frameBytes(time, 2, 1)).frame;

test("a frame is read with any of its columns", () => {
  for (const columns of [0, 1, 2, 3]) {
    const { kind, frame } = decode.decode(frameBytes(2.5, 3, columns));
    assert.equal(kind, "frame");
    assert.equal(frame.time, 2.5);
    assert.equal(frame.n, 3);
    assert.deepEqual([...frame.positions.slice(0, 3)], [0.5, 1.5, 2.5]);
    assert.equal(frame.velocities === null, (columns & 1) === 0);
    assert.deepEqual(frame.values && [...frame.values], columns & 2 ? [0, 10, 20] : null);
    assert.equal(frame.attitudes[11], -11);
  }
});

test("a message that is cut short or of another kind is none", () => {
  const whole = frameBytes(0, 3, 3);
  for (const size of [0, 8, 16, 40, whole.byteLength - 1]) assert.equal(decode.decode(whole.slice(0, size)), null);
  const other = frameBytes(0, 0, 0);
  new DataView(other).setUint8(0, 77);
  assert.equal(decode.decode(other), null);
  const many = frameBytes(0, 0, 0);
  new DataView(many).setUint32(4, 0xffffffff, true);
  assert.equal(decode.decode(many), null);
});

test("a link is read as it was written", () => {
  const view = {
    t_s: 12.5,
    camera: { from: [1.25, -2, 3], at: [0, 0, 5.001], flat: true },
    select: "hive/bee 3&4",
    follow: true,
    layers: { labels: true, trails: false, links: true, packets: false, beams: false, wind: true, grid: false, world: true, cut: true },
    colour: { by: "value", name: "net/hops" },
    theme: "dark",
    charts: [{ name: "packets/sent", own: false }, { name: "battery/soc", own: true }],
    panels: ["layers", "charts"],
    marks: "contact",
  };
  assert.deepEqual(place.readPlace(`#${place.writePlace(view)}`), view);
  assert.deepEqual(place.readPlace(""), {});
});

test("a link with nonsense in it is read as far as it makes sense", () => {
  const view = place.readPlace("#t=soon&camera=1,2,x,4,5,6&theme=pink&colour=smell&select=bee-1");
  assert.deepEqual(view, { select: "bee-1" });
});

test("numbers and times are short and do not lie", () => {
  assert.equal(format.time(59.999), "59.99 s");
  assert.equal(format.time(0.1 + 0.2, 1), "0.3 s");
  assert.equal(format.time(123.456, 1), "2:03.4");
  assert.equal(format.time(3723.5, 1), "1:02:03.5");
  assert.equal(format.number(0.00412), "0.00412");
  assert.equal(format.number(1234567), "1.23 M");
  assert.equal(format.number(-12.345), "−12.3");
  assert.equal(format.number(NaN), "–");
  assert.equal(format.number(999.96), "1000");
  assert.equal(format.number(999_999_999), "1.00 G");
  assert.equal(format.number(999_999.9), "1.00 M");
  assert.equal(format.number(2.5e-7), "2.5×10⁻⁷");
  assert.equal(format.number(-4e21), "−4×10²¹");
  assert.equal(format.unit("1/s"), "\u00a0/s");
  assert.equal(format.words("planned/out/mean"), "planned out (mean)");
  assert.equal(format.factor(0.25), "0.25 ×");
  assert.equal(format.factor(100), "100 ×");
  assert.equal(format.factor(1), "1 ×");
  assert.equal(format.fixed(-0.001, 2), "0.00");
});

const lineOf = (name, unit, vehicle = null) => new series.Line({ id: 1, name, unit, vehicle });

test("a chart tells numbers with their unit: shares in percent, rates each second, nothing as nothing", () => {
  const told = (value, ...about) => {
    const measure = axis.measureOf(lineOf(...about));
    return axis.told(value === null ? null : value * measure.times, measure).replaceAll("\u00a0", " ");
  };
  assert.equal(told(0.4567, "packets/delivery", "1"), "45.7 %");
  assert.equal(told(1, "battery/soc/mean", "1"), "100 %");
  assert.equal(told(0.98, "speed", "1"), "0.98 ×");
  assert.equal(told(3, "speed", "m/s", 4), "3 m/s", "a vehicle's own number of this name");
  assert.equal(told(89.41, "packets/received", "1/s"), "89.4 /s");
  assert.equal(told(7, "pollen", "1"), "7");
  assert.equal(told(null, "energy", "J"), "–");
});

test("a mean over a time in which nothing happened is nothing, whatever was before", () => {
  const times = [0, 0.1, 0.2, 0.3, 1.4, 1.5];
  assert.deepEqual(axis.meanOver(times, [0.1, 0.7, 1 / 3, 1e9 / 3, 0, 0], 1).slice(-2), [0, 0]);
  assert.deepEqual(axis.meanOver(times, [2, null, 4, 6, 8, null], 1), [2, null, 3, 4, 8, null]);
});

test("a chart of a rate is as high as what came after the first moment, if that alone is far above", () => {
  const times = [0, 0.1, 1, 2, 3];
  assert.deepEqual(axis.extentOf(times, [1e6, 5e5, 4400, 4300, 4500], 1), [4300, 4500]);
  assert.deepEqual(axis.extentOf(times, [5, 6, 4, null, 2], 1), [2, 6], "not far above");
  assert.deepEqual(axis.extentOf(times, [7, 0, 0, 0, 0], 1), [0, 7], "nothing came after");
  assert.deepEqual(axis.extentOf([], [], 1), [null, null]);
});

test("labels of an axis tell its steps apart, and are short", () => {
  assert.deepEqual([0, 50_000, 100_000].map((x) => axis.labelOf(x, 50_000)), ["0", "50 k", "100 k"]);
  assert.deepEqual([0, 0.5, 1].map((x) => axis.labelOf(x, 0.5)), ["0", "0.5", "1.0"]);
  assert.deepEqual([3.98, 4, 4.02].map((x) => axis.labelOf(x, 0.02)), ["3.98", "4.00", "4.02"]);
  assert.equal(axis.labelOf(2e-6, 1e-6), "2×10⁻⁶");
  assert.equal(axis.timeLabel(90, 30), "1:30");
  assert.deepEqual(axis.timeRange(0.2, 53), [0, 53]);
  assert.deepEqual(axis.timeRange(40, 53), [40, 53]);
  assert.deepEqual(axis.timeRange(null, null), [0, 1]);
});

test("a long series is thinned, and keeps its newest value and its span", () => {
  const line = new series.Line({ id: 1, name: "x", unit: "1", vehicle: null });
  for (let k = 0; k <= 100_000; k += 1) line.push(k / 100, Math.sin(k / 1000));
  assert.ok(line.times.length <= 4001, String(line.times.length));
  assert.ok(line.times.length >= 1000, String(line.times.length));
  assert.equal(line.times[0], 0);
  assert.equal(line.times.at(-1), 1000);
  assert.ok(line.times.every((t, at) => at === 0 || t > line.times[at - 1]));
});

test("a history that comes late goes before what has come since", () => {
  const line = new series.Line({ id: 1, name: "x", unit: "1", vehicle: null });
  line.push(4, 40);
  line.push(5, 50);
  line.fill([0, 1, 4], [0, 10, 40]);
  assert.deepEqual(line.times, [0, 1, 4, 5]);
  assert.equal(line.at(4.5), 40);
  assert.equal(line.at(-1), null);
});

test("a live run is drawn between its two newest frames, and thanks once for each", () => {
  const sent = [];
  const player = new live.LivePlayer((message) => sent.push(message));
  assert.equal(player.advance(0), null);
  player.take(frameAt(1), 0);
  player.take(frameAt(2), 40);
  const moment = player.advance(50);
  assert.ok(moment.t_s > 1 && moment.t_s < 2, String(moment.t_s));
  assert.equal(player.advance(500).t_s, 2);
  assert.equal(player.advance(501), null, "nothing new, nothing drawn");
  assert.deepEqual(sent, [{ type: "got", time_s: 1 }, { type: "got", time_s: 2 }]);
});

test("a live run moves evenly although its frames come early and late, and never back", () => {
  const player = new live.LivePlayer(() => {});
  // 33 ms of virtual time each; on the way each takes up to 40 ms longer, and they stay in order.
  let [state, last] = [7, 0];
  const late = () => ((state = (Math.imul(state, 1664525) + 1013904223) >>> 0) / 2 ** 32) * 40;
  const arrivals = Array.from({ length: 300 }, (_, k) => [k * 0.033, (last = Math.max(last, k * 33 + late()))]);
  const steps = [];
  let [next, shown] = [0, null];
  for (let now = 0; now < 9500; now += 16) {
    while (next < arrivals.length && arrivals[next][1] <= now) player.take(frameAt(arrivals[next++][0]), now);
    const moment = player.advance(now);
    const t_s = moment ? moment.t_s : shown;
    assert.ok(shown === null || t_s >= shown, "time does not run back");
    if (moment) {
      assert.ok(moment.f >= 0 && moment.f <= 1);
      assert.ok(Math.abs(moment.a.time + moment.f * (moment.b.time - moment.a.time) - moment.t_s) < 1e-9, "places are those of the time shown");
    }
    if (now > 1000 && shown !== null) steps.push((t_s - shown) / 0.016);
    shown = t_s;
  }
  assert.ok(Math.max(...steps) < 1.5, `fastest ${Math.max(...steps)}`);
  assert.ok(steps.filter((step) => step < 0.5).length < 0.01 * steps.length, `${steps.filter((step) => step < 0.5).length} of ${steps.length} stand still`);
});

test("a live run that is held comes to rest at its newest frame, and a step leads there and no farther", () => {
  const player = new live.LivePlayer(() => {});
  for (let k = 0; k <= 20; k += 1) {
    player.take(frameAt(k * 0.1), k * 100);
    player.advance(k * 100 + 5);
  }
  for (let now = 2000; player.busy; now += 16) assert.ok(player.advance(now).t_s <= 2 && now < 3000);
  player.take(frameAt(2.1), 60_000);
  let seen = [];
  for (let now = 60_000; player.busy; now += 8) seen.push(player.advance(now).t_s);
  assert.equal(seen.at(-1), 2.1);
  assert.ok(seen.length > 2 && seen.length < 20 && seen.some((t) => t > 2 && t < 2.1), String(seen));
  player.take(frameAt(1), 61_000);
  const back = player.advance(61_001);
  assert.ok(back.jumped && back.t_s === 1);
});

test("packets of a live run are shown when their time has come", () => {
  const player = new live.LivePlayer(() => {});
  player.take(frameAt(1), 0);
  player.advance(1);
  player.take(frameAt(2), 33);
  player.hear([{ t: 1.1, from: 0, bytes: 1, to: [] }, { t: 1.9, from: 0, bytes: 1, to: [] }]);
  const first = player.advance(33 + 16);
  assert.deepEqual(first.packets.map((p) => p.t), [1.1]);
  assert.deepEqual(player.advance(33 + 200).packets.map((p) => p.t), [1.9]);
});

/** A replay of `count` ticks, and the program that answers it: at once, when told to. */
function replayed(count, period_s) {
  const ticks_s = Array.from({ length: count }, (_, k) => k * period_s);
  const asked = [];
  const span = { from_s: 0, to_s: ticks_s.at(-1), ticks_s, period_s };
  const player = new replay.ReplayPlayer(span, 2, (message) => {
    if (message.type === "fetch") asked.push(message);
    return true;
  });
  const answer = () => {
    const fetch = asked.at(-1);
    let next = -Infinity;
    const first = ticks_s.findLast((t) => t <= fetch.from_s + 1e-9);
    for (const t of ticks_s) {
      if (t < first || t > fetch.to_s + 1e-9 || t < next) continue;
      player.take(frameAt(t));
      if (fetch.step_s > 0) next = t + fetch.step_s;
    }
    player.fetched(fetch.id);
  };
  return { player, asked, answer };
}

test("a replay fetches first what is looked at, then the whole coarsely", () => {
  const { player, asked, answer } = replayed(1001, 0.1);
  player.seek(42.0);
  assert.deepEqual([asked[0].from_s, asked[0].to_s], [42, 42]);
  answer();
  assert.equal(player.advance(0).t_s, 42);
  assert.equal(asked.length, 2);
  assert.ok(asked[1].step_s > 1 && asked[1].to_s === 100, JSON.stringify(asked[1]));
});

test("a jump shows the nearest frame that is here until the right one comes", () => {
  const { player, asked, answer } = replayed(1001, 0.1);
  player.plan();
  answer();
  answer();
  player.seek(33.3);
  const near = player.advance(0);
  assert.ok(Math.abs(near.a.time - 33.3) < 3, String(near.a.time));
  assert.ok(player.waiting.value);
  assert.equal(asked.at(-1).from_s, 33.300000000000004);
  answer();
  const exact = player.advance(1);
  assert.ok(Math.abs(exact.a.time - 33.3) < 1e-9);
  assert.ok(!player.waiting.value);
});

test("where everybody was before a jump is fetched for trails, and shown once", () => {
  const { player, asked, answer } = replayed(1001, 0.05);
  player.seek(42);
  player.trace(10, 10 / 75);
  answer();
  assert.equal(player.advance(0).past, null, "what is looked at comes first");
  answer();
  const { from_s, to_s, step_s } = asked.at(-1);
  assert.ok(Math.abs(from_s - 32) < 0.051 && Math.abs(to_s - 42) < 1e-9 && step_s > 0.1, JSON.stringify(asked.at(-1)));
  answer();
  const { past } = player.advance(1);
  assert.ok(past.length > 50 && past.length < 90, String(past.length));
  assert.ok(past[0].time <= 32 && Math.abs(past.at(-1).time - 42) < 1e-9);
  assert.ok(past.every((frame, k) => k === 0 || frame.time > past[k - 1].time));
  player.trace(0, 0);
  assert.equal(player.advance(2).past, null, "without trails there is no past");
});

test("a playing replay goes as the wall clock does, and waits for frames that are not here", () => {
  const { player, asked, answer } = replayed(101, 0.1);
  player.plan();
  answer();
  player.speed.value = 2;
  player.play(true);
  const before = asked.length;
  for (let k = 0; k < 4 && asked.length > 0; k += 1) answer();
  assert.ok(before >= 1);
  player.advance(0);
  let t = 0;
  for (let ms = 100; ms <= 1000; ms += 100) t = player.advance(ms)?.t_s ?? t;
  assert.ok(Math.abs(t - 2) < 1e-9, String(t));
  // Without answers it stands at the last frame that is here.
  for (let ms = 1100; ms <= 60_000; ms += 400) t = player.advance(ms)?.t_s ?? t;
  assert.ok(t < 10 && player.waiting.value && player.playing.value, String(t));
  for (let ms = 60_000; player.playing.value; ms += 400) {
    answer();
    t = player.advance(ms)?.t_s ?? t;
  }
  assert.equal(t, 10);
});

test("a fast replay fetches fewer ticks, and a fetch that brings nothing is not repeated", () => {
  const { player, asked, answer } = replayed(10_001, 0.01);
  player.plan();
  answer();
  player.speed.value = 20;
  player.play(true);
  player.advance(0);
  assert.ok(asked.at(-1).step_s > 0.5 && asked.at(-1).step_s < 1, JSON.stringify(asked.at(-1)));
  const count = asked.length;
  for (let k = 0; k < 5; k += 1) player.fetched(asked.at(-1).id);
  assert.ok(asked.length <= count + 1, `${asked.length - count} fetches after answers without frames`);
});

test("steps go from tick to tick", () => {
  const { player, answer } = replayed(11, 0.1);
  player.plan();
  answer();
  answer();
  player.stepTick(1);
  player.stepTick(1);
  assert.equal(player.advance(0).t_s, 0.2);
  player.seek(0.25);
  player.stepTick(-1);
  assert.equal(player.advance(1).t_s, 0.2);
  player.stepTick(-1);
  player.stepTick(-1);
  player.stepTick(-1);
  assert.equal(player.advance(2).t_s, 0);
});

/** A run of two vehicles, and all that the page says to its program. */
function runOf(mode) {
  const said = [];
  const replay = { from_s: 0, to_s: 10, ticks_s: [0, 5, 10], period_s: 5 };
  const vehicles = { paths: ["bee-0", "bee-1"], kinds: ["bee", "bee"], roles: [], radii_m: [0.1, 0.1], colors: [], looks: [] };
  const hello = { type: "hello", mode, name: "x.toml", vehicles, ...(mode === "replay" ? { replay } : {}) };
  return { run: new run.Run(hello, { send: (message) => said.push(message) > 0 }), said };
}

test("the wind of a recording is that of the time which is shown, in whatever direction one goes", () => {
  const { run } = runOf("replay");
  assert.equal(run.has.value.wind, false);
  const west = [[0, 0, 10, 2, 0, 0]];
  const north = [[0, 0, 10, 0, -3, 0]];
  run.hear({ type: "wind", t: 1, arrows: west });
  run.hear({ type: "wind", t: 4, arrows: north });
  run.hear({ type: "wind", t: 8, arrows: [] });
  assert.equal(run.has.value.wind, true);
  assert.deepEqual([0.5, 1, 3.9, 4, 7, 8, 9].map((t) => run.windAt(t)), [[], west, west, north, north, [], []]);
});

test("numbers of the colour before are dropped when another is chosen, and kept when it is the same one", () => {
  for (const mode of ["live", "replay"]) {
    const { run, said } = runOf(mode);
    run.hear({ type: "series", list: [{ id: 1, vehicle: 0, name: "battery/soc", unit: "1" }, { id: 2, vehicle: 0, name: "neighbors", unit: "1" }] });
    run.paint({ by: "value", name: "neighbors" });
    const { frame } = decode.decode(frameBytes(0, 2, 2));
    if (mode === "live") run.live.take(frame, 0);
    else run.replay.take(frame);
    assert.deepEqual([...frame.values], [0, 10]);
    run.paint({ by: "battery", name: "" });
    assert.equal(frame.values, null, mode);
    assert.deepEqual(said.filter((it) => it.type === "colour").map((it) => it.by), ["neighbors", "battery/soc"]);
    const next = decode.decode(frameBytes(0, 2, 2)).frame;
    if (mode === "live") run.live.take(next, 10);
    else run.replay.take(next);
    run.paint({ by: "value", name: "battery/soc" });
    assert.notEqual(next.values, null, "the same numbers under another name");
  }
});

test("what was asked for is shown at once, and what the program says wins", () => {
  const { run } = runOf("live");
  const state = { type: "state", time_s: 1, paused: false, factor: 1, speed: 1, ended: null, events: 5, viewers: 1, skipped: 0 };
  run.hear(state);
  run.expect({ paused: true });
  assert.equal(run.state.value.paused, true);
  run.hear({ ...state, time_s: 1.1 });
  assert.equal(run.state.value.paused, true, "said before the wish was heard");
  assert.equal(run.told.paused, false);
  run.hear({ ...state, paused: true });
  run.hear({ ...state, time_s: 2 });
  assert.equal(run.state.value.paused, false, "another page let it go on");
  run.expect({ paused: true });
  run.hear({ ...state, ended: "end time" });
  assert.equal(run.state.value.paused, false, "a run that has ended is not held");
});

test("a mark that is jumped to is of the kind that is wanted, and of the selected vehicle if that was asked for", () => {
  const { run } = runOf("replay");
  const mark = (t, kind, who) => ({ t, kind, who, text: "" });
  run.hear({ type: "marks", list: [mark(1, "contact", [0]), mark(2, "log", [1]), mark(3, "contact", [1]), mark(4, "log", [0])], dropped: 0 });
  const jump = (by) => {
    run.seekMark(by);
    return run.replay.time_s;
  };
  assert.deepEqual([jump(1), jump(1), jump(1)], [1, 2, 3]);
  run.markKind.value = "log";
  assert.equal(jump(-1), 2);
  run.markKind.value = "contact";
  run.select(1);
  assert.equal(jump(-1), 1, "whoever is selected");
  run.ownMarks.value = true;
  assert.equal(jump(1), 3);
  assert.equal(jump(1), 3, "there is no other");
  assert.equal(run.notice.value.text, "No contact of bee-1 after this time.");
});

test("a vehicle that stands is told of again and again, and is news once", () => {
  const { run } = runOf("live");
  let news = 0;
  run.select(1);
  run.details.on(() => (news += 1));
  const details = () => ({ type: "details", vehicle: 1, t: 4, parts: [], sensors: [], battery: null, radios: [], packets: [] });
  for (let k = 0; k < 3; k += 1) run.hear(details());
  assert.equal(news, 1);
  run.hear({ ...details(), t: 5 });
  assert.equal(news, 2);
});

test("a saved picture says the run, its seed, the time, and what colours, lines and arrows mean", () => {
  const is = (value) => ({ value });
  const shown = {
    name: "meadow",
    hello: { seed: "6", vehicles: { kinds: ["bee", "bee", "hive"] } },
    time: is(83.456),
    legend: is({ title: "kind", unit: "", low: 0, high: 0, stops: [], names: [["bee", "#ffb000"], ["hive", "#3da5ff"]] }),
    colour: is({ by: "kind", name: "" }),
    layers: is({ links: true, wind: true }),
    links: is([]),
    wind: is([]),
  };
  const kinds = [{ dot: "#ffb000", text: "bee", end: "2" }, { dot: "#3da5ff", text: "hive", end: "1" }];
  assert.deepEqual(caption.captionOf(shown, false), { title: "meadow · seed 6 · 83.46\u00a0s", rows: kinds });
  shown.links = is([[0, 1, -60, 1]]);
  shown.wind = is([[0, 0, 0, 3, 4, 0], [1, 0, 0, 1, 0, 0]]);
  const { rows } = caption.captionOf(shown, false);
  assert.deepEqual([rows[2].low, rows[2].of, rows[2].high], ["−95", "radio links", "−45\u00a0dBm"]);
  assert.equal(rows[3].text, "wind: arrows up to 5\u00a0m/s");
  // What is not drawn is not explained.
  shown.layers = is({ links: false, wind: false });
  assert.deepEqual(caption.captionOf(shown, false).rows, kinds);
  shown.colour = is({ by: "value", name: "neighbors" });
  shown.legend = is({ title: "neighbors", unit: "1", low: 0, high: 12, stops: ["#440154", "#fde725"] });
  const [ramp, none] = caption.captionOf(shown, true).rows;
  assert.deepEqual(ramp, { ramp: ["#440154", "#fde725"], low: "0.0", of: "neighbors", high: "12.0" });
  assert.equal(none.text, "no value");
});

test("keys have the names of the help sheet", () => {
  const name = (key, shiftKey = false) => keys.nameOfKey({ key, shiftKey });
  assert.equal(name(" "), "Space");
  assert.equal(name("F", true), "Shift+F");
  assert.equal(name("f"), "f");
  assert.equal(name("A"), "a", "caps lock is no shift");
  assert.equal(name("?", true), "?");
});

test("dist is what the sources build, and loads nothing from elsewhere", () => {
  const folder = mkdtempSync(join(tmpdir(), "simbeeotic-dist-"));
  try {
    execFileSync(process.execPath, [fileURLToPath(new URL("../build.mjs", import.meta.url)), folder], { stdio: "inherit" });
    for (const file of ["index.html", "page.css", "page.js"]) {
      const built = readFileSync(join(folder, file));
      const kept = readFileSync(new URL(`../dist/${file}`, import.meta.url));
      assert.ok(built.equals(kept), `dist/${file} is not what the sources build: npm run build, and commit it`);
    }
    const index = readFileSync(join(folder, "index.html"), "utf8");
    assert.doesNotMatch(index, /(src|href)="(https?:)?\/\//);
    assert.doesNotMatch(index, /<script(?![^>]* src=)|<style|\son\w+=/, "nothing that the page's policy forbids");
    assert.doesNotMatch(readFileSync(join(folder, "page.css"), "utf8"), /@import|url\(\s*["']?(https?:)?\/\//);
  } finally {
    rmSync(folder, { recursive: true, force: true });
  }
});
