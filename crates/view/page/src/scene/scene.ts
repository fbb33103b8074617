// The scene as a whole: puts the parts together, and draws when something has changed.

import * as THREE from "three";
import { throttled } from "../core/signal";
import type { CameraState, ColourBy, Layers, SceneOptions, SceneView, ViewName } from "./index";
import type { Details, Frame, Link, Packet } from "../wire";
import { Beams } from "./beams";
import { Orbit } from "./camera";
import type { Caption } from "./caption";
import { Frames } from "./frames";
import { gridUniforms } from "./grid";
import { Ground } from "./ground";
import { createShared, setTheme, type Shared } from "./light";
import { length } from "./math";
import { Overlay } from "./overlay";
import { Pace } from "./pace";
import { Paint } from "./paint";
import { listen } from "./pointer";
import { Pointing } from "./pointing";
import { Radio } from "./radio";
import { castShadows, type Shadows } from "./shadow";
import { Sight } from "./sight";
import { Sky } from "./sky";
import { drawnBySoftware } from "./software";
import { Stems } from "./stems";
import { Textures } from "./textures";
import { setTone, toneUniforms } from "./tone";
import { Trails } from "./trails";
import { Vehicles } from "./vehicles";
import { Wind } from "./wind";
import { World } from "./world";

/** How often the camera tells where it is, ms. */
const TELL_MS = 250;

/** How often it is looked whether a roof hides the swarm, ms. */
const LOOK_UP_MS = 1000;

const ALL: Layers = { labels: false, trails: true, links: true, packets: true, beams: true, wind: true, grid: true, world: true, cut: false };

/** Fills `host` (an element with a size, not `static`) with the scene. Throws if the browser has no WebGL 2. */
export function createScene(host: HTMLElement, options: SceneOptions): SceneView {
  return new Scene(host, options);
}

class Scene implements SceneView {
  private renderer: THREE.WebGLRenderer;
  private scene = new THREE.Scene();
  private shared: Shared;
  private orbit = new Orbit();
  private frames: Frames;
  private paint: Paint;
  private vehicles: Vehicles;
  private textures: Textures;
  private world: World;
  private grid = gridUniforms();
  private tone = toneUniforms();
  private ground: Ground;
  private sky: Sky;
  private shadows: Shadows;
  private trails: Trails;
  private radio: Radio;
  private beams: Beams;
  private wind: Wind;
  private stems: Stems;
  private sight: Sight;
  private pointing: Pointing;
  private overlay = new Overlay();
  private pace: Pace;
  private layers = ALL;
  private selected: number | null = null;
  private details: Details | null = null;
  private dark: boolean;
  private request = 0;
  private lastDraw = 0;
  private moving = false;
  private view = new THREE.Matrix4();
  private ends: (() => void)[] = [];
  private told = "";
  private tellTimer = 0;
  private disposed = false;
  private fine = false;
  private readonly lookUpSoon = throttled(LOOK_UP_MS, () => this.lookUp());
  private soft = false;
  private radiusOf = (i: number, w: number): number => this.radius_px(i, w);

