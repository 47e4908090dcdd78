// The ticks of an axis: as drawn where the whole is shown, elsewhere round numbers.

import type { Axis } from "../generated/charts";
import { format } from "../page/numbers";
import type { Range } from "./frame";
import { linearSplits, logarithmicSplits } from "./splits";

const SUPERSCRIPTS = "\u2070\u00b9\u00b2\u00b3\u2074\u2075\u2076\u2077\u2078\u2079";
const [FEW, MANY] = [6, 15]; // digits of a number

export interface Tick {
  at: number;
  text: string;
  hasLine: boolean; // where the axis has a grid
}

// ``most``: how many there may be, about; ``isNarrow``: of those as drawn it has few; ``isWhole``: true while the axis
// shows what was drawn.
export function ticksOf(axis: Axis, ends: Range, most: number, isNarrow: boolean, isWhole: boolean): Tick[] {
  const [low, high] = [Math.min(...ends), Math.max(...ends)];
  if (axis.named || (axis.ticks && isWhole)) {
    const drawn = isNarrow ? axis.few!.map((index) => axis.ticks![index]!) : (axis.ticks ?? []);
    const shown = drawn.filter(([at]) => isWhole || (at >= low && at <= high));
    // Of ticks with texts and without, as a logarithmic axis has them, the former alone have lines.
    const isPlain = !shown.some(([, text]) => text);
    return shown.map(([at, text]) => ({ at, text: axis.bare ? "" : text, hasLine: isPlain || text !== "" }));
  }
  const splits = (axis.logarithmic ? logarithmicSplits : linearSplits)(low, high, Math.max(2, Math.floor(most)));
  const texts = (axis.logarithmic ? labelPowers : labelNumbers)(splits);
  return splits.map((at, index) => ({ at, text: axis.bare ? "" : texts[index]!, hasLine: true }));
}

// Digits enough to tell one tick from the next.
function labelNumbers(ticks: number[]): string[] {
  const step = ticks.length > 1 ? ticks[1]! - ticks[0]! : Infinity;
  const greatest = Math.max(...ticks.map(Math.abs));
  const digits = Math.min(Math.max(Math.ceil(Math.log10(greatest / step)) + 2, FEW), MANY);
  return ticks.map((at) => format(Math.abs(at) < 1e-9 * step ? 0 : at, Number.isFinite(digits) ? digits : FEW));
}

// Plain numbers near 1, powers of ten beyond, as analysis/documents/common/quantities.py, `log_tick`.
function labelPowers(ticks: number[]): string[] {
  const isRound = ticks.every((at) => Math.abs(leading(at) - Math.round(leading(at))) < 1e-6);
  if (!isRound) return labelNumbers(ticks);
  return ticks.map((at) => {
    if (at >= 0.99e-2 && at < 0.99e4) return format(at, FEW);
    const digits = [...String(powerOf(at))].map((digit) => (digit === "-" ? "\u207b" : SUPERSCRIPTS[Number(digit)])).join("");
    const factor = Math.round(leading(at));
    return factor === 1 ? `10${digits}` : `${factor}\u00b710${digits}`;
  });
}

function powerOf(at: number): number {
  return Math.floor(Math.log10(at) + 1e-9);
}

function leading(at: number): number {
  return at / 10 ** powerOf(at);
}
