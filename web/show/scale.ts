// The scale of a column: analysis/show/scale.py.

import type { ScaleDocument } from "../generated/documents";

const INTERVALS = 4; // between ticks, about

export class Scale {
  private readonly ends: [number, number];

  constructor(private readonly data: ScaleDocument) {
    this.ends = [this.bend(data.low), this.bend(data.high)];
  }

  // The fraction of the scale at which a number is.
  fraction(value: number): number {
    return (this.bend(value) - this.ends[0]) / (this.ends[1] - this.ends[0]);
  }

  // The number at a fraction of the scale.
  at(fraction: number): number {
    const bent = this.ends[0] + fraction * (this.ends[1] - this.ends[0]);
    return this.data.knee ? this.data.knee * Math.sinh(bent) : bent;
  }

  // Significant digits that tell a number at a fraction from its neighbours, of so many steps of the scale.
  digits(fraction: number, steps: number): number {
    const [value, next] = [this.at(fraction), this.at(fraction + (fraction < 0.5 ? 1 : -1) / steps)];
    const ratio = Math.max(Math.abs(value), Math.abs(next)) / Math.abs(next - value);
    return Math.min(Math.max(4, 1 + Math.ceil(Math.log10(ratio))), 17);
  }

  // Numbers that are round once they are multiplied by a factor.
  ticks(factor: number): number[] {
    const [low, high] = [this.data.low * factor, this.data.high * factor];
    const displayed = this.data.knee ? powers(low, high, this.data.knee * factor) : multiples(low, high);
    return displayed.map((tick) => tick / factor);
  }

  private bend(value: number): number {
    return this.data.knee ? Math.asinh(value / this.data.knee) : value;
  }
}

function multiples(low: number, high: number): number[] {
  const span = high - low;
  const power = 10 ** Math.floor(Math.log10(span / INTERVALS));
  const step = [1, 2, 2.5, 5, 10].map((each) => each * power).find((each) => span / each <= INTERVALS + 1)!;
  const ticks: number[] = [];
  for (let count = Math.ceil(low / step); count * step <= high && ticks.length < 20; count++) ticks.push(Number((count * step).toPrecision(12)));
  return ticks;
}

function powers(low: number, high: number, knee: number): number[] {
  const top = Math.floor(Math.log10(Math.max(Math.abs(low), Math.abs(high))));
  const bottom = Math.ceil(Math.log10(knee));
  const step = Math.max(1, Math.ceil((top - bottom) / (low < 0 && high > 0 ? 2 : INTERVALS)));
  const ticks = [0];
  for (let power = top; power >= bottom; power -= step) ticks.push(10 ** power, -(10 ** power));
  return ticks.filter((tick) => tick >= low && tick <= high).sort((one, other) => one - other);
}