  constructor(
    private host: HTMLElement,
    private options: SceneOptions,
  ) {
    const { hello } = options;
    this.dark = options.dark;
    THREE.ColorManagement.enabled = false;
    // Without a graphics card smooth edges cost most of the time; there a picture that stands still is made finer.
    const soft = drawnBySoftware();
    this.renderer = new THREE.WebGLRenderer({ antialias: !soft, powerPreference: "high-performance" });
    this.renderer.outputColorSpace = THREE.LinearSRGBColorSpace;
    this.renderer.sortObjects = true;
    const canvas = this.renderer.domElement;
    Object.assign(canvas.style, { position: "absolute", inset: "0", width: "100%", height: "100%", display: "block", outline: "none" });
    canvas.setAttribute("aria-label", "The swarm in three dimensions");
    host.append(canvas, this.overlay.canvas);

    this.shared = createShared(this.dark);
    this.soft = soft;
    const count = hello.vehicles.paths.length;
    this.frames = new Frames(count, hello.vehicles.radii_m);
    this.paint = new Paint(hello, count, (legend) => options.onLegend(legend));
    this.textures = new Textures(() => this.changed());
    const { stage } = hello;
    this.ground = new Ground(stage.ground, this.textures.get(stage.texture ?? ""), stage.plane, stage.radius_m, this.shared, this.grid, this.tone);
    this.sky = new Sky(stage.plane, this.shared, this.grid);
    this.world = new World(hello, this.shared, this.textures, { ...this.grid, ...this.tone });
    this.vehicles = new Vehicles(hello, this.frames, this.shared);
    this.trails = new Trails(this.frames, this.shared, this.paint.bytes);
    this.radio = new Radio(this.frames, this.shared);
    this.sight = new Sight(this.orbit, this.frames, this.world, hello.vehicles.radii_m);
    this.beams = new Beams(this.frames, this.shared, () => this.sight.reach * 4);
    this.wind = new Wind(this.shared);
    this.stems = new Stems(hello, this.frames, this.shared);
    this.scene.matrixWorldAutoUpdate = true;
    this.scene.add(this.ground.mesh, this.sky.mesh, this.world.group, this.vehicles.group, ...this.trails.meshes());
    this.scene.add(this.radio.links.mesh, this.radio.pulses.mesh, this.beams.group, this.wind.mesh, ...this.stems.meshes());
    this.shadows = castShadows(this.renderer, this.world.group, this.world.bounds, this.shared, soft ? 2048 : 4096);

    this.pace = new Pace(
      this.renderer,
      soft,
      (ratio) => this.setRatio(ratio),
      () => this.changed(true),
    );
    this.pointing = new Pointing(options, {
      host,
      orbit: this.orbit,
      frames: this.frames,
      world: this.world,
      view: this.view.elements,
      links: () => (this.layers.links ? this.radio.shown : []),
      arrows: () => (this.layers.wind ? this.wind.drawn : []),
      worldShown: () => this.layers.world,
      radius_px: this.radiusOf,
      // Only what is written over the picture is drawn anew.
      changed: () => this.drawOver(),
    });
    this.ends.push(
      listen(canvas, this.orbit, {
        moved: () => {
          this.sight.settled();
          this.go();
        },
        click: (x, y) => options.onPick(this.pointing.vehicleAt(x, y)),
        doubleClick: (x, y) => this.doubleClick(x, y),
        hover: (at) => this.pointing.hover(at),
      }),
    );
    const lost = (e: Event): void => e.preventDefault();
    const back = (): void => {
      this.shadows.draw();
      this.changed();
    };
    canvas.addEventListener("webglcontextlost", lost);
    canvas.addEventListener("webglcontextrestored", back);
    const observer = new ResizeObserver(() => this.resize());
    observer.observe(host);
    this.ends.push(() => observer.disconnect());
    this.setDark(this.dark);
    this.paintAll(null);
    this.resize();
    this.sight.onWorld();
  }

  show(a: Frame, b: Frame, f: number): void {
    const before = this.frames.a;
    const beforeB = this.frames.b;
    if (before === a && beforeB === b && this.frames.f === f) return;
    this.frames.show(a, b, f);
    if (before !== a || beforeB !== b) {
      this.paintAll(b);
      if (this.layers.cut) this.cut(this.sight.height_m());
      if (before === null) this.lookUp();
      else this.lookUpSoon();
      this.trails.passed(a);
      if (this.sight.passed(a.time, b.time, this.view, this.moving)) this.go();
      if (this.sight.lost(this.view)) this.options.onLost();
    }
    this.changed();
  }

  jumped(): void {
    this.trails.clear();
    this.changed();
  }

  retrace(past: Frame[]): void {
    this.trails.retrace(past);
    this.changed();
  }

  setDark(dark: boolean): void {
    this.dark = dark;
    setTheme(this.shared, dark);
    setTone(this.tone, dark);
    this.vehicles.setDark(dark);
    this.wind.setDark(dark);
    this.radio.setDark(dark);
    this.overlay.dark = dark;
    this.stems.setDark(dark);
    this.changed();
  }

  setLayers(layers: Layers): void {
    if (layers.cut !== this.layers.cut) this.cut(layers.cut ? this.sight.height_m() : Infinity);
    this.layers = { ...layers };
    for (const m of this.trails.meshes()) m.visible = layers.trails;
    this.radio.links.mesh.visible = layers.links;
    this.radio.pulses.mesh.visible = layers.packets;
    this.beams.set(layers.beams ? this.details : null);
    this.wind.mesh.visible = layers.wind;
    this.ground.showGrid(layers.grid);
    this.world.group.visible = layers.world;
    this.changed();
  }

  setColour(by: ColourBy, title: string, unit: string): void {
    this.paint.set(by, title, unit);
    this.paintAll(this.frames.b);
    this.changed();
  }

