// What a saved picture says of itself, in its lower left corner: the run and its time, what the colours mean, and
// the scales of what else is drawn.

/** A kind with its colour; a scale from low to high; or words alone. */
export type CaptionRow =
  | { dot: string; text: string; end: string }
  | { ramp: string[]; low: string; of: string; high: string }
  | { text: string };

export interface Caption {
  /** The run, its seed, the time. */
  title: string;
  rows: CaptionRow[];
}

/** Of a picture with words of 12 pixels; with large text all grows. */
const MARGIN_PX = 14;
const PADDING_PX = 9;
const ROW_PX = 18;
const DOT_PX = 5;
const RAMP_PX = 170;
const GAP_PX = 6;

export interface Ink {
  text: string;
  faint: string;
  paper: string;
  family: string;
  /** How much larger than usual words are. */
  size: number;
}

/** Draws it into a context whose pixels are those of CSS. It gets smaller where the picture is too small for it. */
export function drawCaption(c: CanvasRenderingContext2D, caption: Caption, width: number, height: number, ink: Ink): void {
  const font = `12px ${ink.family}`;
  const bold = `600 12px ${ink.family}`;
  c.save();
  c.textBaseline = "middle";
  const wide = (text: string, of = font) => {
    c.font = of;
    return c.measureText(text).width;
  };
  const widths = caption.rows.map((row) => {
    if ("dot" in row) return 2 * DOT_PX + GAP_PX + wide(row.text) + 3 * GAP_PX + wide(row.end);
    if ("ramp" in row) return Math.max(RAMP_PX, wide(row.low) + wide(row.of) + wide(row.high) + 4 * GAP_PX);
    return wide(row.text);
  });
  const inner = Math.max(wide(caption.title, bold), ...widths);
  const rows = caption.rows.reduce((sum, row) => sum + ("ramp" in row ? 1.7 : 1), 1.15);
  const [w, h] = [inner + 2 * PADDING_PX, rows * ROW_PX + 2 * PADDING_PX];
  const scale = Math.min(ink.size, (width - 2 * MARGIN_PX) / w, (height - 2 * MARGIN_PX) / h);
  if (!(scale > 0)) return;
  c.translate(MARGIN_PX, height - MARGIN_PX - h * scale);
  c.scale(scale, scale);
  c.fillStyle = ink.paper;
  c.beginPath();
  c.roundRect(0, 0, w, h, 5);
  c.fill();
  const [left, right] = [PADDING_PX, PADDING_PX + inner];
  let y = PADDING_PX + ROW_PX / 2;
  const put = (text: string, x: number, align: CanvasTextAlign, colour: string, of = font) => {
    c.font = of;
    c.textAlign = align;
    c.fillStyle = colour;
    c.fillText(text, x, y);
  };
  put(caption.title, left, "left", ink.text, bold);
  y += 1.15 * ROW_PX;
  for (const row of caption.rows) {
    if ("dot" in row) {
      c.fillStyle = row.dot;
      c.strokeStyle = ink.faint;
      c.lineWidth = 0.75;
      c.beginPath();
      c.arc(left + DOT_PX, y, DOT_PX, 0, 2 * Math.PI);
      c.fill();
      c.stroke();
      put(row.text, left + 2 * DOT_PX + GAP_PX, "left", ink.text);
      put(row.end, right, "right", ink.faint);
    } else if ("ramp" in row) {
      const ramp = c.createLinearGradient(left, 0, right, 0);
      row.ramp.forEach((colour, at) => ramp.addColorStop(at / Math.max(row.ramp.length - 1, 1), colour));
      c.fillStyle = ramp;
      c.fillRect(left, y - 4, inner, 8);
      y += 0.7 * ROW_PX;
      put(row.low, left, "left", ink.text);
      put(row.of, (left + wide(row.low) + right - wide(row.high)) / 2, "center", ink.faint);
      put(row.high, right, "right", ink.text);
    } else put(row.text, left, "left", ink.text);
    y += ROW_PX;
  }
  c.restore();
}
