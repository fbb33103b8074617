// Elements in one line each. Nothing here takes HTML as text: names from a run are text and stay text.

type Child = Node | string | null | undefined | false;
type Attributes = {
  class?: string;
  text?: string;
  on?: { [event: string]: (event: never) => void };
  [name: string]: unknown;
};

export function h<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  attributes: Attributes = {},
  ...children: Child[]
): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (value === undefined || value === null || value === false) continue;
    if (name === "text") element.textContent = String(value);
    else if (name === "on") {
      for (const [event, listener] of Object.entries(value as object)) {
        element.addEventListener(event, listener as EventListener);
      }
    } else element.setAttribute(name, value === true ? "" : String(value));
  }
  element.append(...children.filter((child): child is Node | string => !!child));
  return element;
}

/** Sets a text only if it is another one: what does not change costs no layout. */
export function say(element: Element, text: string): void {
  if (element.textContent !== text) element.textContent = text;
}

export function show(element: HTMLElement, shown: boolean): void {
  if (element.hidden === shown) element.hidden = !shown;
}

const svgSpace = "http://www.w3.org/2000/svg";

export function svg(tag: string, attributes: Record<string, string | number>): SVGElement {
  const element = document.createElementNS(svgSpace, tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, String(value));
  return element;
}

/** A button with an icon. `label` is what it does, in words, `key` the key that does the same. */
export function button(
  label: string,
  key: string | null,
  content: Node | string,
  act: () => void,
  extra: Attributes = {},
  ...more: Child[]
): HTMLButtonElement {
  return h(
    "button",
    {
      type: "button",
      title: key ? `${label} (${key})` : label,
      "aria-label": label,
      "aria-keyshortcuts": key ?? undefined,
      on: { click: act },
      ...extra,
    },
    content,
    ...more,
  );
}