  select(vehicle: number | null): void {
    this.selected = vehicle !== null && vehicle >= 0 && vehicle < this.frames.count ? vehicle : null;
    this.trails.select(this.selected);
    if (this.details && this.details.vehicle !== this.selected) this.setDetails(null);
    this.stems.select(this.selected);
    this.changed();
  }

  follow(vehicle: number | null): void {
    if (vehicle !== null) this.sight.chosen();
    this.orbit.follow(vehicle === null ? null : () => this.frames.place(vehicle));
    this.go();
  }

  setView(name: ViewName): void {
    this.sight.chosen();
    this.orbit.setView(name);
    if (this.orbit.aside()) this.sight.aside(this.view);
    this.go();
  }

  fit(): void {
    this.sight.chosen();
    if (this.sight.onSwarm(false)) this.go();
  }

  setCamera(state: CameraState): void {
    this.sight.settled();
    this.orbit.set(state);
    this.changed();
  }

  camera(): CameraState {
    return this.orbit.state();
  }

  setDetails(details: Details | null): void {
    this.details = details && details.vehicle === this.selected ? details : null;
    this.beams.set(this.layers.beams ? this.details : null);
    this.changed();
  }

  setLinks(list: Link[]): void {
    this.radio.setLinks(list, this.frames.count);
    this.changed();
  }

  addPackets(list: Packet[], speed: number): void {
    if (!this.layers.packets || list.length === 0) return;
    this.radio.addPackets(list, this.frames.count, performance.now() / 1000, speed, this.pace.ms / 1000);
    this.changed();
  }

  setWind(arrows: number[][]): void {
    this.wind.set(arrows);
    this.changed();
  }

  png(caption: Caption): Promise<Blob> {
    const { clientWidth: w, clientHeight: h } = this.host;
    // No panel is on it.
    const { covered_px } = this.orbit;
    this.orbit.covered_px = 0;
    this.pace.begin("finest");
    this.overlay.resize(w, h, this.pace.ratio);
    this.draw(performance.now(), caption);
    this.pace.end();
    this.orbit.covered_px = covered_px;
    const from = this.renderer.domElement;
    const canvas = document.createElement("canvas");
    canvas.width = from.width;
    canvas.height = from.height;
    const c = canvas.getContext("2d");
    // In the same task as it was drawn: afterwards the browser may have taken the picture away.
    c?.drawImage(from, 0, 0);
    c?.drawImage(this.overlay.canvas, 0, 0, canvas.width, canvas.height);
    this.overlay.resize(w, h, Math.min(devicePixelRatio, 2));
    this.changed(true);
    return new Promise((done, fail) => {
      canvas.toBlob((blob) => (blob ? done(blob) : fail(new Error("the browser made no picture"))), "image/png");
    });
  }

  setCovered(left_px: number): void {
    if (left_px === this.orbit.covered_px) return;
    this.orbit.covered_px = left_px;
    this.sight.covered();
    this.changed();
  }

  resize(): void {
    const { clientWidth: w, clientHeight: h } = this.host;
    if (w === 0 || h === 0) return;
    this.orbit.resize(w, h);
    this.setRatio(this.pace.ratio);
    this.overlay.resize(w, h, Math.min(devicePixelRatio, 2));
    this.changed();
  }

  stats(): { drawn: number; ms: number } {
    return { drawn: this.pace.drawn, ms: this.pace.ms };
  }

  quiet(): boolean {
    return this.request === 0 && this.pace.quiet;
  }

  dispose(): void {
    this.disposed = true;
    cancelAnimationFrame(this.request);
    clearTimeout(this.tellTimer);
    for (const end of this.ends) end();
    for (const part of [this.pace, this.pointing, this.vehicles, this.world, this.shadows, this.ground, this.sky, this.trails, this.radio, this.beams, this.wind, this.stems, this.textures, this.frames]) {
      part.dispose();
    }
    this.renderer.dispose();
    this.renderer.domElement.remove();
    this.overlay.canvas.remove();
  }

  /** Is the swarm under a roof? */
  private lookUp(): void {
    if (this.disposed) return;
    const height_m = this.sight.height_m();
    if (this.world.reachesAbove(height_m)) this.options.onOverhead(!this.layers.cut && this.sight.hidden(height_m));
  }

  /** Cuts away what of the world begins above this, with its shadow. */
  private cut(ceiling_m: number): void {
    if (ceiling_m === this.world.ceiling_m || !this.world.cut(ceiling_m)) return;
    this.shadows.draw();
    this.changed();
  }

