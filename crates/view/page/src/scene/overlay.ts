// What is written over the picture: names of vehicles, the ring around the selected one with its height, a scale.
// A canvas above the one in three dimensions, so that a saved picture has it too.

import { drawCaption, type Caption } from "./caption";
import type { Frames } from "./frames";
import { niceBelow, project } from "./math";

const MOST_LABELS = 60;
/** Scale and compass are below the notices that the page has at the top, which grow with the text; panels cover the other edges. */
const TOP_PX = 36;
const NOTICE_PX = 44;
const FAMILY = 'system-ui, -apple-system, "Segoe UI", "Liberation Sans", sans-serif';
/** The size of the page's text for which the words over the picture are 12 pixels high: with large text they grow. */
const PAGE_TEXT_PX = 13;

export interface OverlayInput {
  view: ArrayLike<number>;
  width: number;
  height: number;
  frames: Frames;
  names: string[];
  labels: boolean;
  selected: number | null;
  /** Under the pointer. */
  hovered: number | null;
  /** A CSS pixel at the target, m. */
  pixel_m: number;
  flat: boolean;
  grid: boolean;
  /** The drawn radius of a vehicle at clip depth w, CSS pixels. */
  radius_px(i: number, w: number): number;
  /** Of a picture that is saved. */
  caption?: Caption;
}

export class Overlay {
  readonly canvas = document.createElement("canvas");
  private c: CanvasRenderingContext2D | null;
  private widths = new Map<string, number>();
  private ratio = 1;
  private spot = new Float64Array(3);
  private page_px = 0;
  /** How much larger than usual words are. */
  private size = 1;
  private font = `12px ${FAMILY}`;
  dark = false;

  constructor() {
    this.c = this.canvas.getContext("2d");
    Object.assign(this.canvas.style, { position: "absolute", inset: "0", width: "100%", height: "100%", pointerEvents: "none" });
  }

  resize(width: number, height: number, ratio: number): void {
    this.ratio = ratio;
    this.setFont();
    this.canvas.width = Math.max(1, Math.round(width * ratio));
    this.canvas.height = Math.max(1, Math.round(height * ratio));
  }

  draw(input: OverlayInput): void {
    const c = this.c;
    if (!c) return;
    c.setTransform(this.ratio, 0, 0, this.ratio, 0, 0);
    c.clearRect(0, 0, input.width, input.height);
    c.font = this.font;
    c.textBaseline = "middle";
    c.lineJoin = "round";
    const taken: [number, number, number, number][] = [];
    if (input.hovered !== null && input.hovered !== input.selected) this.ring(c, input, input.hovered);
    if (input.selected !== null) this.marker(c, input, input.selected, taken);
    if (input.labels) this.labels(c, input, taken);
    if (input.grid) this.scale(c, input);
    if (input.caption) {
      const faint = this.dark ? "#a9b4c0" : "#4c5865";
      drawCaption(c, input.caption, input.width, input.height, { text: this.ink(), faint, paper: this.paper(0.82), family: FAMILY, size: this.size });
    }
  }

  /** As large as the page's own text is. */
  private setFont(): void {
    const page = parseFloat(getComputedStyle(document.documentElement).fontSize) || PAGE_TEXT_PX;
    if (page === this.page_px) return;
    this.page_px = page;
    this.size = Math.max(1, page / PAGE_TEXT_PX);
    this.font = `${Math.round(12 * this.size)}px ${FAMILY}`;
    this.widths.clear();
  }

  private top(): number {
    return TOP_PX + NOTICE_PX * this.size;
  }

  private ink(): string {
    return this.dark ? "#f2f5f9" : "#10161d";
  }

  private paper(opacity: number): string {
    return this.dark ? `rgb(8 12 18 / ${opacity})` : `rgb(255 255 255 / ${opacity})`;
  }

  private text(c: CanvasRenderingContext2D, text: string, x: number, y: number): void {
    c.strokeStyle = this.paper(0.85);
    c.lineWidth = 3.5;
    c.strokeText(text, x, y);
    c.fillStyle = this.ink();
    c.fillText(text, x, y);
  }

  private wide(c: CanvasRenderingContext2D, text: string): number {
    let w = this.widths.get(text);
    if (w === undefined) {
      if (this.widths.size > 20_000) this.widths.clear();
      this.widths.set(text, (w = c.measureText(text).width));
    }
    return w;
  }

  /** Around what is pointed at. */
  private ring(c: CanvasRenderingContext2D, input: OverlayInput, i: number): void {
    if (!input.frames.read(i, this.spot)) return;
    const at = project(input.view, this.spot, input.width, input.height);
    if (!at) return;
    const r = Math.max(10, Math.min(input.radius_px(i, depthOf(input.view, this.spot)) * 1.2 + 4, 160));
    for (const [width, colour] of [[4, this.paper(0.7)], [1.5, this.ink()]] as const) {
      c.lineWidth = width;
      c.strokeStyle = colour;
      c.beginPath();
      c.arc(at.x, at.y, r, 0, 2 * Math.PI);
      c.stroke();
    }
  }

