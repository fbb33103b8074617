// Lines from vehicles down to the ground: faint ones where there are few, so that heights can be compared, and one
// that stands out for the selected vehicle.

import type { Hello } from "../wire";
import type { Frames } from "./frames";
import type { Shared } from "./light";
import { Lines } from "./lines";

/** Above so many vehicles only the selected one has a stem. */
const MOST = 150;

export class Stems {
  private all: Lines | null = null;
  private own: Lines;
  private selected: number | null = null;
  private dark = false;
  private plane: boolean;

  constructor(hello: Hello, frames: Frames, shared: Shared) {
    this.plane = hello.stage.plane;
    this.own = new Lines(1, frames, shared, { width_px: 1.8, stem: true, order: 9 });
    const who = hello.vehicles.roles.map((_, i) => i).filter((i) => hello.vehicles.roles[i] === "vehicle");
    if (!this.plane || who.length === 0 || who.length > MOST) return;
    this.all = new Lines(who.length, frames, shared, { width_px: 0.9, stem: true, order: 7 });
    for (const i of who) this.all.add(i, i, [0, 0, 0, 0]);
  }

  meshes(): Lines["mesh"][] {
    return this.all ? [this.all.mesh, this.own.mesh] : [this.own.mesh];
  }

  setDark(dark: boolean): void {
    this.dark = dark;
    if (this.all) {
      const colour = dark ? [190, 210, 235, 62] : [24, 36, 52, 58];
      for (let i = 0; i < this.all.count; i++) this.all.recolour(i, colour);
      this.all.flush();
    }
    this.select(this.selected);
  }

  select(vehicle: number | null): void {
    this.selected = vehicle;
    this.own.clear();
    if (vehicle !== null && this.plane) this.own.add(vehicle, vehicle, this.dark ? [255, 213, 74, 220] : [214, 0, 108, 220]);
    this.own.flush();
  }

  dispose(): void {
    this.all?.dispose();
    this.own.dispose();
  }
}
