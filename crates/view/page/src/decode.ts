// Binary messages: views into the message's own bytes, nothing is copied.

import type { Frame, Values } from "./wire";

export type Decoded = { kind: "frame"; frame: Frame } | { kind: "values"; values: Values };

const HEAD = 16;

/** The message, or `null` if it is none that this page knows or not as long as it says. */
export function decode(bytes: ArrayBuffer): Decoded | null {
  if (bytes.byteLength < HEAD) return null;
  const head = new DataView(bytes);
  const n = head.getUint32(4, true);
  const time = head.getFloat64(8, true);
  switch (head.getUint8(0)) {
    case 1:
      return frame(bytes, head.getUint8(1), n, time);
    case 2:
      if (bytes.byteLength < HEAD + 12 * n) return null;
      return {
        kind: "values",
        values: {
          time,
          values: new Float64Array(bytes, HEAD, n),
          ids: new Uint32Array(bytes, HEAD + 8 * n, n),
        },
      };
    default:
      return null;
  }
}

function frame(bytes: ArrayBuffer, columns: number, n: number, time: number): Decoded | null {
  const moving = (columns & 1) !== 0;
  const coloured = (columns & 2) !== 0;
  const size = HEAD + 12 * n + (moving ? 12 * n : 0) + (coloured ? 4 * n : 0) + 8 * n;
  if (bytes.byteLength < size) return null;
  let at = HEAD;
  const floats = (count: number): Float32Array => {
    const view = new Float32Array(bytes, at, count);
    at += 4 * count;
    return view;
  };
  const positions = floats(3 * n);
  const velocities = moving ? floats(3 * n) : null;
  const values = coloured ? floats(n) : null;
  return {
    kind: "frame",
    frame: { time, n, positions, velocities, values, attitudes: new Int16Array(bytes, at, 4 * n) },
  };
}
