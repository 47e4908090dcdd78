// The rectangle of a chart's axes, with 0 at its left upper corner, and where values lie in it: px of the page.

import type { Axis } from "../generated/charts";

export type Range = [number, number];

// Values along an axis, the first of its ends at ``begin``, the second one ``length`` from there.
export class Scale {
  private readonly low: number; // of logarithms where it is logarithmic
  private readonly slope: number;

  constructor(
    private readonly logarithmic: boolean,
    readonly ends: Range,
    private readonly begin: number,
    private readonly length: number,
  ) {
    this.low = this.bend(ends[0]);
    this.slope = length / (this.bend(ends[1]) - this.low);
  }

  place(value: number): number {
    return this.begin + (this.bend(value) - this.low) * this.slope;
  }

  placeOf(fraction: number): number {
    return this.begin + fraction * this.length;
  }

  value(place: number): number {
    const bent = this.low + (place - this.begin) / this.slope;
    return this.logarithmic ? 10 ** bent : bent;
  }

  private bend(value: number): number {
    return this.logarithmic ? Math.log10(value) : value;
  }
}

export class Frame {
  readonly x: Scale;
  readonly y: Scale;

  constructor(readonly width: number, readonly height: number, axes: { x: Axis; y: Axis }, ends: { x: Range; y: Range }) {
    this.x = new Scale(!!axes.x.logarithmic, ends.x, 0, width);
    this.y = new Scale(!!axes.y.logarithmic, ends.y, height, -height);
  }

  // The place of an abscissa, of the data or as a fraction of the axes.
  across(value: number, ofAxes = false): number {
    return ofAxes ? this.x.placeOf(value) : this.x.place(value);
  }

  // The place of an ordinate, of the data or as a fraction of the axes.
  down(value: number, ofAxes = false): number {
    return ofAxes ? this.y.placeOf(value) : this.y.place(value);
  }

  // True if a place is within, or `slack` outside.
  has(x: number, y: number, slack = 0): boolean {
    return x >= -slack && x <= this.width + slack && y >= -slack && y <= this.height + slack;
  }
}
