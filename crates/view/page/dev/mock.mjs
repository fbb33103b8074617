// A program that is none: serves the page with bees on circles, for work on the page without building Rust.
//   node dev/mock.mjs [live|replay] [vehicles] [port]
// The page's tests run against the real program; PROTOCOL.md is what counts.
import { createHash } from "node:crypto";
import { readFileSync } from "node:fs";
import { createServer } from "node:http";

const mode = process.argv[2] ?? "live";
const n = Number(process.argv[3] ?? 100);
const port = Number(process.argv[4] ?? 8137);
const END_S = 60;
const types = { "index.html": "text/html", "page.js": "text/javascript", "page.css": "text/css" };

const server = createServer((request, answer) => {
  const name = new URL(request.url, "http://x").pathname.slice(1) || "index.html";
  if (!types[name]) return answer.writeHead(404).end();
  answer.writeHead(200, { "content-type": types[name], "content-security-policy": "default-src 'self'; img-src 'self' data: blob:; style-src 'self' 'unsafe-inline'" });
  answer.end(readFileSync(new URL(`../dist/${name}`, import.meta.url)));
});

function place(k, t) {
  const a = k * 2.399 + t * (0.2 + (k % 7) * 0.03);
  const r = 0.5 * Math.sqrt(k) + 2 + Math.sin(t + k);
  return [r * Math.cos(a), r * Math.sin(a), 5 + 2 * Math.sin(0.3 * t + k), a + Math.PI / 2];
}

function frame(t, coloured) {
  const bytes = Buffer.alloc(16 + 32 * n + (coloured ? 4 * n : 0));
  bytes[0] = 1;
  bytes[1] = coloured ? 3 : 1;
  bytes.writeUInt32LE(n, 4);
  bytes.writeDoubleLE(t, 8);
  const last = 16 + 24 * n + (coloured ? 4 * n : 0);
  for (let k = 0; k < n; k += 1) {
    const [x, y, z, yaw] = place(k, t);
    const next = place(k, t + 0.01);
    [x, y, z].forEach((v, i) => bytes.writeFloatLE(v, 16 + 12 * k + 4 * i));
    [x, y, z].forEach((v, i) => bytes.writeFloatLE((next[i] - v) / 0.01, 16 + 12 * n + 12 * k + 4 * i));
    if (coloured) bytes.writeFloatLE(Math.max(0, 1 - t / 80 - (k % 10) / 30), 16 + 24 * n + 4 * k);
    [Math.cos(yaw / 2), 0, 0, Math.sin(yaw / 2)].forEach((q, i) => bytes.writeInt16LE(Math.round(q * 32767), last + 8 * k + 2 * i));
  }
  return bytes;
}

function values(t, pairs) {
  const bytes = Buffer.alloc(16 + 12 * pairs.length);
  bytes[0] = 2;
  bytes.writeUInt32LE(pairs.length, 4);
  bytes.writeDoubleLE(t, 8);
  pairs.forEach(([id, v], i) => {
    bytes.writeDoubleLE(v, 16 + 8 * i);
    bytes.writeUInt32LE(id, 16 + 8 * pairs.length + 4 * i);
  });
  return bytes;
}

const runSeries = [["speed", "1"], ["packets/sent", "1/s"], ["packets/received", "1/s"], ["packets/delivery", "1"], ["contacts", "1/s"], ["energy", "J"], ["pollen/sum", "1"], ["pollen/mean", "1"], ["battery/soc/mean", "1"]];
const valueOf = (id, t) => [0.98 + 0.03 * Math.sin(7 * t), n, n * 4.2 + 20 * Math.sin(t), 0.8 + 0.1 * Math.sin(t / 5), Math.max(0, Math.round(3 * Math.sin(t / 3) + 2)), 4.1 * n * t, n * t * 0.1, t * 0.1, 1 - t / 80, t * 0.12, 1 - t / 70][id] ?? 0;

