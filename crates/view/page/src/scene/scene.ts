// The scene as a whole: puts the parts together, and draws when something has changed.

import * as THREE from "three";
import type { CameraState, ColourBy, Layers, SceneOptions, SceneView, ViewName } from "./index";
import type { Details, Frame, Link, Packet, Vec3 } from "../wire";
import { Beams } from "./beams";
import { Orbit } from "./camera";
import { Frames } from "./frames";
import { Ground } from "./ground";
import { createShared, setTheme, type Shared } from "./light";
import { Lines } from "./lines";
import { Overlay } from "./overlay";
import { Paint } from "./paint";
import { Pace } from "./pace";
import { firstHit, nearest } from "./picking";
import { listen } from "./pointer";
import { Radio } from "./radio";
import { castShadows } from "./shadow";
import { Textures } from "./textures";
import { Trails } from "./trails";
import { Vehicles } from "./vehicles";
import { Wind } from "./wind";
import { World } from "./world";

/** How often hovering asks what is there, and the camera tells where it is, ms. */
const HOVER_MS = 60;
const TELL_MS = 250;
/** The first view goes with the swarm for so long, s of virtual time, unless somebody looks elsewhere. */
const FIRST_VIEW_S = 10;

const ALL: Layers = { labels: false, trails: true, links: true, packets: true, beams: true, wind: true, grid: true, world: true };

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
  private ground: Ground;
  private trails: Trails;
  private radio: Radio;
  private beams: Beams;
  private wind: Wind;
  private drop: Lines;
  private overlay = new Overlay();
  private pace: Pace;
  private layers = ALL;
  private selected: number | null = null;
  private details: Details | null = null;
  private dark: boolean;
  private placed = false;
  /** When the view that nobody has chosen began; null: somebody has. */
  private firstView_s: number | null = null;
  private request = 0;
  private lastDraw = 0;
  private moving = false;
  private view = new THREE.Matrix4();
  private ends: (() => void)[] = [];
  private hoverAt: { x: number; y: number } | null = null;
  private hoverTimer = 0;
  private hovered: string | null = null;
  private told = "";
  private tellTimer = 0;
  private reach = 10;
  private disposed = false;
  private fine = false;

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
    this.shared.uShadowFine.value = soft ? 0 : 1;
    const count = hello.vehicles.paths.length;
    this.frames = new Frames(count, hello.vehicles.radii_m);
    this.paint = new Paint(hello, count, (legend) => options.onLegend(legend));
    this.textures = new Textures(() => this.changed());
    this.ground = new Ground(hello.stage.ground, hello.stage.plane, hello.stage.radius_m, this.shared);
    this.world = new World(hello, this.shared, this.textures, this.ground.uniforms);
    this.vehicles = new Vehicles(hello, this.frames, this.shared);
    this.trails = new Trails(this.frames, this.shared, (i) => this.paint.colour(i));
    this.radio = new Radio(this.frames, this.shared);
    this.beams = new Beams(this.frames, this.shared, () => this.reach * 4);
    this.wind = new Wind(this.shared);
    this.drop = new Lines(2, this.frames, this.shared, { width_px: 1.6, order: 9 });
    this.scene.matrixWorldAutoUpdate = true;
    this.scene.add(this.ground.group, this.world.group, this.vehicles.group, ...this.trails.meshes());
    this.scene.add(this.radio.links.mesh, this.radio.pulses.mesh, this.beams.group, this.wind.mesh, this.drop.mesh);
    this.ends.push(castShadows(this.renderer, this.world.group, this.world.bounds, this.shared));

    this.pace = new Pace(
      this.renderer,
      soft,
      (ratio) => this.setRatio(ratio),
      () => this.changed(true),
    );
    this.ends.push(
      listen(canvas, this.orbit, {
        moved: () => {
          this.firstView_s = null;
          this.go();
        },
        click: (x, y) => this.click(x, y),
        doubleClick: (x, y) => this.doubleClick(x, y),
        hover: (at) => this.hover(at),
      }),
    );
    const lost = (e: Event): void => e.preventDefault();
    const back = (): void => this.changed();
    canvas.addEventListener("webglcontextlost", lost);
    canvas.addEventListener("webglcontextrestored", back);
    const observer = new ResizeObserver(() => this.resize());
    observer.observe(host);
    this.ends.push(() => observer.disconnect());
    this.setDark(this.dark);
    this.paintAll(null);
    this.resize();
    this.frameWorld();
  }

  show(a: Frame, b: Frame, f: number): void {
    const before = this.frames.a;
    const beforeB = this.frames.b;
    if (before === a && beforeB === b && this.frames.f === f) return;
    this.frames.show(a, b, f);
    if (before !== a || beforeB !== b) {
      this.paintAll(b);
      this.trails.passed(a);
    }
    if (!this.placed) {
      this.placed = true;
      this.frameSwarm(true);
      this.firstView_s = a.time;
    } else if (this.firstView_s !== null) this.keepInSight(b.time - this.firstView_s);
    this.changed();
  }

  jumped(): void {
    this.trails.clear();
    this.changed();
  }

  setDark(dark: boolean): void {
    this.dark = dark;
    setTheme(this.shared, dark);
    this.ground.setDark(dark);
    this.vehicles.setDark(dark);
    this.wind.setDark(dark);
    this.radio.setDark(dark);
    this.overlay.dark = dark;
    this.dropLine();
    this.changed();
  }

  setLayers(layers: Layers): void {
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
    this.dropLine();
    this.changed();
  }

  follow(vehicle: number | null): void {
    if (vehicle !== null) this.firstView_s = null;
    this.orbit.follow(vehicle === null ? null : () => this.frames.place(vehicle));
    this.go();
  }

  setView(name: ViewName): void {
    this.firstView_s = null;
    this.orbit.setView(name);
    this.go();
  }

  fit(): void {
    this.firstView_s = null;
    this.frameSwarm(false);
  }

  setCamera(state: CameraState): void {
    this.firstView_s = null;
    this.orbit.set(state);
    this.placed = true;
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
    this.radio.addPackets(list, this.frames.count, performance.now() / 1000, speed);
    this.changed();
  }

  setWind(arrows: number[][]): void {
    this.wind.set(arrows);
    this.changed();
  }

  png(): Promise<Blob> {
    const { clientWidth: w, clientHeight: h } = this.host;
    this.pace.begin(true);
    this.overlay.resize(w, h, this.pace.ratio);
    this.draw(performance.now());
    this.pace.end();
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

  dispose(): void {
    this.disposed = true;
    cancelAnimationFrame(this.request);
    clearTimeout(this.hoverTimer);
    clearTimeout(this.tellTimer);
    for (const end of this.ends) end();
    for (const part of [this.pace, this.vehicles, this.world, this.ground, this.trails, this.radio, this.beams, this.wind, this.drop, this.textures, this.frames]) {
      part.dispose();
    }
    this.renderer.dispose();
    this.renderer.domElement.remove();
    this.overlay.canvas.remove();
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
      this.pace.begin(this.fine);
      if (this.moving) this.moving = this.orbit.step((now - this.lastDraw) / 1000);
      this.draw(now);
      this.pace.end();
      const busy = this.moving || (this.layers.packets && this.radio.busy(performance.now() / 1000));
      if (busy) this.changed();
      this.tell();
    });
  }

  private draw(now: number): void {
    this.lastDraw = now;
    const { hello } = this.options;
    const target = this.orbit.target();
    const distance = this.orbit.distance();
    const content = this.reach + Math.hypot(...target);
    const far = Math.max(content * 3, distance * 14);
    this.orbit.reach = Math.max(far * 1.3, Math.min(hello.stage.radius_m, far * 4));
    this.orbit.apply();
    const near = distance + this.orbit.retreat;
    this.shared.uHazeRange.value.set(far * 0.35 + near, far * 1.25 + near);
    this.shared.uClock.value = performance.now() / 1000;
    this.ground.update(this.orbit, far * 1.6 + distance * 2);
    this.trails.update();
    if (this.layers.beams) this.beams.update();
    const { camera } = this.orbit;
    this.view.multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse);
    this.shared.uSee.value.copy(this.view);
    this.renderer.render(this.scene, camera);
    this.overlay.draw({
      view: this.view.elements,
      width: this.host.clientWidth,
      height: this.host.clientHeight,
      frames: this.frames,
      names: hello.vehicles.paths,
      labels: this.layers.labels,
      selected: this.selected,
      pixel_m: this.orbit.pixel(),
      flat: this.orbit.isFlat(),
      grid: this.layers.grid,
      radius_px: (i, w) => this.radius_px(i, w),
    });
  }

  private setRatio(ratio: number): void {
    const { clientWidth: w, clientHeight: h } = this.host;
    if (w === 0 || h === 0) return;
    this.renderer.setPixelRatio(ratio);
    this.renderer.setSize(w, h, false);
    this.shared.uViewport.value.set(this.renderer.domElement.width, this.renderer.domElement.height, ratio);
  }

  /** How large a vehicle is drawn, CSS pixels; as the shader has it. */
  private radius_px(i: number, w: number): number {
    const pixel = (2 * w) / (this.orbit.camera.projectionMatrix.elements[5]! * Math.max(this.host.clientHeight, 1));
    const radius = this.options.hello.vehicles.radii_m[i] ?? 0.1;
    return Math.max(this.vehicles.least, radius / pixel);
  }

  private paintAll(frame: Frame | null): void {
    this.paint.update(frame);
    (this.frames.colours.image.data as unknown as Uint8Array).set(this.paint.bytes);
    this.frames.colours.needsUpdate = true;
  }

  /** From the selected vehicle down to the ground. */
  private dropLine(): void {
    this.drop.clear();
    if (this.selected !== null && this.options.hello.stage.plane) {
      this.drop.add(this.selected, this.selected, this.dark ? [255, 213, 74, 220] : [214, 0, 108, 220]);
    }
    this.drop.flush();
  }

  // Where to look.

  /** Before the first frame: the world. */
  private frameWorld(): void {
    const box = this.world.bounds;
    if (box.isEmpty()) return;
    this.reach = Math.max(this.reach, box.min.length(), box.max.length());
    this.orbit.fit(corners(box), 0, true);
  }

  private frameSwarm(atOnce: boolean): void {
    const box = new THREE.Box3();
    let radius = 0.05;
    const points: Vec3[] = [];
    for (let i = 0; i < this.frames.count; i++) {
      const p = this.frames.place(i);
      if (!p) continue;
      points.push(p);
      box.expandByPoint(new THREE.Vector3(...p));
      radius = Math.max(radius, this.options.hello.vehicles.radii_m[i] ?? 0);
    }
    if (points.length === 0) return;
    const size = box.getSize(new THREE.Vector3()).length();
    this.reach = Math.max(this.reach, box.min.length(), box.max.length());
    // With the ground below, and with the world around, if that is not much larger than the swarm.
    const around = this.world.bounds;
    const wide = around.isEmpty() ? Infinity : around.getSize(new THREE.Vector3()).length();
    if (atOnce && wide < Math.max(size, radius * 20) * 1.4) points.push(...corners(around));
    this.orbit.fit(points, Math.max(radius * 3, size * 0.03, 0.3), atOnce);
    this.go();
  }

  /** A swarm that leaves the first view is followed by it: what starts far from where it goes would leave it empty. */
  private keepInSight(passed_s: number): void {
    if (passed_s < 0 || passed_s > FIRST_VIEW_S) {
      this.firstView_s = null;
      return;
    }
    if (this.moving) return;
    let [seen, all] = [0, 0];
    const at = new THREE.Vector4();
    for (let i = 0; i < this.frames.count; i++) {
      const p = this.frames.place(i);
      if (!p) continue;
      all += 1;
      at.set(...p, 1).applyMatrix4(this.view);
      if (at.w > 0 && Math.abs(at.x) <= at.w && Math.abs(at.y) <= at.w) seen += 1;
    }
    if (seen < 0.7 * all) this.frameSwarm(false);
  }

  // People.

  private click(x: number, y: number): void {
    this.options.onPick(this.vehicleAt(x, y));
  }

  private doubleClick(x: number, y: number): void {
    const vehicle = this.vehicleAt(x, y);
    const point = vehicle === null ? this.pointAt(x, y) : this.frames.place(vehicle);
    if (!point || this.orbit.following()) return;
    this.firstView_s = null;
    this.orbit.lookAt(point);
    this.go();
  }

  private vehicleAt(x: number, y: number): number | null {
    const { clientWidth: w, clientHeight: h } = this.host;
    const { count } = this.frames;
    return nearest(count, (i) => this.frames.place(i), this.view.elements, w, h, x, y, (i, depth) => this.radius_px(i, depth));
  }

  private ray(x: number, y: number): { from: Vec3; along: Vec3 } {
    return this.orbit.ray((2 * x) / this.host.clientWidth - 1, 1 - (2 * y) / this.host.clientHeight);
  }

  /** What is there to stand on: a thing of the world, or the ground. */
  private pointAt(x: number, y: number): Vec3 | null {
    const { from, along } = this.ray(x, y);
    const hit = this.layers.world ? firstHit(this.world, from, along) : null;
    const ground = along[2] < 0 && from[2] > 0 ? -from[2] / along[2] : Infinity;
    const away = Math.min(hit?.away_m ?? Infinity, ground);
    return Number.isFinite(away) ? [from[0] + along[0] * away, from[1] + along[1] * away, from[2] + along[2] * away] : null;
  }

  private hover(at: { x: number; y: number } | null): void {
    this.hoverAt = at;
    if (this.hoverTimer !== 0) return;
    this.hoverTimer = window.setTimeout(() => {
      this.hoverTimer = 0;
      this.told_hover(this.hoverAt ? this.nameAt(this.hoverAt.x, this.hoverAt.y) : null);
    }, HOVER_MS);
  }

  private told_hover(text: string | null): void {
    if (text === this.hovered) return;
    this.hovered = text;
    this.options.onHover(text);
  }

  private nameAt(x: number, y: number): string | null {
    const { hello } = this.options;
    const vehicle = this.vehicleAt(x, y);
    this.renderer.domElement.style.cursor = vehicle === null ? "" : "pointer";
    if (vehicle !== null) return `${hello.vehicles.paths[vehicle]} · ${hello.vehicles.kinds[vehicle]}`;
    if (!this.layers.world) return null;
    const { from, along } = this.ray(x, y);
    const hit = firstHit(this.world, from, along);
    if (!hit) return null;
    const prop = this.world.props[hit.target.prop]!;
    const meta = Object.entries(prop.meta).map(([key, value]) => `${key} ${value}`);
    return [prop.label || prop.kind, ...(prop.label ? [prop.kind] : []), ...meta.slice(0, 3)].join(" · ");
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

/** Whether the browser has no graphics card to draw with. */
function drawnBySoftware(): boolean {
  const gl = document.createElement("canvas").getContext("webgl2");
  if (!gl) return false;
  const info = gl.getExtension("WEBGL_debug_renderer_info");
  const name = String(gl.getParameter(info ? info.UNMASKED_RENDERER_WEBGL : gl.RENDERER));
  gl.getExtension("WEBGL_lose_context")?.loseContext();
  return /swiftshader|llvmpipe|softpipe|software|basic render/i.test(name);
}

function corners(box: THREE.Box3): Vec3[] {
  const ends = [box.min, box.max];
  return Array.from({ length: 8 }, (_, i) => [ends[i & 1]!.x, ends[(i >> 1) & 1]!.y, ends[(i >> 2) & 1]!.z]);
}
