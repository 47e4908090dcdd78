// The text of a plot's lines: at the cursor, from the second cursor to it, over the visible range.

import { format } from "../page/numbers";
import type { Plot } from "./plot";
import type { Series } from "../chart/series";

// A text and a colour for each line.
export function describePlot(plot: Plot, at: number): [text: string, colour: string][] {
  const shown = plot.series.filter((each) => plot.isShown(each));
  return shown.flatMap((each) => {
    const row = each.rowWithin(at);
    if (row === null) return [];
    const { name = "", unit = "", colour } = each.curve;
    const value = plot.isPath ? `(${each.at(row)})` : withUnit(each.text(row), unit);
    const label = shown.length > 1 ? (/(?:^\w+ )?\[[\d,]+\]$/.exec(name)?.[0] ?? name) : "";
    const texts = [label ? `${label} ${value}` : value, ...describeDifference(plot, each, row), ...describeRange(plot, each)];
    return [[texts.join(", "), colour]];
  });
}

// From the second cursor to a row: difference and slope.
function describeDifference(plot: Plot, series: Series, row: number): string[] {
  const mark = plot.time.mark;
  const from = mark === null || !isQuantity(plot, series) ? null : series.rowWithin(mark);
  if (from === null) return [];
  const rise = series.y(row) - series.y(from);
  const run = series.x[row]! - series.x[from]!;
  const { unit = "" } = series.curve;
  const difference = `\u0394 ${withUnit(format(rise), unit)}`;
  if (run === 0 || plot.axis.logarithmic) return [difference];
  const along = plot.axis.quantity.unit;
  return [difference, `slope ${withUnit(format(rise / run), along ? `${unit} per ${along}`.trim() : unit)}`];
}

function describeRange(plot: Plot, series: Series): string[] {
  if (!plot.time.hasStatistics || !isQuantity(plot, series)) return [];
  const statistics = series.statistics(plot.axis.zoom ?? plot.chart.x.ends);
  if (!statistics) return [];
  const { least, greatest, rms } = statistics;
  return [`least ${format(least)}`, `greatest ${format(greatest)}`, `rms ${format(rms)}`];
}

// False for an envelope, which has no rows, for a path and for names.
function isQuantity(plot: Plot, series: Series): boolean {
  return !plot.isPath && !series.curve.reduced && !plot.chart.y.named;
}

function withUnit(text: string, unit: string): string {
  return unit ? `${text} ${unit}` : text;
}
