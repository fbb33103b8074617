// What is looked at: all that the program has said of it, and what the user has chosen. The panels read and
// change this; none of them knows another.

import { Connection } from "./connection";
import { layerNames, type ChartKey } from "./core/place";
import { SeriesStore } from "./core/series";
import { Signal } from "./core/signal";
import { LivePlayer } from "./player/live";
import { ReplayPlayer } from "./player/replay";
import type { Player } from "./player/index";
import type { ColourBy, Layers, Legend } from "./scene/index";
import type { Details, Hello, Link, Mark, PageMessage, ServerMessage, State } from "./wire";

export interface Colour {
  by: ColourBy;
  /** The series of `value`. */
  name: string;
}

export interface Notice {
  text: string;
  bad: boolean;
}

/** So long a state that was asked for is believed to come. */
const EXPECTED_MS = 2000;
/** Marks that are kept; the oldest go. */
const MOST_MARKS = 10_000;
/** The names under which the charge of batteries may come. */
const batteryNames = ["battery/soc", "battery", "soc"];

/** The series of the charge of batteries, if anybody has one. */
export function batteryName(series: SeriesStore): string | null {
  const known = series.ofVehicles();
  return batteryNames.find((name) => known.has(name)) ?? null;
}

/** What there is in this run: the page does not offer what there is not. */
export interface Has {
  radio: boolean;
  wind: boolean;
  beams: boolean;
  /** Something of the world is above the swarm. */
  overhead: boolean;
}

/** Always the same, so that it is no change. */
const stillAir: number[][] = [];

export class Run {
  readonly series = new SeriesStore();
  readonly state = new Signal<State | null>(null);
  /** The state as the program told it last, without what is expected of it. */
  told: State | null = null;
  /** Events before this page came: a run that has had no other since has not begun, or stands. */
  firstEvents: number | null = null;
  readonly details = new Signal<Details | null>(null);
  readonly links = new Signal<Link[]>([]);
  readonly wind = new Signal<number[][]>([]);
  readonly legend = new Signal<Legend | null>(null);
  readonly notice = new Signal<Notice | null>(null);
  /** In order of time. */
  marks: Mark[] = [];
  /** Whether marks, series and wind are known: a recording is shown before all of it has been read. */
  readonly read = new Signal(true);
  /** The kind of marks that are listed, drawn and jumped to; empty: all. */
  readonly markKind = new Signal("");
  readonly marked = new Signal(0);
  /** Whether only marks of the selected vehicle are listed and jumped to. */
  readonly ownMarks = new Signal(false);
  /** The mark that was gone to last. */
  readonly soughtMark = new Signal<Mark | null>(null);
  marksDropped = 0;

  /** Virtual time that is shown, s. */
  readonly time = new Signal(0);
  /** There is something to see. */
  readonly begun = new Signal(false);
  readonly selected = new Signal<number | null>(null);
  readonly following = new Signal(false);
  readonly layers = new Signal<Layers>(usualLayers());
  readonly colour = new Signal<Colour>({ by: "kind", name: "" });
  readonly has = new Signal<Has>({ radio: false, wind: false, beams: false, overhead: false });
  readonly charts = new Signal<ChartKey[] | null>(null);
  /** What happens on this run, not on its successor: ends listeners on what outlives it. */
  readonly gone = new AbortController();

  readonly live: LivePlayer | null;
  readonly replay: ReplayPlayer | null;
  readonly player: Player;
  /** Something is to be drawn. */
  onBusy: () => void = () => {};

  private colourAsked: string | null = null;
  private expected: { part: Partial<State>; until_ms: number } | null = null;
  private readonly numbers = new Map<string, number>();
  private readonly linkTimes: { t: number; list: Link[] }[] = [];
  private readonly windTimes: { t: number; arrows: number[][] }[] = [];

  constructor(
    readonly hello: Hello,
    private readonly connection: Connection,
  ) {
    this.series.known.on(() => this.askColour());
    hello.vehicles.paths.forEach((path, vehicle) => this.numbers.set(path, vehicle));
    const send = (message: PageMessage) => connection.send(message);
    if (hello.mode === "replay" && hello.replay) {
      this.live = null;
      this.replay = new ReplayPlayer(hello.replay, hello.vehicles.paths.length, send);
      this.player = this.replay;
      this.time.value = hello.replay.from_s;
      this.read.value = false;
    } else {
      this.live = new LivePlayer(send);
      this.replay = null;
      this.player = this.live;
    }
  }

