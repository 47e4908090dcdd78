// One chart: uPlot's axes over the axes of the figure's picture, the lines of the figure, the cursor.

import uPlot from "uplot";

import type { Axis, Chart } from "../generated/charts";
import type { Page } from "../page/document";
import { type Range, SharedAxis } from "./axis";
import { type Layer, Positions, type Shape, drawAbove, drawBelow, loadShapes } from "./drawing";
import { Series } from "./series";
import { axisOptions } from "./ticks";

const MARGIN = 0.06; // of a zoomed ordinate, above and below its values
const [ACROSS, UP] = [60, 30]; // px at least from a tick to the next, along the abscissa and the ordinate

export interface Place {
  left: number; // px, of the root in the figure
  top: number;
  width: number;
  height: number;
  margins: [top: number, right: number, bottom: number, left: number]; // px, from the root to the axes' area
  point: number; // px of a pt of the figure
  isNarrow: boolean; // the abscissa has few ticks
}

export class Plot {
  readonly root = document.createElement("div");
  readonly layers: Layer[] = []; // drawn below the lines
  isNear = false; // to the screen: only then it is drawn anew
  onArea: (area: HTMLElement) => void = () => undefined; // called with each new area in which lines are drawn
  private plot: uPlot | null = null;
  private size = { width: 0, height: 0 }; // px, of the area; asking the page for it would lay it out anew each time
  private ordinate: Range | null = null; // of a path at its own zoom
  private readonly line = document.createElement("div");
  private readonly mark = document.createElement("div"); // the second cursor
  private readonly dots: HTMLElement[];

  private constructor(
    readonly chart: Chart,
    readonly series: Series[],
    private readonly shapes: Shape[],
    readonly axis: SharedAxis,
    readonly time: SharedAxis, // along which the cursor moves
  ) {
    this.root.className = "chart";
    this.line.className = "cursor";
    this.mark.className = "cursor mark";
    this.dots = series.map((each) => {
      const dot = document.createElement("i");
      dot.style.background = each.curve.colour;
      return dot;
    });
    this.axis.followZoom(chart.x.ends, () => this.redraw());
    this.time.followCursor(() => this.showCursor());
  }

  // ``sharing`` gives the axis of a label; paths have an abscissa of their own, and follow the time of the others.
  static async load(chart: Chart, page: Page, sharing: (axis: Axis) => SharedAxis, time: () => SharedAxis): Promise<Plot> {
    const [series, shapes] = await Promise.all([
      Promise.all((chart.curves ?? []).map((curve) => Series.load(curve, page))),
      loadShapes(chart, page),
    ]);
    const isPath = series.some((each) => each.time);
    const axis = isPath ? new SharedAxis(chart.x.label ?? "", !!chart.x.logarithmic) : sharing(chart.x);
    return new Plot(chart, series, shapes, axis, isPath ? time() : axis);
  }

  get isPath(): boolean {
    return this.axis !== this.time;
  }

  place(place: Place): void {
    Object.assign(this.root.style, px({ left: place.left, top: place.top, width: place.width, height: place.height }));
    this.plot?.destroy();
    this.plot = new uPlot(this.options(place), [[0], [null]], this.root);
    this.plot.over.append(this.line, this.mark, ...this.dots);
    this.size = { width: this.plot.bbox.width / devicePixelRatio, height: this.plot.bbox.height / devicePixelRatio };
    this.onArea(this.plot.over);
    this.showCursor();
  }

  redraw(): void {
    if (!this.isNear) return;
    this.plot?.batch((plot: uPlot) => {
      const [x, y] = this.ranges();
      plot.setScale("x", { min: x[0], max: x[1] });
      plot.setScale("y", { min: y[0], max: y[1] });
    });
    this.showCursor();
  }

  // Zooms to a rectangle of the abscissa and, of a path, of the ordinate; null: as drawn.
  zoom(x: Range | null, y: Range | null): void {
    this.ordinate = x && this.isPath ? y : null;
    this.axis.setZoom(x);
  }

  // Positions on the canvas, in its px, of which a px of the page has so many.
  get positions(): { to: Positions; left: number; top: number } {
    const { left, top } = this.plot!.bbox;
    return { to: new Positions(this.plot!), left, top };
  }

  valueAt(left: number): number {
    return this.plot!.posToVal(left, "x");
  }

  ordinateAt(top: number): number {
    return this.plot!.posToVal(top, "y");
  }

  // Where the row of the first line that is nearest to a place of the cursor has it, or one so many rows further.
  snap(at: number, rows = 0): number {
    const first = this.series.find((each) => this.isShown(each));
    if (!first) return at;
    const row = first.rowAt(at) + rows;
    return first.along[Math.min(Math.max(row, 0), first.along.length - 1)]!;
  }

