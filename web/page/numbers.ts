// Numbers as the tables of a page show them: analysis/documents/common/quantities.py, `number`.

export const DIGITS = 6;
const PLAIN_DIGITS = 6; // before the point; larger numbers have an exponent
const MINUS = "\u2212";

export function format(value: number, digits = DIGITS): string {
  if (Number.isNaN(value)) return "not a number";
  if (!Number.isFinite(value)) return value > 0 ? "\u221e" : `${MINUS}\u221e`;
  if (value === 0) return "0";
  const [mantissa, power] = round(Math.abs(value), digits);
  const sign = value < 0 ? MINUS : "";
  if (power < -4 || (power >= digits && power >= PLAIN_DIGITS)) return `${sign}${trim(point(mantissa, 1))}e${power}`;
  if (power >= digits) return sign + mantissa.padEnd(power + 1, "0");
  if (power >= 0) return sign + trim(point(mantissa, power + 1));
  return sign + trim(`0.${"0".repeat(-power - 1)}${mantissa}`);
}

// The significant digits and the power of ten of the first; halves go to the even digit, as in Python.
function round(size: number, digits: number): [string, number] {
  const [exact = "", exponent = "0"] = size.toExponential(60).split("e");
  const all = exact.replace(".", "");
  let head = BigInt(all.slice(0, digits));
  const rest = all.slice(digits);
  const half = "5".padEnd(rest.length, "0");
  if (rest > half || (rest === half && head % 2n === 1n)) head += 1n;
  const text = head.toString();
  return text.length > digits ? [text.slice(0, digits), Number(exponent) + 1] : [text, Number(exponent)];
}

function point(digits: string, before: number): string {
  return digits.length > before ? `${digits.slice(0, before)}.${digits.slice(before)}` : digits;
}

function trim(text: string): string {
  return text.includes(".") ? text.replace(/\.?0+$/, "") : text;
}
