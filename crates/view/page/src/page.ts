// One run on the page: its panels around its picture, and the loop that moves the picture.

import { h, say, show } from "./core/dom";
import { words } from "./core/format";
import { layerNames, readPlace, writePlace, type Place } from "./core/place";
import type { Settings } from "./core/settings";
import { throttled } from "./core/signal";
import type { Run } from "./run";
import { trailSeconds, trailStep, type CameraState, type SceneView, type ViewName } from "./scene/index";
import { createScene } from "./scene/scene";
import { captionOf } from "./ui/caption";
import { chartsPanel } from "./ui/charts";
import { helpSheet } from "./ui/help";
import { listen, type Key } from "./ui/keys";
import { layerKeys, layersPanel, layerWords, views } from "./ui/layers";
import { Layout, type Panel } from "./ui/layout";
import { liveActions, liveBar } from "./ui/livebar";
import { firstSteps, noticeBox, waitingCard } from "./ui/notices";
import { replayActions, replayBar } from "./ui/replaybar";
import { topBar } from "./ui/topbar";
import { vehiclesPanel } from "./ui/vehicles";

/** Pictures that take no longer are drawn as often as the screen wants one. */
const QUICK_MS = 20;
const LONGEST_REST_MS = 2000;
/** In larger swarms the past of a recording is not fetched for trails: they are of what was played. */
const MOST_TRACED = 2000;

export class Page {
  private readonly element: HTMLElement;
  private readonly host = h("div", { class: "scene", id: "scene" });
  private readonly layout = new Layout();
  private readonly scene: SceneView | null;
  private readonly noScene: string = "";
  private beat = 0;
  private drawn_ms = -Infinity;
  private hidden = false;
  /** Whether the world is shown cut open has been decided: by a link, by somebody, or once by itself. */
  private cutChosen = false;
  /** Relative to what is followed, which is not there before the first frame of its time. */
  private pendingCamera: CameraState | null = null;

  constructor(
    private readonly run: Run,
    private readonly settings: Settings,
    root: HTMLElement,
    place: Place,
  ) {
    const { host } = this;
    this.element = h("div", { class: "page" }, host);
    root.append(this.element);
    document.title = `${run.name} · ${run.replay ? "replay" : "live"} · Simbeeotic`;

    const hover = h("div", { class: "hover", hidden: true, "aria-hidden": "true" });
    try {
      this.scene = createScene(host, {
        hello: run.hello,
        dark: settings.dark.value,
        onPick: (vehicle) => this.pick(vehicle),
        onHover: (text) => {
          say(hover, text ?? "");
          show(hover, text !== null);
        },
        onCamera: () => {},
        onLegend: (legend) => (run.legend.value = legend),
        onOverhead: (hides) => {
          run.found({ overhead: true });
          if (!hides || this.cutChosen) return;
          run.layers.value = { ...run.layers.value, cut: true };
          run.say("The swarm is under a roof, so the world is shown cut open: the key x closes it.");
        },
        onLost: () => run.say("All vehicles are out of sight: the key a, or “Show all”, shows them."),
      });
    } catch (error) {
      this.scene = null;
      this.noScene = error instanceof Error ? error.message : String(error);
    }
    host.addEventListener("pointermove", (event) => {
      hover.style.left = `${event.clientX}px`;
      hover.style.top = `${event.clientY}px`;
    });

    // These events do not bubble.
    host.addEventListener("webglcontextlost", () => run.say("The graphics card has taken the picture away. It comes back by itself, or after loading this page again.", true), { capture: true });
    host.addEventListener("webglcontextrestored", () => (run.notice.value = null), { capture: true });

    const live = run.live ? liveActions(run) : null;
    const replay = run.replay ? replayActions(run, run.replay) : null;
    const vehicles = vehiclesPanel(run, this.layout);
    const charts = chartsPanel(run, settings);
    const layers = layersPanel(run, settings.dark, (view) => this.look(view), () => this.fit(), (kind) => vehicles.search(kind));
    const table = this.keys({
      search: () => vehicles.search(),
      chooseCharts: () => {
        this.layout.set("charts", true);
        charts.choose();
      },
      help: () => help.toggle(),
    });
    const help = helpSheet(run, table);
    const top = topBar(run, settings, this.layout, {
      savePicture: () => void this.savePicture(),
      copyLink: () => void this.copyLink(),
      help: () => help.toggle(),
      fullScreen: () => this.fullScreen(),
    });
    const bottom = live ? liveBar(run, live) : replayBar(run, run.replay!, settings, replay!);
    // In the order in which the tab key goes through them.
    this.element.append(top, layers, firstSteps(settings, host, run.gone.signal), bottom, charts.element, vehicles.element);
    this.element.append(noticeBox(run.notice), hover, help.element);
    if (live) this.element.append(waitingCard(run, live.toggle));
    if (this.noScene) {
      this.element.append(
        h(
          "div",
          { class: "card", role: "alert" },
          h("p", { text: "This browser cannot draw in three dimensions (WebGL). The rest of the page works." }),
          h("p", { class: "faint", text: this.noScene }),
        ),
      );
    }
    this.until(
      this.layout.open.now((open) => {
        show(layers, open.has("layers"));
        show(vehicles.element, open.has("vehicles"));
        show(charts.element, open.has("charts"));
      }),
    );
    this.layout.listen(run.gone.signal);
    // What is looked at is in the middle of what the panel leaves free; a narrow page shows one of both.
    const cover = () => this.scene?.setCovered(this.layout.has("layers") && !this.layout.narrow.matches ? layers.getBoundingClientRect().right - host.getBoundingClientRect().left : 0);
    const sizes = new ResizeObserver(cover);
    sizes.observe(layers);
    this.until(() => sizes.disconnect());
    cover();
    listen(table, run.gone.signal);
    this.wire();
    this.restore(place);
    this.wake();
  }

