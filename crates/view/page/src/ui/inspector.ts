// One vehicle, closely: where it is, its battery, sensors, radios, packets and parameters.

import { button, h, say, show } from "../core/dom";
import { count, fixed, number, time } from "../core/format";
import { icon } from "../core/icons";
import { throttled } from "../core/signal";
import type { Run } from "../run";
import { GREY, css } from "../scene/colours";
import { coloursOfKinds } from "../scene/paint";
import type { Details, Frame } from "../wire";
import { recorderHint, sensorRows } from "./sensors";

/** Packets that are listed: the newest. */
const MOST_PACKETS = 8;

interface Section {
  element: HTMLElement;
  update(details: Details): void;
}

export function inspector(run: Run): HTMLElement {
  const dot = h("span", { class: "dot" });
  const name = h("h2", { id: "selected-name" });
  const kind = h("p", { class: "faint cut", id: "selected-kind" });
  const follow = button("Follow", "f", "Follow", () => (run.following.value = !run.following.value), {
    class: "tool plain",
    id: "follow",
  });
  follow.prepend(icon("target"));
  run.following.now((on) => follow.setAttribute("aria-pressed", String(on)));
  const motion = motionTable();
  const body = h("div", { class: "sections" });
  const hint = h("p", { class: "empty faint", text: "Waiting for its details …" });
  let sections: Section[] = [];
  let shape = "";

  const move = () => {
    const vehicle = run.selected.value;
    if (vehicle !== null && run.player.frame) motion.update(run.player.frame, vehicle);
  };
  const moveSoon = throttled(100, move);
  run.time.on(moveSoon);
  // A link may select somebody before there is a frame.
  run.begun.on(move);
  run.selected.now((vehicle) => {
    if (vehicle === null) return;
    const { kinds, roles } = run.hello.vehicles;
    say(name, run.path(vehicle));
    name.title = run.path(vehicle);
    const role = roles[vehicle] && roles[vehicle] !== "vehicle" ? ` · ${roles[vehicle]}` : "";
    say(kind, `${kinds[vehicle] ?? ""}${role}`);
    dot.style.background = css(coloursOfKinds(run.hello).colours[vehicle] ?? GREY);
    move();
  });
  run.details.now((details) => {
    show(hint, details === null);
    const now = details ? shapeOf(details) : "";
    if (now !== shape) {
      shape = now;
      sections = details ? sectionsOf(run, details) : [];
      body.replaceChildren(...sections.map((section) => section.element));
    }
    if (details) for (const section of sections) section.update(details);
  });

  return h(
    "div",
    { class: "inspector", id: "inspector" },
    h(
      "div",
      { class: "head" },
      dot,
      h("div", { class: "titles" }, name, kind),
      follow,
      button("Back to the list", "Escape", icon("close"), () => run.select(null), { class: "tool", id: "unselect" }),
    ),
    motion.element,
    hint,
    body,
  );
}

/** What decides which rows there are; all else only changes their texts. */
function shapeOf(details: Details): string {
  return JSON.stringify([
    details.vehicle,
    details.parts,
    details.sensors.map((sensor) => [sensor.name, sensor.columns, sensor.reading?.length ?? sensor.truth?.length ?? 0]),
    details.battery !== null,
    details.radios.map((radio) => radio.name),
    details.packets.length > 0,
  ]);
}

function sectionsOf(run: Run, details: Details): Section[] {
  const recorded = run.replay ? run.path(details.vehicle) : null;
  const sections: Section[] = [];
  if (details.battery) sections.push(batterySection());
  if (details.sensors.length > 0) sections.push(sensorRows(details, recorded));
  if (details.radios.length > 0) sections.push(radioSection(details, recorded));
  if (details.packets.length > 0) sections.push(packetsSection(run));
  if (details.parts.length > 0) sections.push(partsSection(details));
  return sections;
}

function motionTable(): { element: HTMLElement; update(frame: Frame, vehicle: number): void } {
  const cell = (id: string) => h("td", { class: "figure", id });
  const [x, y, z] = [cell("now-x"), cell("now-y"), cell("now-z")];
  const [speed, heading, climb] = [cell("now-speed"), cell("now-yaw"), cell("now-climb")];
  const pair = (label: string, value: HTMLElement, of: string, more: string) =>
    [h("th", { scope: "row", text: label, title: more }), value, h("td", { class: "faint", text: of })];
  const element = h(
    "table",
    { class: "facts motion", "aria-label": "pose and speed" },
    h("tr", {}, ...pair("x", x, "m", "east"), ...pair("speed", speed, "m/s", "over ground and up")),
    h("tr", {}, ...pair("y", y, "m", "north"), ...pair("climb", climb, "m/s", "up")),
    h("tr", {}, ...pair("z", z, "m", "up"), ...pair("yaw", heading, "°", "from east, counter-clockwise")),
  );
  return {
    element,
    update(frame, vehicle) {
      if (vehicle >= frame.n) return;
      const at = 3 * vehicle;
      say(x, fixed(frame.positions[at], 2));
      say(y, fixed(frame.positions[at + 1], 2));
      say(z, fixed(frame.positions[at + 2], 2));
      const v = frame.velocities;
      say(speed, v ? fixed(Math.hypot(v[at]!, v[at + 1]!, v[at + 2]!), 2) : "–");
      say(climb, v ? fixed(v[at + 2], 2) : "–");
      const [qw, qx, qy, qz] = [0, 1, 2, 3].map((k) => frame.attitudes[4 * vehicle + k]! / 32767) as [
        number, number, number, number,
      ];
      const yaw = Math.atan2(2 * (qw * qz + qx * qy), 1 - 2 * (qy * qy + qz * qz));
      say(heading, fixed((yaw * 180) / Math.PI, 0));
    },
  };
}