  /** Something of what is shown is still to come from the program. */
  get waits(): boolean {
    const { replay } = this;
    const vehicle = this.selected.value;
    const details = this.details.value;
    if (!replay) return vehicle !== null && details === null;
    const told = vehicle === null || (details !== null && Math.abs(details.t - replay.time_s) < 1e-6);
    return !this.read.value || replay.fetching || !told;
  }

  /** The scenario's or recording's name, without folders. */
  get name(): string {
    const file = this.hello.name.split(/[/\\]/).at(-1) ?? "";
    return file.replace(/\.(toml|xml|mcap)$/, "") || "a run without a name";
  }

  get count(): number {
    return this.hello.vehicles.paths.length;
  }

  path(vehicle: number): string {
    return this.hello.vehicles.paths[vehicle] ?? `vehicle ${vehicle}`;
  }

  number(path: string): number | undefined {
    return this.numbers.get(path);
  }

  send(message: PageMessage): void {
    if (!this.connection.send(message)) this.say("The program is not there: this cannot be done now.", true);
  }

  say(text: string, bad = false): void {
    this.notice.value = { text, bad };
  }

  hear(message: Exclude<ServerMessage, Hello>): void {
    switch (message.type) {
      case "state":
        this.hearState(message);
        break;
      case "series":
        this.series.declare(message.list);
        // A run with more radios than packets are told of has this number all the same.
        if (this.live) this.found({ radio: message.list.some((it) => it.vehicle === null && it.name === "packets/sent") });
        break;
      case "history":
        this.series.fill(message.id, message.times_s, message.values);
        if (this.series.lines.get(message.id)?.about.name === "packets/sent") this.found({ radio: message.values.some(Boolean) });
        break;
      case "marks":
        this.read.value = true;
        this.mark(message.list, message.dropped);
        break;
      case "packets":
        this.found({ radio: message.list.length > 0 });
        (this.live ?? this.replay)?.hear(message.list);
        break;
      case "links":
        this.found({ radio: message.list.length > 0 });
        this.hearLinks(message.t, message.list);
        break;
      case "wind":
        this.found({ wind: message.arrows.length > 0 });
        if (this.replay) {
          // Of a recording all of it comes at once, in order.
          this.windTimes.push({ t: message.t, arrows: message.arrows });
          this.wind.value = this.windAt(this.replay.time_s);
        } else {
          this.wind.value = message.arrows;
        }
        break;
      case "details":
        // What was on its way when somebody else was selected is nobody's business.
        // What stands is told again and again: it is no news, and nothing is drawn for it.
        if (message.vehicle === this.selected.value && JSON.stringify(message) !== JSON.stringify(this.details.value)) this.details.value = message;
        this.found({
          radio: message.radios.length > 0,
          beams: message.sensors.some((sensor) => sensor.beams !== null),
        });
        break;
      case "fetched":
        this.replay?.fetched(message.id);
        this.onBusy();
        break;
      case "error":
        this.say(message.text, true);
        this.replay?.failed();
        this.onBusy();
        break;
    }
  }

  /** What was just asked for is shown at once: who presses twice means the second after the first. */
  expect(part: Partial<State>): void {
    if (!this.state.value) return;
    this.expected = { part: { ...this.expected?.part, ...part }, until_ms: performance.now() + EXPECTED_MS };
    this.state.value = { ...this.state.value, ...part };
  }

  private hearState(state: State): void {
    this.told = state;
    this.firstEvents ??= state.events;
    const { expected } = this;
    const came = expected && (Object.keys(expected.part) as (keyof State)[]).every((name) => state[name] === expected.part[name]);
    if (!expected || came || state.ended !== null || performance.now() > expected.until_ms) {
      this.expected = null;
      this.state.value = state;
    } else this.state.value = { ...state, ...expected.part };
  }

  select(vehicle: number | null): void {
    if (vehicle === this.selected.value) return;
    this.details.value = null;
    if (vehicle === null) this.following.value = false;
    this.selected.value = vehicle;
    this.askDetails();
  }

  /** Whom the details are wanted of: of a recording, at the time that is shown. */
  askDetails(): void {
    const vehicle = this.selected.value;
    this.connection.send(
      this.replay && vehicle !== null
        ? { type: "select", vehicle, t: this.replay.time_s }
        : { type: "select", vehicle },
    );
  }

  paint(colour: Colour): void {
    const before = this.colour.value;
    if (before.by === colour.by && before.name === colour.name) return;
    // No number is drawn with the legend of another.
    if (this.seriesOf(colour) !== this.colourAsked) this.player.dropValues();
    this.colour.value = colour;
    this.askColour();
  }

  /** The series that colours the vehicles, as far as anybody has it. */
  colourSeries(): string | null {
    return this.seriesOf(this.colour.value);
  }

