// A line of a chart with its columns: which row is at an abscissa, what it shows there, how far it reaches.

import type { Curve } from "../generated/charts";
import type { Page, Values } from "../page/document";
import { format } from "../page/numbers";
import type { Range } from "./frame";

export class Series {
  hidden = false;
  readonly isPath: boolean; // its abscissa is not ascending, or not what the cursor moves along

  private constructor(
    readonly curve: Curve,
    readonly x: Values,
    readonly values: Values, // in SI; shown times the curve's factor
    readonly time: Values | null,
  ) {
    this.isPath = time !== null || !isAscending(x);
  }

  static async load(curve: Curve, page: Page): Promise<Series> {
    const [x, values, time] = await Promise.all([
      page.column(curve.x),
      page.column(curve.y),
      curve.time === undefined ? null : page.column(curve.time),
    ]);
    return new Series(curve, x, values, time);
  }

  y(row: number): number {
    return this.curve.factor * this.values[row]!;
  }

  // What the cursor moves along: the abscissa, or the time of a path.
  get along(): Values {
    return this.time ?? this.x;
  }

  // The row nearest to the cursor; null beyond the ends of the line.
  rowWithin(at: number): number | null {
    return at < this.along[0]! || at > this.along[this.along.length - 1]! ? null : this.rowAt(at);
  }

  // The row nearest to the cursor; of equally near ones the first.
  rowAt(at: number): number {
    const along = this.along;
    const after = lowerBound(along, at);
    if (after === 0) return 0;
    if (after === along.length) return lowerBound(along, along[along.length - 1]!);
    return at - along[after - 1]! <= along[after]! - at ? lowerBound(along, along[after - 1]!) : after;
  }

  // What the line shows at a row; of an envelope its least and greatest value.
  text(row: number): string {
    if (!this.curve.reduced) return this.shown(row);
    const other = this.shown(row + 1);
    return this.shown(row) === other ? other : `${this.shown(row)} to ${other}`;
  }

  // Abscissa and ordinate of a path's point.
  at(row: number): string {
    return `${format(this.x[row]!)}, ${this.shown(row)}`;
  }

  private shown(row: number): string {
    const value = this.y(row);
    return Number.isNaN(value) ? "\u2013" : format(value);
  }

  // Of the rows within a range of the abscissa; null where none is finite.
  statistics([low, high]: Range): { least: number; greatest: number; rms: number } | null {
    let [least, greatest, squares, count] = [Infinity, -Infinity, 0, 0];
    for (let row = lowerBound(this.x, low); row < this.x.length && this.x[row]! <= high; row++) {
      const value = this.y(row);
      if (!Number.isFinite(value)) continue;
      least = Math.min(least, value);
      greatest = Math.max(greatest, value);
      squares += value * value;
      count += 1;
    }
    return count ? { least, greatest, rms: Math.sqrt(squares / count) } : null;
  }

  // Least and greatest value within a range of the abscissa, and of the rows next to it; null where none is finite.
  reach([low, high]: Range): Range | null {
    let least = Infinity;
    let greatest = -Infinity;
    const end = Math.min(lowerBound(this.x, high) + 1, this.x.length);
    for (let row = Math.max(lowerBound(this.x, low) - 1, 0); row < end; row++) {
      const value = this.y(row);
      if (value < least) least = value;
      if (value > greatest) greatest = value;
    }
    return least <= greatest ? [least, greatest] : null;
  }
}

function isAscending(x: Values): boolean {
  for (let row = 1; row < x.length; row++) if (x[row]! < x[row - 1]!) return false;
  return true;
}

// The first index whose value is not below ``at``, in ascending values.
export function lowerBound(values: Values, at: number): number {
  let low = 0;
  let high = values.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (values[middle]! < at) low = middle + 1;
    else high = middle;
  }
  return low;
}
