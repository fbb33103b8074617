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

export function listen(table: Key[], signal: AbortSignal): void {
  const acts = new Map<string, Key>();
  for (const key of table) for (const name of key.keys) acts.set(name, key);
  document.addEventListener(
    "keydown",
    (event) => {
      if (event.ctrlKey || event.altKey || event.metaKey || event.defaultPrevented || writes(event.target)) return;
      const name = nameOfKey(event);
      // A button that has the focus is pressed by these.
      const pressed = event.target instanceof HTMLButtonElement || (event.target instanceof HTMLElement && event.target.tagName === "SUMMARY");
      if (pressed && (name === "Enter" || (name === "Space" && !(event.target as HTMLElement).closest(".bar")))) return;
      const key = acts.get(name);
      // Over an open sheet only the key that opened it works; Escape is the browser's own.
      if (!key || (document.querySelector("dialog[open]") && name !== "?" && name !== "h")) return;
      event.preventDefault();
      key.act();
    },
    { signal },
  );
}
