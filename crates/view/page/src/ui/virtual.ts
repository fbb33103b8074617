// A list of which only the rows in sight exist: ten thousand vehicles are as quick as ten.

import { h } from "../core/dom";

export interface VirtualList {
  readonly element: HTMLElement;
  /** There are `count` rows now, or the same ones look different. */
  update(count: number): void;
  reveal(index: number): void;
}

/** `row` makes row number `index`; its height is `height_rem`. */
export function virtualList(label: string, height_rem: number, row: (index: number) => HTMLElement): VirtualList {
  const space = h("div", { class: "rows" });
  const element = h("div", { class: "list", role: "group", "aria-label": label, tabindex: "-1" }, space);
  let count = 0;
  const height = () => height_rem * Number.parseFloat(getComputedStyle(document.documentElement).fontSize);
  const draw = () => {
    const row_px = height();
    space.style.height = `${count * row_px}px`;
    const first = Math.max(0, Math.floor(element.scrollTop / row_px) - 4);
    const last = Math.min(count, Math.ceil((element.scrollTop + element.clientHeight) / row_px) + 4);
    const focused = document.activeElement instanceof HTMLElement ? document.activeElement.dataset.index : undefined;
    const held = space.contains(document.activeElement);
    const rows: HTMLElement[] = [];
    for (let index = first; index < last; index += 1) {
      const item = row(index);
      item.dataset.index = String(index);
      item.style.top = `${index * row_px}px`;
      item.style.height = `${row_px}px`;
      rows.push(item);
    }
    space.replaceChildren(...rows);
    if (held) rows.find((item) => item.dataset.index === focused)?.focus({ preventScroll: true });
  };
  element.addEventListener("scroll", draw, { passive: true });
  new ResizeObserver(draw).observe(element);
  return {
    element,
    update(next) {
      count = next;
      draw();
    },
    reveal(index) {
      const top = index * height();
      if (top < element.scrollTop) element.scrollTop = top;
      else if (top + height() > element.scrollTop + element.clientHeight) {
        element.scrollTop = top + height() - element.clientHeight;
      }
    },
  };
}