  private marker(c: CanvasRenderingContext2D, input: OverlayInput, i: number, taken: [number, number, number, number][]): void {
    const p = input.frames.place(i);
    const at = p && project(input.view, p, input.width, input.height);
    if (!p || !at) return;
    const w = depthOf(input.view, p);
    const r = Math.max(12, Math.min(input.radius_px(i, w) * 1.3 + 5, 160));
    for (const [width, colour] of [[5, this.paper(0.75)], [2.2, this.dark ? "#ffd54a" : "#d6006c"]] as const) {
      c.lineWidth = width;
      c.strokeStyle = colour;
      c.beginPath();
      c.arc(at.x, at.y, r, 0, 2 * Math.PI);
      c.stroke();
    }
    const name = input.names[i] ?? "";
    const y = at.y - r - 11 * this.size;
    const half = this.wide(c, name) / 2;
    c.font = `600 ${this.font}`;
    c.textAlign = "center";
    this.text(c, name, at.x, y);
    c.font = this.font;
    c.textAlign = "left";
    taken.push([at.x - half - 6, y - 10 * this.size, at.x + half + 6, y + 10 * this.size]);
    const foot = project(input.view, [p[0], p[1], 0], input.width, input.height);
    if (foot && p[2] > 0 && Math.hypot(foot.x - at.x, foot.y - at.y) > 46) {
      const text = metres(p[2]);
      const [x, ty] = [(at.x + foot.x) / 2 + 6, (at.y + foot.y) / 2];
      this.text(c, text, x, ty);
      taken.push([x, ty - 9, x + this.wide(c, text), ty + 9]);
    }
  }

  private labels(c: CanvasRenderingContext2D, input: OverlayInput, taken: [number, number, number, number][]): void {
    const { frames, width, height, view } = input;
    const seen: { i: number; x: number; y: number; w: number }[] = [];
    const p = this.spot;
    for (let i = 0; i < frames.count; i++) {
      if (i === input.selected || !frames.read(i, p)) continue;
      const at = project(view, p, width, height);
      if (!at || at.x < 0 || at.y < 0 || at.x > width || at.y > height) continue;
      seen.push({ i, x: at.x, y: at.y, w: depthOf(view, p) });
    }
    // Nearest first; where all are as near (a flat view) by number, so that labels do not flicker.
    seen.sort((a, b) => (Math.abs(a.w - b.w) > 1e-9 ? a.w - b.w : a.i - b.i));
    let drawn = 0;
    for (const { i, x, y, w } of seen) {
      if (drawn >= MOST_LABELS) break;
      const name = input.names[i] ?? "";
      const left = x + Math.max(6, input.radius_px(i, w)) + 4;
      const box: [number, number, number, number] = [left - 2, y - 8 * this.size, left + this.wide(c, name) + 2, y + 8 * this.size];
      if (taken.some((t) => box[0] < t[2] && box[2] > t[0] && box[1] < t[3] && box[3] > t[1])) continue;
      taken.push(box);
      this.text(c, name, left, y);
      drawn++;
    }
  }

  /** A bar of round length, true at the point looked at. */
  private scale(c: CanvasRenderingContext2D, input: OverlayInput): void {
    const length = niceBelow(input.pixel_m * 130);
    const px = length / input.pixel_m;
    const [x, y] = [input.width / 2 - 78, this.top() + 12 * this.size];
    for (const [width, colour] of [[4.5, this.paper(0.8)], [2, this.ink()]] as const) {
      c.strokeStyle = colour;
      c.lineWidth = width;
      c.beginPath();
      c.moveTo(x, y - 5);
      c.lineTo(x, y);
      c.lineTo(x + px, y);
      c.lineTo(x + px, y - 5);
      c.stroke();
    }
    this.text(c, metres(length), x + 5, y - 11 * this.size);
    this.compass(c, input);
  }

  /** East, north and up as they are seen. */
  private compass(c: CanvasRenderingContext2D, input: OverlayInput): void {
    const [x, y, l] = [input.width / 2 + 104, this.top() + 6, 22];
    const m = input.view;
    // The rows of the view give the directions on the screen; x and y are stretched by the lens.
    const ax = Math.hypot(m[0]!, m[4]!, m[8]!);
    const ay = Math.hypot(m[1]!, m[5]!, m[9]!);
    const axes = [
      ["E", "#e5484d", 0],
      ["N", "#2fa84f", 4],
      ["up", this.dark ? "#74a9ff" : "#2463d6", 8],
    ] as const;
    c.textAlign = "center";
    for (const [name, colour, k] of axes) {
      const [dx, dy] = [(m[k]! / ax) * l, (-m[k + 1]! / ay) * l];
      if (Math.hypot(dx, dy) < 4) continue;
      for (const [width, stroke] of [[5, this.paper(0.7)], [2.5, colour]] as const) {
        c.strokeStyle = stroke;
        c.lineWidth = width;
        c.beginPath();
        c.moveTo(x, y);
        c.lineTo(x + dx, y + dy);
        c.stroke();
      }
      const far = (l + 10 * this.size) / l;
      this.text(c, name, x + dx * far, y + dy * far);
    }
    c.textAlign = "left";
  }
}

function depthOf(m: ArrayLike<number>, p: ArrayLike<number>): number {
  return m[3]! * p[0]! + m[7]! * p[1]! + m[11]! * p[2]! + m[15]!;
}

/** A length for people: three digits, in mm, cm, m or km. */
export function metres(x: number): string {
  const a = Math.abs(x);
  const neat = (v: number): string => String(Number(v.toPrecision(3)));
  if (a >= 1000) return `${neat(x / 1000)} km`;
  if (a >= 1) return `${neat(x)} m`;
  if (a >= 0.01) return `${neat(x * 100)} cm`;
  return `${neat(x * 1000)} mm`;
}