function details(k, t) {
  const [, , , yaw] = place(k, t);
  return {
    type: "details", vehicle: k, t,
    parts: [
      { place: "model", name: "random-walk-bee", parameters: [["max_speed", "2 m/s"], ["velocity_sigma", "0.2 m/s"], ["period", "100 ms"]] },
      { place: "vehicle", name: "simple-bee", parameters: [["mass", "0.1 g"], ["bee_collisions", "true"], ["radius", "5 cm"]] },
      { place: "sensor.compass", name: "compass", parameters: [["sigma", "2°"]] },
    ],
    sensors: [
      { name: "compass", t, mount: { at: [0, 0, 0], turn: [1, 0, 0, 0] }, beams: null, columns: [["", "rad"]], reading: [(yaw + 0.05 * Math.sin(31 * t)) % 6.28], truth: [yaw % 6.28], lost: false },
      { name: "range", t, mount: { at: [0.05, 0, 0], turn: [1, 0, 0, 0] }, beams: { rays: [[1, 0, 0]], range_m: 4 }, columns: [["distance", "m"]], reading: [3.1 + Math.sin(t)], truth: [3 + Math.sin(t)], lost: k % 3 === 0 },
      { name: "imu", t: null, mount: { at: [0, 0, 0], turn: [1, 0, 0, 0] }, beams: null, columns: [["x", "m/s²"], ["y", "m/s²"], ["z", "m/s²"]], reading: null, truth: [0.1, 0, 9.81], lost: false },
    ],
    battery: { soc: Math.max(0, 1 - t / 70), voltage_v: 3.71, current_a: 0.41, condition: "fit" },
    radios: [{ name: "radio", channel: 11, state: "listening", sent: Math.floor(t), received: Math.floor(t * 4.2), lost: { collision: 2, noise: 12 } }],
    packets: [0.2, 0.5, 0.9].map((d, i) => ({ t: t - 1 + d, sent: i === 1, other: i === 1 ? null : (k + i + 1) % n, bytes: 24, rssi_dbm: i === 1 ? null : -71.5 - i })),
  };
}

