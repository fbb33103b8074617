// The keys: one table, from which they work and from which the help sheet is made.

export interface Key {
  group: string;
  /** As the browser names it, with `Shift+` in front of letters that are written large. */
  keys: string[];
  does: string;
  act(): void;
}

/** The name of a key press in the table: `a`, `Shift+F`, `Space`, `?`. */
export function nameOfKey(event: KeyboardEvent): string {
  if (event.key === " ") return "Space";
  const letter = /^[a-z]$/i.test(event.key);
  if (letter) return (event.shiftKey ? "Shift+" : "") + (event.shiftKey ? event.key.toUpperCase() : event.key.toLowerCase());
  return event.key;
}

/** Whether keys are text where the cursor is. */
function writes(target: EventTarget | null): boolean {
  if (!(target instanceof HTMLElement)) return false;
  if (target instanceof HTMLInputElement) return !["checkbox", "radio", "button"].includes(target.type);
  return target instanceof HTMLTextAreaElement || target instanceof HTMLSelectElement || target.isContentEditable;
}

/** What Space and Enter press, if it has the focus. */
function pressable(target: EventTarget | null): boolean {
  if (target instanceof HTMLInputElement) return ["checkbox", "radio", "button"].includes(target.type);
  return target instanceof HTMLButtonElement || (target instanceof HTMLElement && target.tagName === "SUMMARY");
}

/** What was pressed with the mouse gives the keys back; what was reached by keys keeps them. */
function giveBack(signal: AbortSignal): void {
  let keyed: EventTarget | null = null;
  document.addEventListener("keydown", (event) => (keyed = event.target), { signal, capture: true });
  document.addEventListener("focusin", () => (keyed = null), { signal, capture: true });
  document.addEventListener(
    "click",
    (event) => {
      const focused = document.activeElement;
      // A press by key comes as a click, too, without a count.
      if (event.detail > 0 && focused instanceof HTMLElement && pressable(focused)) focused.blur();
    },
    { signal },
  );
  document.addEventListener(
    "change",
    (event) => {
      if (event.target instanceof HTMLSelectElement && keyed !== event.target) event.target.blur();
    },
    { signal },
  );
}

export function listen(table: Key[], signal: AbortSignal): void {
  const acts = new Map<string, Key>();
  for (const key of table) for (const name of key.keys) acts.set(name, key);
  giveBack(signal);
  document.addEventListener(
    "keydown",
    (event) => {
      if (event.ctrlKey || event.altKey || event.metaKey || event.defaultPrevented || writes(event.target)) return;
      const name = nameOfKey(event);
      // What has the focus is pressed by these.
      if (pressable(event.target) && (name === "Enter" || name === "Space")) return;
      const key = acts.get(name);
      // Escape closes what has popped up, by the browser's own hand.
      if (name === "Escape" && document.querySelector(":popover-open")) return;
      // Over an open sheet only the key that opened it works; Escape is the browser's own.
      if (!key || (document.querySelector("dialog[open]") && name !== "?" && name !== "h")) return;
      event.preventDefault();
      key.act();
    },
    { signal },
  );
}