  /** The view as it is: what a link to it says. */
  place(): Place {
    const { run } = this;
    const vehicle = run.selected.value;
    return {
      ...(run.replay ? { t_s: run.replay.time_s } : {}),
      ...(this.scene ? { camera: this.pendingCamera ?? this.scene.camera() } : {}),
      ...(vehicle === null ? {} : { select: run.path(vehicle) }),
      follow: run.following.value,
      layers: run.layers.value,
      colour: run.colour.value,
      theme: this.settings.theme.value,
      ...(run.charts.value ? { charts: run.charts.value } : {}),
      ...(run.markKind.value ? { marks: run.markKind.value } : {}),
      panels: [...this.layout.open.value],
    };
  }

  restore(place: Place): void {
    const { run } = this;
    if (place.theme) this.settings.theme.value = place.theme;
    if (place.layers) {
      run.layers.value = place.layers;
      this.cutChosen = true;
    }
    if (place.colour) run.paint(place.colour);
    if (place.charts) run.charts.value = place.charts;
    if (place.marks) run.markKind.value = place.marks;
    if (place.panels) this.layout.open.value = new Set(place.panels.filter((name): name is Panel => ["layers", "vehicles", "charts"].includes(name)));
    if (place.t_s !== undefined) run.seek(place.t_s);
    if (place.select !== undefined) {
      const vehicle = run.number(place.select);
      if (vehicle === undefined) run.say(`This run has no vehicle “${place.select}”.`, true);
      else run.select(vehicle);
    }
    if (place.follow !== undefined) run.following.value = place.follow && run.selected.value !== null;
    if (place.camera) {
      this.scene?.setCamera(place.camera);
      this.pendingCamera = run.following.value ? place.camera : null;
    }
  }

  /** Pictures drawn so far, and their mean time. */
  stats(): { drawn: number; ms: number } {
    return this.scene?.stats() ?? { drawn: 0, ms: 0 };
  }

  /** Whether nothing is drawn, nothing is waited for, and all that is to be drawn has been: for tests. */
  quiet(): boolean {
    const { run } = this;
    return this.beat === 0 && !run.player.busy && !run.waits && (this.scene?.quiet() ?? true);
  }

  /** Takes the page away; the answer shows the next one the same. */
  dispose(): Place {
    const place = this.place();
    cancelAnimationFrame(this.beat);
    this.run.gone.abort();
    this.scene?.dispose();
    this.element.remove();
    return place;
  }

  /** Draws as long as there is something to draw, one picture each time the screen wants one. */
  wake(): void {
    if (this.beat !== 0 || this.run.gone.signal.aborted) return;
    this.beat = requestAnimationFrame((now_ms) => {
      this.beat = 0;
      // Where pictures take long, as without a graphics card, the page has time for all else between them.
      if (now_ms - this.drawn_ms >= this.rest()) {
        this.drawn_ms = now_ms;
        this.draw(now_ms);
      }
      if (this.run.player.busy) this.wake();
    });
  }