server.on("upgrade", (request, socket) => {
  const key = createHash("sha1").update(`${request.headers["sec-websocket-key"]}258EAFA5-E914-47DA-95CA-C5AB0DC85B11`).digest("base64");
  socket.write(`HTTP/1.1 101 Switching Protocols\r\nUpgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Accept: ${key}\r\n\r\n`);
  const send = (data) => {
    const payload = typeof data === "string" ? Buffer.from(data) : data;
    const head = Buffer.alloc(payload.length < 126 ? 2 : payload.length < 65536 ? 4 : 10);
    head[0] = typeof data === "string" ? 0x81 : 0x82;
    if (head.length === 2) head[1] = payload.length;
    else if (head.length === 4) (head[1] = 126), head.writeUInt16BE(payload.length, 2);
    else (head[1] = 127), head.writeBigUInt64BE(BigInt(payload.length), 2);
    socket.write(head);
    socket.write(payload);
  };
  const say = (message) => send(JSON.stringify(message));
  let t = 0, paused = process.env.PAUSED === "1", factor = 1, selected = null, colour = null, owed = 0;
  const marks = Array.from({ length: 80 }, (_, i) => ({ t: i * 0.7 + 0.3, kind: i % 4 ? "contact" : "log", who: i % 4 ? [i % n, (i * 7 + 1) % n] : [i % n], text: i % 4 ? "" : "found a flower" }));
  const ticks_s = Array.from({ length: END_S * 10 + 1 }, (_, i) => i / 10);
  const kinds = Array.from({ length: n }, (_, k) => (k % 10 === 0 ? "broadcast-bee" : "random-walk-bee"));
  say({
    type: "hello", protocol: 1, mode, name: "first-swarm", seed: "1", version: "0.1.0", end_s: END_S, truncated: false,
    vehicles: { paths: kinds.map((_, k) => `bee-${k}`), kinds, roles: kinds.map(() => "vehicle"), radii_m: kinds.map(() => 0.05), colors: kinds.map((kind) => (kind === "broadcast-bee" ? "#2f7fd1" : "#f0b21e")), looks: kinds.map(() => 0) },
    looks: [{ pieces: [{ form: 0, at: [0, 0, 0], turn: [1, 0, 0, 0] }] }],
    forms: [{ sphere: 0.05 }, { box: [1, 1, 2] }, { cylinder: [0.1, 0.1, 0.5] }],
    stage: { ground: "#7da36a", plane: true, radius_m: 1000, props: [{ kind: "obstacle", label: "box", color: "#8c8c8c", texture: "", pieces: [{ form: 1, at: [10, 4, 2], turn: [1, 0, 0, 0] }], meta: {} }] },
    ...(mode === "replay" ? { replay: { from_s: 0, to_s: END_S, ticks_s, period_s: 0.1 } } : {}),
  });
  say({ type: "series", list: runSeries.map(([name, unit], id) => ({ id, name, unit, vehicle: null })).slice(mode === "replay" ? 1 : 0) });
  if (mode === "replay") {
    runSeries.forEach((_, id) => say({ type: "history", id, times_s: ticks_s.filter((_, i) => i % 5 === 0), values: ticks_s.filter((_, i) => i % 5 === 0).map((at) => valueOf(id, at)) }));
    say({ type: "marks", list: marks, dropped: 0 });
  }
  const state = () => mode === "live" && say({ type: "state", time_s: t, paused, factor, speed: paused ? 0 : 0.98 * (factor ?? 12), ended: t >= END_S ? "end time" : null, events: Math.round(t * 1000), viewers: 1, skipped: 0 });
  state();
  let last = Date.now(), beats = 0, first = true;
  const beat = mode === "live" ? setInterval(() => {
    const now = Date.now();
    const before = t;
    if (!paused && t < END_S) t = Math.min(END_S, t + ((now - last) / 1000) * (factor ?? 12));
    last = now;
    if ((t !== before || first) && owed < 2) (send(frame(t, colour)), (owed += 1), (first = false));
    if (beats % 3 === 0) (state(), send(values(t, [...runSeries.map((_, id) => [id, valueOf(id, t)]), ...(selected === null ? [] : [[100 + 2 * selected, valueOf(9, t)], [101 + 2 * selected, valueOf(10, t)]])])));
    if (beats % 8 === 0 && selected !== null) say(details(selected, t));
    const new_marks = marks.filter((mark) => mark.t > before && mark.t <= t);
    if (new_marks.length) say({ type: "marks", list: new_marks, dropped: 0 });
    if (beats % 30 === 0) say({ type: "links", t, period_s: 1, list: [[1, 2, -71, 0.9], [2, 3, -80, 0.5]] });
    beats += 1;
  }, 33) : null;
  const hear = (message) => {
    if (message.type === "pause") paused = true;
    else if (message.type === "resume") paused = false;
    else if (message.type === "step") (t += message.seconds ?? 0.01), send(frame(t, colour));
    else if (message.type === "pace") factor = message.factor;
    else if (message.type === "got") owed -= 1;
    else if (message.type === "colour") colour = message.by;
    else if (message.type === "select") {
      if (message.vehicle !== selected && message.vehicle !== null) say({ type: "series", list: [{ id: 100 + 2 * message.vehicle, name: "pollen", unit: "1", vehicle: message.vehicle }, { id: 101 + 2 * message.vehicle, name: "battery/soc", unit: "1", vehicle: message.vehicle }] });
      selected = message.vehicle;
      if (selected !== null) say(details(selected, message.t ?? t));
    } else if (message.type === "fetch") {
      let next = -Infinity;
      const start = ticks_s.findLast((at) => at <= message.from_s + 1e-9) ?? 0;
      for (const at of ticks_s) if (at >= start && at <= message.to_s + 1e-9 && at >= next) (send(frame(at, colour)), (next = message.step_s > 0 ? at + message.step_s : -Infinity));
      say({ type: "fetched", id: message.id });
    } else if (message.type === "history") say({ type: "history", id: message.id, times_s: ticks_s.filter((at) => mode === "replay" || at <= t), values: ticks_s.filter((at) => mode === "replay" || at <= t).map((at) => valueOf(message.id % 2 ? 10 : 9, at)) });
    if (["pause", "resume", "step", "pace"].includes(message.type)) state();
  };
  let rest = Buffer.alloc(0);
  socket.on("data", (data) => {
    rest = Buffer.concat([rest, data]);
    for (;;) {
      if (rest.length < 6) return;
      let size = rest[1] & 127, at = 2;
      if (size === 126) (size = rest.readUInt16BE(2)), (at = 4);
      if (rest.length < at + 4 + size) return;
      const mask = rest.subarray(at, at + 4);
      const text = Buffer.from(rest.subarray(at + 4, at + 4 + size).map((byte, i) => byte ^ mask[i % 4]));
      const kind = rest[0] & 15;
      rest = rest.subarray(at + 4 + size);
      if (kind === 1) hear(JSON.parse(text.toString()));
      if (kind === 8) socket.end();
    }
  });
  socket.on("close", () => clearInterval(beat));
  socket.on("error", () => clearInterval(beat));
});
server.listen(port, "127.0.0.1", () => console.log(`http://127.0.0.1:${server.address().port}/`));
