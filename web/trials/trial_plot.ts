// A plot of trials, dots or distributions: from a mark to its trial, and a brush that chooses trials in all figures.

import type { Series } from "../curves/series";
import type { Plot } from "../curves/plot";
import type { Range } from "../curves/axis";
import type { Picking } from "../curves/pointer";
import type { Card } from "./card";
import { DotLayer } from "./dots";
import type { Selection, Trial } from "./selection";
import type { Trials, Variant } from "./trials";

const NEAR = 24; // px, from which on a mark is under the pointer
const RUG = 6; // px, of the ticks of chosen trials below a distribution

interface Distribution {
  series: Series;
  variant: Variant;
  x: Float64Array;
}

export class TrialPlot implements Picking {
  private readonly layers: DotLayer[];
  private readonly distributions: Distribution[];
  private order: Trial[] | null = null; // of the marks from left to right, for keys
  private current = -1;

  private constructor(
    private readonly plot: Plot,
    trials: Trials,
    private readonly selection: Selection,
    private readonly card: Card,
  ) {
    this.layers = DotLayer.layers(plot.chart.dots ?? [], trials);
    this.distributions = plot.series.flatMap((series) => {
      const variant = series.curve.metric ? trials.variant(series.curve.name ?? "") : undefined;
      return variant ? [{ series, variant, x: variant.displayed(series.curve.metric!) }] : [];
    });
    plot.layers.push((context, to, ratio) => {
      for (const layer of this.layers) layer.draw(context, to, ratio, selection);
      this.drawRug(context, to.x, plot.positions.to.y(0, true), ratio);
    });
    selection.follow(() => plot.redraw());
  }

  // Null where a plot has no trials.
  static of(plot: Plot, trials: Trials | null, selection: Selection, card: Card): TrialPlot | null {
    const made = trials && new TrialPlot(plot, trials, selection, card);
    return made && (made.layers.length || made.distributions.length) ? made : null;
  }

  hover(event: PointerEvent | null, place: { x: number; y: number }): void {
    this.card.hover(event && this.trialAt(place), event ?? { clientX: 0, clientY: 0 });
  }

  pick(place: { x: number; y: number }): void {
    const trial = this.trialAt(place);
    if (trial) this.card.pin(trial);
    else this.selection.choose(null);
  }

  brush(x: Range, y: Range): void {
    const marked = this.layers.flatMap((layer) => layer.within(x, y));
    const between = this.distributions.flatMap(({ variant, x: numbers }) =>
      [...numbers.keys()].filter((row) => numbers[row]! >= x[0] && numbers[row]! <= x[1]).map((row) => ({ variant, row })),
    );
    this.selection.choose([...marked, ...between]);
  }

  // Keys step from mark to mark, Enter pins, Escape ends a selection.
  press(key: string): boolean {
    if (key === "Escape" && !this.selection.isWhole) this.selection.choose(null);
    else if (key === "Enter" && this.current >= 0) this.card.pin(this.marks()[this.current]!);
    else if ((key === "ArrowLeft" || key === "ArrowRight") && this.marks().length) this.step(key === "ArrowLeft" ? -1 : 1);
    else return false;
    return true;
  }

  private step(by: number): void {
    const marks = this.marks();
    this.current = Math.min(Math.max(this.current + by, 0), marks.length - 1);
    const trial = marks[this.current]!;
    const { to, left, top } = this.plot.positions;
    const layer = this.layers.find((each) => each.variant === trial.variant)!;
    const bounds = this.plot.root.querySelector(".u-over")!.getBoundingClientRect();
    this.card.hover(trial, {
      clientX: bounds.left + (to.x(layer.x[trial.row]!) - left) / devicePixelRatio,
      clientY: bounds.top + (to.y(layer.y[trial.row]!) - top) / devicePixelRatio,
    });
  }

  private marks(): Trial[] {
    this.order ??= this.layers
      .flatMap((layer) => layer.within([-Infinity, Infinity], [-Infinity, Infinity]).map((trial) => ({ trial, x: layer.x[trial.row]! })))
      .sort((one, other) => one.x - other.x)
      .map(({ trial }) => trial);
    return this.order;
  }

  private trialAt({ x, y }: { x: number; y: number }): Trial | null {
    const { to, left, top } = this.plot.positions;
    const at = [left + x * devicePixelRatio, top + y * devicePixelRatio] as const;
    const nearest = this.layers
      .flatMap((layer) => layer.nearest(at[0], at[1], to) ?? [])
      .sort((one, other) => one.distance - other.distance)[0];
    if (nearest) return nearest.distance <= (NEAR * devicePixelRatio) ** 2 ? nearest.trial : null;
    return this.trialOfDistribution(this.plot.valueAt(x), at[1], to.y);
  }

  // Of the line nearest above or below a point the trial whose metric is nearest.
  private trialOfDistribution(x: number, y: number, toY: (value: number) => number): Trial | null {
    let [best, trial] = [NEAR * devicePixelRatio, null as Trial | null];
    for (const { series, variant, x: numbers } of this.distributions) {
      if (series.hidden) continue;
      const distance = Math.abs(toY(series.y(series.rowAt(x))) - y);
      if (distance > best) continue;
      let row = -1;
      for (let each = 0; each < numbers.length; each++) {
        if (row < 0 || Math.abs(numbers[each]! - x) < Math.abs(numbers[row]! - x)) row = each;
      }
      [best, trial] = [distance, row < 0 ? trial : { variant, row }];
    }
    return trial;
  }

  private drawRug(context: CanvasRenderingContext2D, toX: (value: number) => number, bottom: number, ratio: number): void {
    context.setLineDash([]);
    context.lineWidth = ratio;
    for (const { series, variant, x } of this.distributions) {
      context.strokeStyle = series.curve.colour;
      context.beginPath();
      for (const row of this.selection.rows(variant)) {
        context.moveTo(toX(x[row]!), bottom);
        context.lineTo(toX(x[row]!), bottom - RUG * ratio);
      }
      context.stroke();
    }
  }
}
