// What people point at: the vehicle under the pointer, a link, an arrow of the wind, or the thing of the world, and its name.

import type { SceneOptions } from "./index";
import { fixed, number } from "../core/format";
import type { Link, Vec3 } from "../wire";
import type { Orbit } from "./camera";
import type { Frames } from "./frames";
import { firstHit, nearest, nearestLine } from "./picking";
import type { Arrow } from "./wind";
import type { World } from "./world";

function* ends(links: Link[], frames: Frames): Iterable<readonly [Vec3, Vec3] | null> {
  for (const [from, to] of links) {
    const [a, b] = [frames.place(from), frames.place(to)];
    yield a && b ? [a, b] : null;
  }
}

/** How often hovering asks what is there, ms. */
const HOVER_MS = 60;

export interface Pointed {
  host: HTMLElement;
  orbit: Orbit;
  frames: Frames;
  world: World;
  /** The last picture's view-projection, column-major. */
  view: ArrayLike<number>;
  /** Links and arrows that are shown. */
  links(): Link[];
  arrows(): Arrow[];
  /** Whether the world is shown. */
  worldShown(): boolean;
  /** The radius of a vehicle on the screen at clip depth `w`, CSS pixels. */
  radius_px(i: number, w: number): number;
  /** Another vehicle, or none, is pointed at. */
  changed(): void;
}

export class Pointing {
  private at: { x: number; y: number } | null = null;
  private timer = 0;
  /** The vehicle under the pointer. */
  vehicle: number | null = null;
  private told: string | null = null;
  private spot = new Float64Array(3);

  constructor(
    private options: SceneOptions,
    private to: Pointed,
  ) {}

  vehicleAt(x: number, y: number): number | null {
    const { host, frames, view } = this.to;
    const p = this.spot;
    return nearest(frames.count, (i) => (frames.read(i, p) ? p : null), view, host.clientWidth, host.clientHeight, x, y, (i, w) => this.to.radius_px(i, w));
  }

  /** What is there to stand on: a thing of the world, or the ground. */
  pointAt(x: number, y: number): Vec3 | null {
    const { from, along } = this.ray(x, y);
    const hit = this.to.worldShown() ? firstHit(this.to.world, from, along) : null;
    const ground = along[2] < 0 && from[2] > 0 ? -from[2] / along[2] : Infinity;
    const away = Math.min(hit?.away_m ?? Infinity, ground);
    return Number.isFinite(away) ? [from[0] + along[0] * away, from[1] + along[1] * away, from[2] + along[2] * away] : null;
  }

  hover(at: { x: number; y: number } | null): void {
    this.at = at;
    if (this.timer !== 0) return;
    this.timer = window.setTimeout(() => {
      this.timer = 0;
      const before = this.vehicle;
      this.vehicle = this.at ? this.vehicleAt(this.at.x, this.at.y) : null;
      if (this.vehicle !== before) this.to.changed();
      this.tell(this.at ? this.nameAt(this.at.x, this.at.y) : null);
    }, HOVER_MS);
  }

  /** What is there has moved on, and the pointer has not. */
  again(): void {
    if (this.at) this.hover(this.at);
  }

  dispose(): void {
    clearTimeout(this.timer);
  }

  private tell(text: string | null): void {
    if (text === this.told) return;
    this.told = text;
    this.options.onHover(text);
  }

  private ray(x: number, y: number): { from: Vec3; along: Vec3 } {
    const { host, orbit } = this.to;
    return orbit.ray((2 * x) / host.clientWidth - 1, 1 - (2 * y) / host.clientHeight);
  }

  /** The link or the arrow of the wind that is there, in numbers. */
  private lineAt(x: number, y: number): string | null {
    const { host, frames, view } = this.to;
    const near = (lines: Iterable<readonly [Vec3, Vec3] | null>) => nearestLine(lines, view, host.clientWidth, host.clientHeight, x, y);
    const links = this.to.links();
    const link = links[near(ends(links, frames)) ?? -1];
    if (link) {
      const { paths } = this.options.hello.vehicles;
      const told = ([, , rssi, share]: Link) => `${fixed(rssi, 0)}\u00a0dBm, ${fixed(100 * share, 0)}\u00a0% received`;
      // The way back is the same line.
      const back = links.find(([from, to]) => from === link[1] && to === link[0]);
      return `${paths[link[0]]} → ${paths[link[1]]}: ${told(link)}${back ? `; back: ${told(back)}` : ""}`;
    }
    const arrows = this.to.arrows();
    const arrow = arrows[near(arrows.map(({ from, to }) => [from, to] as const)) ?? -1];
    return arrow ? `wind · ${number(arrow.speed_m_s, 2)}\u00a0m/s` : null;
  }

  private nameAt(x: number, y: number): string | null {
    const { hello } = this.options;
    const { vehicle } = this;
    this.to.host.style.cursor = vehicle === null ? "" : "pointer";
    if (vehicle !== null) return `${hello.vehicles.paths[vehicle]} · ${hello.vehicles.kinds[vehicle]}`;
    const line = this.lineAt(x, y);
    if (line !== null || !this.to.worldShown()) return line;
    const { from, along } = this.ray(x, y);
    const hit = firstHit(this.to.world, from, along);
    if (!hit) return null;
    const prop = this.to.world.props[hit.target.prop]!;
    const meta = Object.entries(prop.meta).map(([key, value]) => `${key} ${value}`);
    return [prop.label || prop.kind, ...(prop.label ? [prop.kind] : []), ...meta.slice(0, 3)].join(" · ");
  }
}
