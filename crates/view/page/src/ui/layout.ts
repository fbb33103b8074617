// Which panels are open. On a narrow page they lie over the picture, one at a time.

import { Signal } from "../core/signal";

export type Panel = "layers" | "vehicles" | "charts";
export type Tab = "vehicles" | "marks";

export class Layout {
  readonly open: Signal<ReadonlySet<Panel>>;
  readonly tab = new Signal<Tab>("vehicles");
  readonly narrow = matchMedia("(max-width: 52rem)");

  constructor() {
    this.open = new Signal<ReadonlySet<Panel>>(this.narrow.matches ? new Set() : new Set(["layers", "vehicles", "charts"]));
  }

  /** A page that becomes narrow shows its picture; one that becomes wide again, the panels that it had. */
  listen(gone: AbortSignal): void {
    let wide: ReadonlySet<Panel> = new Set(["layers", "vehicles", "charts"]);
    this.narrow.addEventListener(
      "change",
      () => {
        if (this.narrow.matches) wide = this.open.value;
        this.open.value = this.narrow.matches ? new Set() : wide;
      },
      { signal: gone },
    );
  }

  has(panel: Panel): boolean {
    return this.open.value.has(panel);
  }

  set(panel: Panel, open: boolean): void {
    if (this.has(panel) === open) return;
    const next = new Set(this.narrow.matches ? [] : this.open.value);
    if (open) next.add(panel);
    else next.delete(panel);
    this.open.value = next;
  }

  toggle(panel: Panel): void {
    this.set(panel, !this.has(panel));
  }

  /** Opens a tab of the panel of vehicles; if it is open: closes the panel. */
  toggleTab(tab: Tab): void {
    if (this.has("vehicles") && this.tab.value === tab) this.set("vehicles", false);
    else {
      this.tab.value = tab;
      this.set("vehicles", true);
    }
  }
}
