// The ticks of an axis: as drawn where the whole is shown, elsewhere round numbers.

import type uPlot from "uplot";

import { FIGURE } from "../generated/colours";
import type { Axis } from "../generated/charts";
import { format } from "../page/numbers";
import { linearSplits, logarithmicSplits } from "./splits";

export const { ink: INK, faint: FAINT, grid: GRID } = FIGURE;
const SUPERSCRIPTS = "\u2070\u00b9\u00b2\u00b3\u2074\u2075\u2076\u2077\u2078\u2079";
const [FEW, MANY] = [6, 15]; // digits of a number

// uPlot reads whole px alone.
export function fontOf(size: number, weight = "normal"): string {
  return `${weight} ${Math.round(size)}px "DejaVu Sans", Verdana, sans-serif`;
}

// ``space``: px at least from one tick to the next; ``isNarrow``: of its ticks it has few; ``isWhole``: true while the
// axis shows what was drawn.
export function axisOptions(axis: Axis, size: number, space: number, point: number, isNarrow: boolean, isWhole: () => boolean): uPlot.Axis {
  const drawn = new Map(isNarrow ? axis.few!.map((index) => axis.ticks![index]!) : axis.ticks);
  const isFixed = () => axis.named || (axis.ticks !== undefined && isWhole());
  const splits = (plot: uPlot, index: number, low: number, high: number): number[] => {
    if (isFixed()) return [...drawn.keys()].filter((at) => isWhole() || (at >= low && at <= high));
    const length = index === 0 ? plot.bbox.width : plot.bbox.height;
    const most = Math.max(2, Math.floor(length / devicePixelRatio / space));
    return axis.logarithmic ? logarithmicSplits(low, high, most) : linearSplits(low, high, most);
  };
  // Of ticks with texts and without, as a logarithmic axis has them, the former alone have lines.
  const lined = (_: uPlot, at: number[]): (number | null)[] => {
    const isPlain = !isFixed() || !at.some((each) => drawn.get(each));
    return isPlain ? at : at.map((each) => (drawn.get(each) ? each : null));
  };
  const values = (_: uPlot, at: number[]): string[] => {
    if (axis.bare) return at.map(() => "");
    if (isFixed()) return at.map((each) => drawn.get(each) ?? "");
    return axis.logarithmic ? labelPowers(at) : labelNumbers(at);
  };
  return {
    size,
    font: fontOf(axis.size * point),
    gap: 3,
    stroke: INK,
    incrs: [Number.MAX_VALUE], // of uPlot's own splits
    splits,
    filter: all, // uPlot's would leave out what is no power of ten
    values,
    grid: { filter: lined, show: axis.grid ?? false, stroke: GRID, width: 0.6 * point },
    ticks: { filter: all, show: axis.marked ?? false, stroke: FAINT, width: 0.8 * point, size: 3.5 * point },
    border: { show: false }, // `drawAbove` strokes them over grids and lines
  };
}

function all(_: uPlot, splits: number[]): number[] {
  return splits;
}

// The width (px) of the widest text at the ticks of an axis as drawn.
export function widthOf(axis: Axis, context: CanvasRenderingContext2D, point: number): number {
  context.font = fontOf(axis.size * point);
  return Math.max(0, ...(axis.ticks ?? []).map(([, text]) => context.measureText(text).width));
}

// Digits enough to tell one tick from the next.
function labelNumbers(ticks: number[]): string[] {
  const step = ticks.length > 1 ? ticks[1]! - ticks[0]! : Infinity;
  const greatest = Math.max(...ticks.map(Math.abs));
  const digits = Math.min(Math.max(Math.ceil(Math.log10(greatest / step)) + 2, FEW), MANY);
  return ticks.map((at) => format(Math.abs(at) < 1e-9 * step ? 0 : at, Number.isFinite(digits) ? digits : FEW));
}

// Plain numbers near 1, powers of ten beyond, as analysis/reports/common/quantities.py, `log_tick`.
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
