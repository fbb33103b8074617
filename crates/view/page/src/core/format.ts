// Numbers, times and names as people read them.

const minus = "\u2212";

/** A number with about `digits` significant digits: `12.3`, `0.0041`, `1.23 M`, `2.5×10⁻⁷`. */
export function number(value: number | null | undefined, digits = 3): string {
  if (value === null || value === undefined || !Number.isFinite(value)) return "–";
  const size = Math.abs(value);
  const sign = value < 0 ? minus : "";
  if (size === 0) return "0";
  if (size >= 1e15 || size < 1e-4) return sign + power(size, digits);
  // What rounds to a thousand of one is one of the next.
  const rounded = Number(size.toPrecision(digits));
  for (const [scale, name] of [[1e12, "T"], [1e9, "G"], [1e6, "M"]] as const) {
    if (rounded >= scale) return `${sign}${figures(size / scale, digits)} ${name}`;
  }
  if (Number.isInteger(size) && size < 1000) return sign + size;
  if (size >= 1000) return sign + count(size);
  return sign + figures(size, digits);
}

function figures(size: number, digits: number): string {
  const decimals = digits - 1 - Math.floor(Math.log10(Number(size.toPrecision(digits))));
  return size.toFixed(Math.min(Math.max(decimals, 0), 6));
}

/** What is too small or too large to be written out. */
function power(size: number, digits: number): string {
  const [head = "", exponent = "0"] = size.toExponential(digits - 1).split("e");
  const raised = [...exponent.replace("+", "")].map((sign) => (sign === "-" ? "⁻" : "⁰¹²³⁴⁵⁶⁷⁸⁹"[Number(sign)])).join("");
  return `${head.replace(/\.?0+$/, "")}×10${raised}`;
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
  const text = unitWords(of);
  return text === "" ? "" : `\u00a0${text}`;
}

/** A unit as people write it: `/s` is "each second". */
export function unitWords(of: string): string {
  return of === "1" ? "" : of.replace(/^1\//, "/");
}

/** Numbers that many runs have, in words. */
const known: { [name: string]: string } = {
  energy: "energy spent",
  "packets/sent": "packets sent",
  "packets/received": "packets received",
  "packets/delivery": "packets delivered",
  "battery/soc": "charge",
};

/** The name of a series in words: `planned/out` is `planned out`, its mean over the vehicles `planned out (mean)`. */
export function words(name: string): string {
  const [, of, over] = /^(.*)\/(sum|mean)$/.exec(name) ?? [null, name, ""];
  const text = known[of!] ?? of!.replaceAll("/", " ").replaceAll("_", " ");
  return over ? `${text} (${over})` : text;
}
