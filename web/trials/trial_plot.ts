// A plot of trials, dots or distributions: from a mark to its trial, and a brush that chooses trials in all figures.

import type { Series } from "../chart/series";
import type { Plot } from "../curves/plot";
import type { Frame, Range } from "../chart/frame";
import { SHADES } from "../generated/colours";
import type { Picking } from "../curves/pointer";
import type { Card } from "./card";
import { DotLayer } from "./dots";
import type { Selection, Trial } from "./selection";
import type { Trials, Variant } from "./trials";

const NEAR = 24; // px, from which on a mark is under the pointer
const FADED = 0.12; // opacity of what is not chosen
const RUG = 6; // px, of the ticks of chosen trials below a distribution

interface Distribution {
  series: Series;
  variant: Variant;
  x: Float64Array;
  places?: { frame: Frame; x: Float32Array }; // whole px, since many trials have the same
}

interface Mark {
  trial: Trial;
  x: number;
  y: number;
}

export class TrialPlot implements Picking {
  private readonly layers: DotLayer[];
  private readonly distributions: Distribution[];
  private order: Mark[] | null = null; // from left to right, for keys
  private ordered: Distribution | null = null; // of which they are
  private current = -1;
  private faded: { frame: Frame; all: OffscreenCanvas } | null = null;
  private brushed: { x: Range; y: Range } | null = null; // what the last brush of this plot has covered

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
    if (!this.hasTrials) return;
    plot.setLayer((context, frame, point) => {
      if (!selection.isWhole && this.layers.length) this.drawFaded(context, frame, point);
      for (const layer of this.layers) layer.draw(context, frame, point, (variant, row) => selection.has(variant, row));
      this.drawRug(context, frame);
      this.drawBrush(context, frame);
    });
    selection.follow(() => plot.drawLayer());
  }

  private get hasTrials(): boolean {
    return this.layers.length > 0 || this.distributions.length > 0;
  }

  // Null where a plot has no trials.
  static of(plot: Plot, trials: Trials | null, selection: Selection, card: Card): TrialPlot | null {
    const made = trials && new TrialPlot(plot, trials, selection, card);
    return made?.hasTrials ? made : null;
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
    const between = (numbers: Float64Array) => [...numbers.keys()].filter((row) => numbers[row]! >= x[0] && numbers[row]! <= x[1]);
    this.brushed = { x, y };
    this.selection.choose(
      [
        ...this.layers.map((layer): [Variant, number[]] => [layer.variant, layer.within(x, y)]),
        ...this.distributions.map((each): [Variant, number[]] => [each.variant, between(each.x)]),
      ],
      this,
    );
  }

  // Keys step from mark to mark or along the first distribution, Enter pins, Escape ends a selection.
  press(key: string): boolean {
    if (key === "Escape" && !this.selection.isWhole) this.selection.choose(null);
    else if (key === "Enter") return this.pinCurrent();
    else if ((key === "ArrowLeft" || key === "ArrowRight") && this.marks().length) this.step(key === "ArrowLeft" ? -1 : 1);
    else return false;
    return true;
  }

  private step(by: number): void {
    const marks = this.marks();
    const near = this.currentMark();
    this.current = Math.min(Math.max((near ?? (by > 0 ? -1 : marks.length)) + by, 0), marks.length - 1);
    const { trial, x, y } = marks[this.current]!;
    const { left, top } = this.plot.area.getBoundingClientRect();
    if (!this.layers.length) this.plot.axis.moveCursor(x);
    const frame = this.plot.frame!;
    this.card.hover(trial, { clientX: left + frame.x.place(x), clientY: top + frame.y.place(y) });
  }

  private pinCurrent(): boolean {
    const current = this.currentMark();
    if (current !== null) this.card.pin(this.marks()[current]!.trial);
    return current !== null;
  }

  // The mark to which keys have stepped; of a distribution the one at its cursor, which other keys and the pointer move.
  private currentMark(): number | null {
    const marks = this.marks();
    const at = this.plot.axis.cursor;
    const isCurrent = this.current >= 0 && (this.layers.length > 0 || marks[this.current]!.x === at);
    if (isCurrent) return this.current;
    if (this.layers.length || at === null || !marks.length) return null;
    return marks.reduce((best, { x }, index) => (Math.abs(x - at) < Math.abs(marks[best]!.x - at) ? index : best), 0);
  }

  // From left to right: the marks of trials, or those of the first distribution that is shown.
  private marks(): Mark[] {
    const shown = this.distributions.find(({ series }) => !series.hidden) ?? null;
    if (this.order && shown === this.ordered) return this.order;
    this.ordered = shown;
    this.current = -1;
    const all = this.layers.flatMap((layer) =>
      layer.rows.map((row) => ({ trial: { variant: layer.variant, row }, x: layer.x[row]!, y: layer.y[row]! })),
    );
    shown?.x.forEach((x, row) => {
      if (Number.isFinite(x)) all.push({ trial: { variant: shown.variant, row }, x, y: shown.series.y(shown.series.rowAt(x)) });
    });
    this.order = all.sort((one, other) => one.x - other.x);
    return this.order;
  }

  private trialAt({ x, y }: { x: number; y: number }): Trial | null {
    const frame = this.plot.frame!;
    const nearest = this.layers
      .flatMap((layer) => layer.nearest(x, y, frame) ?? [])
      .sort((one, other) => one.distance - other.distance)[0];
    if (nearest) return nearest.distance <= NEAR ** 2 ? nearest.trial : null;
    return this.trialOfDistribution(frame.x.value(x), y, frame);
  }

  // Of the line nearest above or below a point the trial whose metric is nearest.
  private trialOfDistribution(x: number, y: number, frame: Frame): Trial | null {
    let [best, trial] = [NEAR, null as Trial | null];
    for (const { series, variant, x: numbers } of this.distributions) {
      if (series.hidden) continue;
      const distance = Math.abs(frame.y.place(series.y(series.rowAt(x))) - y);
      if (distance > best) continue;
      let row = -1;
      for (let each = 0; each < numbers.length; each++) {
        if (row < 0 || Math.abs(numbers[each]! - x) < Math.abs(numbers[row]! - x)) row = each;
      }
      [best, trial] = [distance, row < 0 ? trial : { variant, row }];
    }
    return trial;
  }

  // The range of the brush, of a distribution as high as the axes.
  private drawBrush(context: CanvasRenderingContext2D, frame: Frame): void {
    if (!this.brushed || this.selection.source !== this) return;
    const { x, y } = this.brushed;
    const [left, right] = x.map((end) => frame.x.place(end)) as Range;
    const [bottom, top] = this.layers.length ? (y.map((end) => frame.y.place(end)) as Range) : [frame.height, 0];
    context.fillStyle = SHADES.brush[0];
    context.fillRect(left, bottom, right - left, top - bottom);
  }

  // All trials, as they were drawn last at these places.
  private drawFaded(context: CanvasRenderingContext2D, frame: Frame, point: number): void {
    if (this.faded?.frame !== frame) {
      const [width, height] = [frame.width, frame.height].map((length) => Math.ceil(length * devicePixelRatio));
      const all = new OffscreenCanvas(width!, height!).getContext("2d")!;
      all.scale(devicePixelRatio, devicePixelRatio);
      for (const layer of this.layers) layer.draw(all, frame, point, () => true);
      this.faded = { frame, all: all.canvas };
    }
    context.globalAlpha = FADED;
    const { all } = this.faded;
    context.drawImage(all, 0, 0, all.width / devicePixelRatio, all.height / devicePixelRatio);
    context.globalAlpha = 1;
  }

  private drawRug(context: CanvasRenderingContext2D, frame: Frame): void {
    for (const each of this.distributions) {
      if (each.places?.frame !== frame) each.places = { frame, x: Float32Array.from(each.x, (x) => Math.round(frame.x.place(x))) };
      context.fillStyle = each.series.curve.colour;
      const isMarked = new Uint8Array(frame.width + 1);
      for (const row of this.selection.rows(each.variant)) isMarked[each.places.x[row]!] = 1;
      isMarked.forEach((marked, place) => marked && context.fillRect(place - 0.5, frame.height - RUG, 1, RUG));
    }
  }
}