function batterySection(): Section {
  const bar = h("div", { class: "charge", role: "meter", "aria-label": "charge", "aria-valuemin": "0", "aria-valuemax": "100" });
  const full = h("div", {});
  bar.append(full);
  const text = h("span", { class: "figure", id: "charge" });
  const rest = h("p", { class: "faint" });
  return {
    element: h("section", {}, h("h3", { text: "Battery" }), h("div", { class: "chargeline" }, bar, text), rest),
    update({ battery }) {
      if (!battery) return;
      const percent = Math.min(Math.max(100 * battery.soc, 0), 100);
      full.style.width = `${percent}%`;
      bar.dataset.level = percent < 15 ? "low" : percent < 35 ? "half" : "full";
      bar.setAttribute("aria-valuenow", percent.toFixed(0));
      say(text, `${fixed(percent, percent < 10 ? 1 : 0)} %`);
      say(rest, [`${fixed(battery.voltage_v, 2)} V`, `${number(battery.current_a)} A`, battery.condition].filter(Boolean).join(", "));
    },
  };
}

function radioSection(details: Details, recorded: string | null): Section {
  const rows = details.radios.map((radio) => {
    const state = h("span", { class: "faint" });
    const sent = h("td", { class: "figure" });
    const received = h("td", { class: "figure" });
    const lost = h("p", { class: "faint" });
    const uncounted = recorded === null ? h("p", { class: "faint", text: "Its frames were not counted." }) : recorderHint("Its frames were not counted: that does a recorder with", "radios", recorded);
    const table = h(
      "table",
      { class: "facts" },
      h("tr", {}, h("th", { scope: "row", text: "sent" }), sent, h("th", { scope: "row", text: "received" }), received),
    );
    const element = h(
      "div",
      { class: "radio" },
      h("div", { class: "first" }, h("strong", { class: "cut", text: radio.name }), state),
      table,
      uncounted,
      lost,
    );
    return { element, state, table, uncounted, sent, received, lost };
  });
  return {
    element: h("section", {}, h("h3", { text: "Radio" }), ...rows.map((row) => row.element)),
    update({ radios }) {
      radios.forEach((radio, at) => {
        const row = rows[at];
        if (!row) return;
        say(row.state, [radio.channel === null ? "" : `channel ${radio.channel}`, radio.state ?? ""].filter(Boolean).join(", "));
        const counted = radio.sent !== null || radio.received !== null;
        show(row.table, counted);
        show(row.uncounted, !counted);
        say(row.sent, count(radio.sent));
        say(row.received, count(radio.received));
        const causes = Object.entries(radio.lost).filter(([, times]) => times > 0);
        say(row.lost, `lost: ${causes.map(([cause, times]) => `${count(times)} ${cause}`).join(", ")}`);
        show(row.lost, causes.length > 0);
      });
    },
  };
}

function packetsSection(run: Run): Section {
  const rows = h("tbody", { id: "last-packets" });
  return {
    element: h("section", {}, h("h3", { text: "Last packets" }), h("table", { class: "facts packets" }, rows)),
    update({ packets }) {
      const newest = [...packets].sort((a, b) => b.t - a.t).slice(0, MOST_PACKETS);
      rows.replaceChildren(
        ...newest.map((packet) => {
          const other = packet.other;
          const name =
            other === null
              ? h("span", { class: "faint", text: packet.sent ? "all" : "–" })
              : h("button", { type: "button", class: "name-link cut", text: run.path(other), on: { click: () => run.select(other) } });
          return h(
            "tr",
            {},
            h("td", { class: "figure faint", text: time(packet.t, 3) }),
            h("td", { text: packet.sent ? "to" : "from", class: "faint" }),
            h("td", { class: "grow" }, name),
            h("td", { class: "figure", text: `${packet.bytes} B` }),
            h("td", { class: "figure", text: packet.rssi_dbm === null ? "" : `${fixed(packet.rssi_dbm, 0)} dBm` }),
          );
        }),
      );
    },
  };
}

function partsSection(details: Details): Section {
  const part = ({ place, name, parameters }: Details["parts"][number]) =>
    h(
      "details",
      {},
      h("summary", {}, h("span", { class: "faint", text: place }), h("strong", { class: "cut", text: name })),
      parameters.length === 0
        ? h("p", { class: "faint", text: "no parameters" })
        : h(
            "table",
            { class: "facts parameters" },
            ...parameters.map(([key, value]) =>
              h("tr", {}, h("th", { scope: "row", text: key, title: key }), h("td", { text: value, title: value })),
            ),
          ),
    );
  const parts = details.parts.map(part);
  if (parts[0]) parts[0].open = true;
  return { element: h("section", { id: "parameters" }, h("h3", { text: "Parameters" }), ...parts), update() {} };
}

