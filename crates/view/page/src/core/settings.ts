// What this browser remembers of the page: its theme, the size of its text, and that somebody has used it. Without storage: nothing.

import { Signal } from "./signal";
import type { Theme } from "./place";

function remembered(name: string): string | null {
  try {
    return localStorage.getItem(`simbeeotic.${name}`);
  } catch {
    return null;
  }
}

function remember(name: string, value: string): void {
  try {
    localStorage.setItem(`simbeeotic.${name}`, value);
  } catch {
    // A browser that keeps nothing: the page works all the same.
  }
}

export class Settings {
  readonly theme: Signal<Theme>;
  readonly large: Signal<boolean>;
  /** Whether nobody has used the picture in this browser yet. */
  readonly newcomer: Signal<boolean>;
  /** Whether the page is dark now, by its own theme or the system's. */
  readonly dark: Signal<boolean>;
  private readonly system = matchMedia("(prefers-color-scheme: dark)");

  constructor() {
    const theme = remembered("theme");
    this.theme = new Signal<Theme>(theme === "light" || theme === "dark" ? theme : "auto");
    this.large = new Signal(remembered("text") === "large");
    this.newcomer = new Signal(remembered("met") !== "yes");
    this.newcomer.on(() => remember("met", "yes"));
    this.dark = new Signal(this.isDark());
    const apply = () => {
      const dark = this.isDark();
      document.documentElement.dataset.theme = dark ? "dark" : "light";
      document.documentElement.dataset.text = this.large.value ? "large" : "normal";
      // Last: who hears of it reads the colours of the theme.
      this.dark.value = dark;
    };
    apply();
    this.system.addEventListener("change", apply);
    this.theme.on((theme) => {
      remember("theme", theme);
      apply();
    });
    this.large.on((large) => {
      remember("text", large ? "large" : "normal");
      apply();
    });
  }

  nextTheme(): void {
    this.theme.value = ({ auto: "light", light: "dark", dark: "auto" } as const)[this.theme.value];
  }

  private isDark(): boolean {
    return this.theme.value === "dark" || (this.theme.value === "auto" && this.system.matches);
  }
}
