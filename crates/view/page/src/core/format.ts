// Numbers, times and names as people read them.

const minus = "\u2212";

/** A number with about `digits` significant digits: `12.3`, `0.0041`, `1.2 M`. */
export function number(value: number | null | undefined, digits = 3): string {
  if (value === null || value === undefined || !Number.isFinite(value)) return "–";
  const size = Math.abs(value);
  const sign = value < 0 ? minus : "";
  if (size === 0) return "0";
  if (size >= 1e15 || size < 1e-4) return sign + size.toExponential(digits - 1).replace("-", minus);
  for (const [scale, name] of [[1e12, "T"], [1e9, "G"], [1e6, "M"]] as const) {
    if (size >= scale) return `${sign}${(size / scale).toPrecision(digits)} ${name}`;
  }
  if (Number.isInteger(size) && size < 1000) return sign + size;
  if (size >= 1000) return sign + Math.round(size).toLocaleString("en").replaceAll(",", "\u202f");
  const decimals = Math.max(0, digits - 1 - Math.floor(Math.log10(size)));
  return sign + size.toFixed(Math.min(decimals, 6));
}

/** With this many decimals, always: columns of figures stay where they are. */
export function fixed(value: number | null | undefined, decimals: number): string {
  if (value === null || value === undefined || !Number.isFinite(value)) return "–";
  const text = Math.abs(value).toFixed(decimals);
  return value < 0 && Number(text) !== 0 ? minus + text : text;
}

export function count(value: number | null): string {
  if (value === null) return "–";
  return Math.round(value).toLocaleString("en").replaceAll(",", "\u202f");
}

/** A virtual time: `4.25 s`, `2:03.50`, `1:02:03.5`. */
export function time(t_s: number, decimals = 2): string {
  if (!Number.isFinite(t_s)) return "–";
  const scale = 10 ** decimals;
  // Whole parts of a second, so that 59.999 does not become 60.00 s.
  const parts = Math.floor(Math.abs(t_s) * scale + 1e-6);
  const seconds = Math.floor(parts / scale);
  const rest = decimals ? `.${String(parts % scale).padStart(decimals, "0")}` : "";
  const sign = t_s < 0 && parts > 0 ? minus : "";
  if (seconds < 60) return `${sign}${seconds}${rest} s`;
  const two = (n: number) => String(n).padStart(2, "0");
  const minutes = Math.floor(seconds / 60);
  if (minutes < 60) return `${sign}${minutes}:${two(seconds % 60)}${rest}`;
  return `${sign}${Math.floor(minutes / 60)}:${two(minutes % 60)}:${two(seconds % 60)}${rest}`;
}

/** `2 ×`, `0.25 ×`. */
export function factor(value: number): string {
  return `${number(value, value >= 10 ? 2 : 3).replace(/(\.\d*?)0+$/, "$1").replace(/\.$/, "")} ×`;
}

/** A unit behind a number; the unit of plain numbers is not said. */
export function unit(of: string): string {
  return of === "" || of === "1" ? "" : `\u00a0${of}`;
}

/** The name of a series in words: `packets/sent` is `packets sent`. */
export function words(name: string): string {
  return name.replaceAll("/", " ").replaceAll("_", " ");
}