  // The time of the point of a path that is nearest to a place in the area.
  nearestTime(left: number, top: number): number | null {
    let [best, time] = [Infinity, null as number | null];
    for (const each of this.series) {
      if (!each.time || each.hidden) continue;
      const scales = this.plot!.scales;
      const unit = [
        this.size.width / (scales.x!.max! - scales.x!.min!),
        this.size.height / (scales.y!.max! - scales.y!.min!),
      ] as const;
      const at = [this.valueAt(left), this.ordinateAt(top)] as const;
      for (let row = 0; row < each.x.length; row++) {
        const distance = ((each.x[row]! - at[0]) * unit[0]) ** 2 + ((each.y(row) - at[1]) * unit[1]) ** 2;
        if (distance < best) [best, time] = [distance, each.time[row]!];
      }
    }
    return time;
  }

  private showCursor(): void {
    if (!this.plot || !this.isNear) return;
    const at = this.time.cursor;
    const visible = at !== null;
    this.moveLine(this.line, at);
    this.moveLine(this.mark, this.time.mark);
    this.series.forEach((each, index) => {
      const dot = this.dots[index]!;
      const row = visible && this.isShown(each) && !each.curve.reduced ? each.rowWithin(at) : null;
      dot.hidden = row === null;
      if (row === null) return;
      const [left, top] = [this.plot!.valToPos(each.x[row]!, "x"), this.plot!.valToPos(each.y(row), "y")];
      dot.hidden = !(left >= 0 && left <= this.size.width && top >= 0 && top <= this.size.height);
      dot.style.transform = `translate(${left}px, ${top}px)`;
    });
  }

  private moveLine(line: HTMLElement, at: number | null): void {
    const left = at === null || this.isPath ? -1 : this.plot!.valToPos(at, "x");
    line.hidden = !(left >= 0 && left <= this.size.width);
    line.style.transform = `translateX(${left}px)`;
  }

  // Whether a line is one whose values are shown at the cursor.
  isShown(series: Series): boolean {
    const isLane = this.chart.y.named && !series.curve.name; // of an ordinate without quantity
    const isAlong = series.time !== null || !(this.isPath || series.isPath); // no outline, no unordered points
    const isNameless = !series.curve.name && this.series.some((each) => each.curve.name); // next to what has one
    return !series.hidden && series.x.length > 1 && !isLane && !isNameless && isAlong;
  }

  private ranges(): [Range, Range] {
    const { x, y } = this.chart;
    const range = this.axis.zoom;
    const whole = ascending(y.ends);
    if (!range) return [x.ends, whole];
    if (this.isPath) return [range, this.ordinate ?? whole];
    const reaches = this.series.filter((each) => !each.hidden).map((each) => each.reach(range)).filter((each) => each !== null);
    if (!reaches.length || y.named) return [range, whole];
    const [low, high] = [Math.min(...reaches.map((each) => each[0])), Math.max(...reaches.map((each) => each[1]))];
    if (y.logarithmic) return [range, low > 0 ? [low / 1.2, high * 1.2] : whole];
    const margin = MARGIN * (high - low) || MARGIN * Math.abs(high) || 1;
    return [range, [low - margin, high + margin]];
  }

  private options({ width, height, margins, point, isNarrow }: Place): uPlot.Options {
    const { x, y } = this.chart;
    const [rangeX, rangeY] = this.ranges();
    const isWhole = () => this.axis.zoom === null;
    return {
      width,
      height,
      padding: [margins[0], margins[1], null, null],
      cursor: { show: false },
      legend: { show: false },
      scales: {
        x: { time: false, distr: x.logarithmic ? 3 : 1, range: (_, low, high) => [low ?? rangeX[0], high ?? rangeX[1]], min: rangeX[0], max: rangeX[1] },
        y: {
          dir: y.ends[0] > y.ends[1] ? -1 : 1,
          distr: y.logarithmic ? 3 : 1, range: (_, low, high) => [low ?? rangeY[0], high ?? rangeY[1]], min: rangeY[0], max: rangeY[1],
        },
      },
      series: [{}, { show: true, stroke: "transparent", points: { show: false } }],
      axes: [axisOptions(x, margins[2], ACROSS, point, isNarrow, isWhole), axisOptions(y, margins[3], UP, point, false, isWhole)],
      hooks: {
        ready: [() => this.redraw()],
        drawAxes: [(plot) => drawBelow(plot, this.chart, this.shapes, point)],
        draw: [(plot) => drawAbove(plot, this.chart, this.series, this.layers, point, isWhole())],
      },
    };
  }
}

function ascending([one, other]: Range): Range {
  return one < other ? [one, other] : [other, one];
}

function px(sizes: Record<string, number>): Record<string, string> {
  return Object.fromEntries(Object.entries(sizes).map(([name, size]) => [name, `${size}px`]));
}