  private rest(): number {
    const { ms } = this.stats();
    return ms < QUICK_MS ? 0 : Math.min(1.25 * ms, LONGEST_REST_MS);
  }

  private draw(now_ms: number): void {
    const { run, scene } = this;
    const moment = run.player.advance(now_ms);
    if (!moment) return;
    if (moment.jumped || this.hidden) scene?.jumped();
    this.hidden = false;
    scene?.show(moment.a, moment.b, moment.f);
    if (moment.past) scene?.retrace(moment.past);
    if (this.pendingCamera && !run.replay?.waiting.value) {
      scene?.setCamera(this.pendingCamera);
      this.pendingCamera = null;
    }
    if (moment.packets.length > 0) scene?.addPackets(moment.packets, this.speed());
    run.time.value = moment.t_s;
    run.begun.value = true;
    if (run.replay) {
      run.links.value = run.linksAt(moment.t_s);
      run.wind.value = run.windAt(moment.t_s);
    }
  }

  private speed(): number {
    const { run } = this;
    return run.replay ? run.replay.speed.value : run.state.value?.speed || 1;
  }

  private wire(): void {
    const { run, scene, settings } = this;
    run.onBusy = () => this.wake();
    if (scene) {
      run.layers.now((layers, before) => {
        this.cutChosen ||= layers.cut !== before.cut;
        scene.setLayers(layers);
      });
      const colour = () => {
        const { by, name } = run.colour.value;
        const series = run.colourSeries();
        const of = by === "speed" ? "m/s" : series === null ? "" : (run.series.ofVehicles().get(series) ?? "");
        scene.setColour(by, by === "value" ? words(name) : by === "battery" ? "charge" : by, of);
      };
      run.colour.now(colour);
      run.series.known.on(() => run.colour.value.by !== "kind" && run.colour.value.by !== "speed" && colour());
      run.selected.on((vehicle) => {
        scene.select(vehicle);
        if (run.following.value) scene.follow(vehicle);
      });
      run.following.on((on) => scene.follow(on ? run.selected.value : null));
      run.details.on((details) => scene.setDetails(details));
      run.links.on((list) => scene.setLinks(list));
      run.wind.on((arrows) => scene.setWind(arrows));
      this.until(settings.dark.on((dark) => scene.setDark(dark)));
      const sizes = new ResizeObserver(() => scene.resize());
      sizes.observe(this.host);
      this.until(() => sizes.disconnect());
    }
    const { replay } = run;
    if (replay) {
      const seconds = trailSeconds(replay.span.period_s);
      const trace = () => {
        const shown = run.layers.value.trails && run.count <= MOST_TRACED;
        replay.trace(shown ? seconds : 0, trailStep(seconds));
        this.wake();
      };
      run.layers.now((layers, before) => (layers === before || layers.trails !== before.trails) && trace());
      run.selected.on(trace);
      replay.playing.on(() => this.wake());
      // What the program knows of the selected vehicle at the time that is shown.
      run.time.on(throttled(300, () => run.selected.value !== null && run.askDetails()));
      const watch = setInterval(() => {
        replay.plan();
        if (replay.busy) this.wake();
      }, 1000);
      run.gone.signal.addEventListener("abort", () => clearInterval(watch));
    }
    document.addEventListener(
      "visibilitychange",
      () => {
        // Frames stand still behind another window: what comes next is no motion.
        if (document.hidden) this.hidden = true;
        else this.wake();
      },
      { signal: run.gone.signal },
    );
    addEventListener("hashchange", () => this.restore(readPlace(location.hash)), { signal: run.gone.signal });
  }

  private pick(vehicle: number | null): void {
    this.run.select(vehicle);
    if (vehicle !== null && !this.layout.narrow.matches) {
      this.layout.tab.value = "vehicles";
      this.layout.set("vehicles", true);
    }
  }

  private look(view: ViewName): void {
    this.scene?.setView(view);
  }

  private fit(): void {
    this.run.following.value = false;
    this.scene?.fit();
  }

  private follow(): void {
    const { run } = this;
    if (run.selected.value === null) run.say("Select a vehicle first, then it can be followed.");
    else run.following.value = !run.following.value;
  }

