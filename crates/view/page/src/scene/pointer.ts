// Mouse, touch and trackpad: turns, shifts and zooms the camera; tells clicks and where the pointer is.
//
// Left button or one finger turns (in a flat view it shifts); right or middle button, shift, or two fingers shift
// (in a flat view the right button turns, and so leaves it); wheel and pinch zoom to the pointer.

import type { Orbit } from "./camera";

export interface PointerEvents {
  /** The camera has somewhere to go. */
  moved(): void;
  /** CSS pixels from the upper left. */
  click(x: number, y: number): void;
  doubleClick(x: number, y: number): void;
  /** Where the pointer rests or moves without a button; null: it left. */
  hover(at: { x: number; y: number } | null): void;
}

const CLICK_PX = 5;

/** Returns what ends it. */
export function listen(element: HTMLElement, orbit: Orbit, events: PointerEvents): () => void {
  const down = new Map<number, { x: number; y: number; button: number }>();
  let travelled = 0;
  const abort = new AbortController();
  const options = { signal: abort.signal };

  const place = (e: MouseEvent): { x: number; y: number } => {
    const box = element.getBoundingClientRect();
    return { x: e.clientX - box.left, y: e.clientY - box.top };
  };
  const centred = (x: number, y: number): [number, number] => [
    (2 * x) / Math.max(element.clientWidth, 1) - 1,
    1 - (2 * y) / Math.max(element.clientHeight, 1),
  ];

  element.addEventListener(
    "pointerdown",
    (e) => {
      if (down.size === 0) travelled = 0;
      down.set(e.pointerId, { ...place(e), button: e.button });
      try {
        element.setPointerCapture(e.pointerId);
      } catch {
        // The pointer is gone already: then it needs no capture.
      }
      events.hover(null);
    },
    options,
  );
  element.addEventListener(
    "pointermove",
    (e) => {
      const at = place(e);
      const last = down.get(e.pointerId);
      if (!last) {
        if (e.pointerType !== "touch") events.hover(at);
        return;
      }
      const [dx, dy] = [at.x - last.x, at.y - last.y];
      travelled += Math.hypot(dx, dy);
      if (down.size === 1) {
        if (travelled < CLICK_PX) return;
        const shifts = (last.button !== 0 || e.shiftKey) !== orbit.isFlat();
        if (shifts) orbit.pan(dx, dy);
        else orbit.orbit(dx, dy);
      } else if (down.size === 2) {
        const other = [...down].find(([id]) => id !== e.pointerId)![1];
        const before = Math.hypot(last.x - other.x, last.y - other.y);
        const after = Math.hypot(at.x - other.x, at.y - other.y);
        orbit.pan(dx / 2, dy / 2);
        if (before > 1 && after > 1) {
          orbit.zoomBy(before / after, ...centred((at.x + other.x) / 2, (at.y + other.y) / 2));
        }
      }
      last.x = at.x;
      last.y = at.y;
      events.moved();
    },
    options,
  );
  const up = (e: PointerEvent): void => {
    const was = down.get(e.pointerId);
    down.delete(e.pointerId);
    if (e.type === "pointerup" && was && was.button === 0 && down.size === 0 && travelled < CLICK_PX) {
      const { x, y } = place(e);
      events.click(x, y);
    }
  };
  element.addEventListener("pointerup", up, options);
  element.addEventListener("pointercancel", up, options);
  element.addEventListener("pointerleave", () => events.hover(null), options);
  element.addEventListener(
    "dblclick",
    (e) => {
      const { x, y } = place(e);
      events.doubleClick(x, y);
    },
    options,
  );
  element.addEventListener("contextmenu", (e) => e.preventDefault(), options);
  element.addEventListener(
    "wheel",
    (e) => {
      e.preventDefault();
      const lines = e.deltaMode === 1 ? 16 : e.deltaMode === 2 ? 400 : 1;
      // A pinch on a trackpad comes as a wheel with the control key, in small steps.
      const strength = e.ctrlKey ? 0.01 : 0.0015;
      const { x, y } = place(e);
      const delta = Math.max(-300, Math.min(300, e.deltaY * lines));
      orbit.zoomBy(Math.exp(delta * strength), ...centred(x, y));
      events.moved();
    },
    { signal: abort.signal, passive: false },
  );
  element.style.touchAction = "none";
  return () => abort.abort();
}