  // Drawing.

  /** The camera has somewhere to go. */
  private go(): void {
    if (!this.moving) this.lastDraw = performance.now();
    this.moving = true;
    this.changed();
  }

  /** Asks for a picture; `fine`: the same once more, as nothing moves. */
  private changed(fine = false): void {
    this.fine &&= fine;
    if (this.request !== 0 || this.disposed) return;
    this.fine = fine;
    this.request = requestAnimationFrame((now) => {
      this.request = 0;
      if (this.disposed) return;
      this.pace.begin(this.fine ? "rest" : "motion");
      if (this.moving) this.moving = this.orbit.step((now - this.lastDraw) / 1000);
      this.draw(now);
      this.pace.end();
      this.pointing.again();
      const busy = this.moving || (this.layers.packets && this.radio.busy(performance.now() / 1000));
      if (busy) this.changed();
      this.tell();
    });
  }

  private draw(now: number, caption?: Caption): void {
    this.lastDraw = now;
    const { orbit, shared } = this;
    const distance = orbit.distance();
    const content = this.sight.reach + length(orbit.target());
    // The ground goes on until it is all haze; what is there ends long before.
    const far = 60 * Math.max(content, distance);
    orbit.reach = far;
    orbit.apply();
    shared.uHazeRange.value.set(Math.max(content * 1.6, distance * 2.5) + orbit.retreat, Math.max(content, distance) * 9);
    shared.uShadowFine.value = this.soft && !this.fine ? 0 : 1;
    shared.uFlat.value = orbit.lens().flat ? 1 : 0;
    shared.uClock.value = performance.now() / 1000;
    const { camera } = orbit;
    this.view.multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse);
    shared.uSee.value.copy(this.view);
    this.ground.update(orbit, far, this.sight.reach);
    this.sky.update(orbit, shared);
    this.vehicles.update(this.view.elements, this.scale(), distance);
    this.trails.update();
    if (this.layers.beams) this.beams.update();
    this.wind.look(orbit.along(), orbit.target());
    this.renderer.render(this.scene, camera);
    this.drawOver(caption);
  }

  private drawOver(caption?: Caption): void {
    this.overlay.draw({
      view: this.view.elements,
      width: this.host.clientWidth,
      height: this.host.clientHeight,
      frames: this.frames,
      names: this.options.hello.vehicles.paths,
      labels: this.layers.labels,
      selected: this.selected,
      hovered: this.pointing.vehicle,
      pixel_m: this.orbit.pixel(),
      flat: this.orbit.isFlat(),
      grid: this.layers.grid,
      radius_px: this.radiusOf,
      ...(caption ? { caption } : {}),
    });
  }

  private setRatio(ratio: number): void {
    const { clientWidth: w, clientHeight: h } = this.host;
    if (w === 0 || h === 0) return;
    this.renderer.setPixelRatio(ratio);
    this.renderer.setSize(w, h, false);
    this.shared.uViewport.value.set(this.renderer.domElement.width, this.renderer.domElement.height, ratio);
  }

  /** A metre at clip depth 1, CSS pixels. */
  private scale(): number {
    return (this.orbit.camera.projectionMatrix.elements[5]! * Math.max(this.host.clientHeight, 1)) / 2;
  }

  /** How large a vehicle is drawn, CSS pixels. */
  private radius_px(i: number, w: number): number {
    return this.vehicles.radius_px(i, w, this.scale(), this.orbit.distance(), this.orbit.lens().flat);
  }

  private paintAll(frame: Frame | null): void {
    if (!this.paint.update(frame)) return;
    (this.frames.colours.image.data as unknown as Uint8Array).set(this.paint.bytes);
    this.frames.colours.needsUpdate = true;
  }

  private doubleClick(x: number, y: number): void {
    const vehicle = this.pointing.vehicleAt(x, y);
    const point = vehicle === null ? this.pointing.pointAt(x, y) : this.frames.place(vehicle);
    if (!point || this.orbit.following()) return;
    this.sight.chosen();
    this.orbit.lookAt(point);
    this.go();
  }

  private tell(): void {
    if (this.tellTimer !== 0) return;
    this.tellTimer = window.setTimeout(() => {
      this.tellTimer = 0;
      const state = this.orbit.state();
      const text = JSON.stringify(state);
      if (text === this.told) return;
      this.told = text;
      this.options.onCamera(state);
    }, TELL_MS);
  }
}