  private async savePicture(): Promise<void> {
    const { run } = this;
    if (!this.scene) return;
    try {
      const blob = await this.scene.png(captionOf(run, this.settings.dark.value));
      const name = `${run.name.replace(/[^\w.-]+/g, "-")}-${run.time.value.toFixed(2)}s.png`;
      const address = URL.createObjectURL(blob);
      h("a", { href: address, download: name }).click();
      setTimeout(() => URL.revokeObjectURL(address), 10_000);
      run.say(`Saved ${name}.`);
    } catch (error) {
      run.say(`The picture could not be saved: ${error instanceof Error ? error.message : String(error)}.`, true);
    }
  }

  private async copyLink(): Promise<void> {
    history.replaceState(null, "", `#${writePlace(this.place())}`);
    try {
      await navigator.clipboard.writeText(location.href);
      this.run.say("The link to this view is in the clipboard.");
    } catch {
      this.run.say("The address of this page now is the link to this view.");
    }
  }

  private fullScreen(): void {
    const done = document.fullscreenElement ? document.exitFullscreen() : document.documentElement.requestFullscreen();
    done.catch(() => this.run.say("This browser does not allow full screen here.", true));
  }

  private until(end: () => void): void {
    this.run.gone.signal.addEventListener("abort", end);
  }

  private keys(open: { search(): void; chooseCharts(): void; help(): void }): Key[] {
    const { run, settings, layout } = this;
    const key = (group: string, keys: string, does: string, act: () => void): Key => ({ group, keys: keys.split(" "), does, act });
    const time = run.live ? this.liveKeys(key) : this.replayKeys(key);
    return [
      ...time,
      ...views.map(([view, label, name]) => key("View", name, label.toLowerCase(), () => this.look(view))),
      key("View", "a", "all vehicles in sight", () => this.fit()),
      key("View", "f", "follow the selected vehicle", () => this.follow()),
      key("View", "Escape", "select nothing", () => run.select(null)),
      ...layerNames.map((name) => key("Show", layerKeys[name], layerWords[name].toLowerCase(), () => run.toggleLayer(name))),
      key("Page", "/", "find a vehicle", open.search),
      key("Page", "l", "layers and colours", () => layout.toggle("layers")),
      key("Page", "v", "vehicles", () => layout.toggleTab("vehicles")),
      key("Page", "m", "marks: contacts, events, log", () => layout.toggleTab("marks")),
      key("Page", "c", "charts", () => layout.toggle("charts")),
      key("Page", "g", "choose charts", open.chooseCharts),
      key("Page", "i", "save a picture", () => void this.savePicture()),
      key("Page", "y", "copy a link to this view", () => void this.copyLink()),
      key("Page", "d", "theme: auto, light, dark", () => settings.nextTheme()),
      key("Page", "z", "large text", () => (settings.large.value = !settings.large.value)),
      key("Page", "Shift+F", "full screen", () => this.fullScreen()),
      key("Page", "? h", "these keys", open.help),
    ];
  }

  private liveKeys(key: (group: string, keys: string, does: string, act: () => void) => Key): Key[] {
    const act = liveActions(this.run);
    return [
      key("Run", "Space", "start, pause, resume", act.toggle),
      key("Run", ".", "step one instant", act.instant),
      key("Run", ">", "step 0.1 s", act.tenth),
      key("Run", "-", "slower", () => act.pace(-1)),
      key("Run", "+ =", "faster", () => act.pace(1)),
      key("Run", "0", "real time: 1 ×", () => act.setPace(1)),
      key("Run", "9", "as fast as possible", () => act.setPace(null)),
    ];
  }

  private replayKeys(key: (group: string, keys: string, does: string, act: () => void) => Key): Key[] {
    const { run } = this;
    const replay = run.replay!;
    const act = replayActions(run, replay);
    return [
      key("Time", "Space", "play and pause", act.toggle),
      key("Time", ". ArrowRight", "one tick on", () => act.step(1)),
      key("Time", ", ArrowLeft", "one tick back", () => act.step(-1)),
      key("Time", "]", "next mark", () => run.seekMark(1)),
      key("Time", "[", "mark before", () => run.seekMark(-1)),
      key("Time", "-", "slower", () => act.faster(-1)),
      key("Time", "+ =", "faster", () => act.faster(1)),
      key("Time", "0", "speed 1 ×", () => act.setSpeed(1)),
      key("Time", "Home", "to the beginning", () => run.seek(replay.span.from_s)),
      key("Time", "End", "to the end", () => run.seek(replay.span.to_s)),
    ];
  }
}
