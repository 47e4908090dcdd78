// Marks of trials on a plot, and which of them is near a point.

import type { Dots } from "../generated/charts";
import type { Frame, Range } from "../chart/frame";
import type { Trial } from "./selection";
import type { Trials, Variant } from "./trials";

export class DotLayer {
  readonly x: Float64Array;
  readonly y: Float64Array;
  readonly rows: number[]; // of its outcome, with finite numbers

  private constructor(
    private readonly dots: Dots,
    readonly variant: Variant,
  ) {
    this.x = variant.displayed(dots.names[0]);
    this.y = variant.displayed(dots.names[1]);
    this.rows = [];
    variant.success.forEach((success, row) => {
      if ((success === 1) === !!dots.success && Number.isFinite(this.x[row]) && Number.isFinite(this.y[row])) this.rows.push(row);
    });
  }

  static layers(all: Dots[], trials: Trials | null): DotLayer[] {
    return all.flatMap((dots) => {
      const variant = trials?.variant(dots.variant);
      return variant ? [new DotLayer(dots, variant)] : [];
    });
  }

  // Draws the trials of which ``has`` is true. ``point``: px of a pt of the figure.
  draw(context: CanvasRenderingContext2D | OffscreenCanvasRenderingContext2D, frame: Frame, point: number, has: (variant: Variant, row: number) => boolean): void {
    const radius = (this.dots.size / 2) * point;
    context.fillStyle = context.strokeStyle = this.dots.colour;
    context.lineWidth = Math.max(1 / devicePixelRatio, 0.29 * this.dots.size * point);
    context.beginPath();
    for (const row of this.rows) {
      if (!has(this.variant, row)) continue;
      const [x, y] = [frame.x.place(this.x[row]!), frame.y.place(this.y[row]!)];
      if (this.dots.cross) {
        context.moveTo(x - radius, y - radius);
        context.lineTo(x + radius, y + radius);
        context.moveTo(x - radius, y + radius);
        context.lineTo(x + radius, y - radius);
      } else context.fillRect(x - 0.89 * radius, y - 0.89 * radius, 1.78 * radius, 1.78 * radius);
    }
    context.stroke();
  }

  // The trial whose mark is nearest to a place in the area, with its squared distance (px).
  nearest(x: number, y: number, frame: Frame): { trial: Trial; distance: number } | null {
    let [best, found] = [Infinity, -1];
    for (const row of this.rows) {
      const distance = (frame.x.place(this.x[row]!) - x) ** 2 + (frame.y.place(this.y[row]!) - y) ** 2;
      if (distance < best) [best, found] = [distance, row];
    }
    return found < 0 ? null : { trial: { variant: this.variant, row: found }, distance: best };
  }

  within(x: Range, y: Range): number[] {
    return this.rows.filter((row) => this.x[row]! >= x[0] && this.x[row]! <= x[1] && this.y[row]! >= y[0] && this.y[row]! <= y[1]);
  }
}