  private seriesOf({ by, name }: Colour): string | null {
    if (by === "battery") return batteryName(this.series);
    return by === "value" && this.series.ofVehicles().has(name) ? name : null;
  }

  /** A link may want colours before the program has said what there is: then it is asked once it has. */
  private askColour(): void {
    const by = this.colourSeries();
    if (by === this.colourAsked || !this.connection.send({ type: "colour", by })) return;
    this.colourAsked = by;
    this.replay?.forget();
    this.onBusy();
  }

  toggleLayer(name: keyof Layers): void {
    this.layers.value = { ...this.layers.value, [name]: !this.layers.value[name] };
  }

  /** To a time of a recording. */
  seek(t_s: number): void {
    this.replay?.seek(t_s);
    this.onBusy();
  }

  /** Marks of the kind that is wanted, and of the selected vehicle if only its are. */
  marksWanted(): Mark[] {
    const kind = this.markKind.value;
    const vehicle = this.ownMarks.value ? this.selected.value : null;
    return this.marks.filter((mark) => (kind === "" || mark.kind === kind) && (vehicle === null || mark.who.includes(vehicle)));
  }

  /** To the next mark that is wanted, or the one before. */
  seekMark(by: 1 | -1): void {
    if (!this.replay) return;
    const here = this.replay.time_s;
    const list = this.marksWanted();
    const mark =
      by > 0 ? list.find((mark) => mark.t > here + 1e-9) : list.findLast((mark) => mark.t < here - 1e-9);
    if (!mark && !this.read.value) {
      this.say("The recording is still being read: its marks come in a moment.");
      return;
    }
    if (!mark) {
      const kind = this.markKind.value || "mark";
      const vehicle = this.selected.value;
      const whose = this.ownMarks.value && vehicle !== null ? ` of ${this.path(vehicle)}` : "";
      this.say(`No ${kind}${whose} ${by > 0 ? "after" : "before"} this time.`);
      return;
    }
    this.replay.play(false);
    this.seek(mark.t);
    this.soughtMark.value = mark;
    const who = mark.who.map((vehicle) => this.path(vehicle)).join(", ");
    this.say([mark.kind, who, mark.text].filter((text) => text !== "").join(" · "));
  }

  /** Links as they were last told at a time of a recording. */
  linksAt(t_s: number): Link[] {
    return this.linkTimes.findLast((entry) => entry.t <= t_s + 1e-9)?.list ?? [];
  }

  /** The wind as it was last told at a time of a recording. */
  windAt(t_s: number): number[][] {
    return this.windTimes.findLast((entry) => entry.t <= t_s + 1e-9)?.arrows ?? stillAir;
  }

  /** The program has come back: it forgot whom we look at. */
  repeat(): void {
    if (this.selected.value !== null) this.askDetails();
  }

  /** What was seen once is there. */
  found(seen: Partial<Has>): void {
    const has = { ...this.has.value };
    for (const name of Object.keys(seen) as (keyof Has)[]) has[name] ||= seen[name] ?? false;
    if (JSON.stringify(has) !== JSON.stringify(this.has.value)) this.has.value = has;
  }

  private hearLinks(t: number, list: Link[]): void {
    if (!this.replay) {
      this.links.value = list;
      return;
    }
    const known = this.linkTimes.find((entry) => entry.t === t);
    if (known) known.list = list;
    else {
      this.linkTimes.push({ t, list });
      this.linkTimes.sort((x, y) => x.t - y.t);
      if (this.linkTimes.length > 500) {
        const here = this.replay.time_s;
        this.linkTimes.sort((x, y) => Math.abs(x.t - here) - Math.abs(y.t - here)).length = 250;
        this.linkTimes.sort((x, y) => x.t - y.t);
      }
    }
    this.links.value = this.linksAt(this.replay.time_s);
  }

  private mark(list: Mark[], dropped: number): void {
    this.marksDropped += dropped;
    if (list.length === 0 && dropped === 0) return;
    const newest = this.marks.at(-1)?.t ?? -Infinity;
    this.marks.push(...list);
    if (list.some((mark, at) => mark.t < (at > 0 ? list[at - 1]!.t : newest))) this.marks.sort((x, y) => x.t - y.t);
    if (this.marks.length > MOST_MARKS) {
      this.marksDropped += this.marks.length - MOST_MARKS;
      this.marks = this.marks.slice(-MOST_MARKS);
    }
    this.marked.value += 1;
  }
}

function usualLayers(): Layers {
  const on = new Set<string>(["links", "packets", "beams", "wind", "grid", "world"]);
  return Object.fromEntries(layerNames.map((name) => [name, on.has(name)])) as unknown as Layers;
}
