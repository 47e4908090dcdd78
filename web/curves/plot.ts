// One chart: axes over those of the figure's picture, the lines of the figure, the cursor.

import type { Axis, Chart } from "../generated/charts";
import type { Page } from "../page/document";
import { make } from "../page/elements";
import { drawAxes } from "../chart/axes";
import { SharedAxis } from "./axis";
import { type Layer, type Shape, clipped, drawAbove, drawBelow, loadShapes } from "../chart/drawing";
import { Frame, type Range } from "../chart/frame";
import { Series } from "../chart/series";
import { type Place, Sheet } from "../chart/sheet";
import { ticksOf } from "../chart/ticks";

const MARGIN = 0.06; // of a zoomed ordinate, above and below its values
const [ACROSS, UP] = [60, 30]; // px at least from a tick to the next, along the abscissa and the ordinate

export class Plot {
  readonly root = make("div", { class: "chart" });
  readonly area = make("div", { class: "area" }); // of the axes, over the canvas
  isNear = false; // to the screen: only then it is drawn again
  frame: Frame | null = null; // null before it has a place
  private sheets = [new Sheet()];
  private layer: Layer | null = null;
  private placed: Place | null = null;
  private isPending = false; // a picture
  private ordinate: Range | null = null; // of a path at its own zoom
  private readonly line = make("div", { class: "cursor" });
  private readonly mark = make("div", { class: "cursor mark" }); // the second cursor
  private readonly dots: HTMLElement[];

  private constructor(
    readonly chart: Chart,
    readonly series: Series[],
    private readonly shapes: Shape[],
    readonly axis: SharedAxis,
    readonly time: SharedAxis, // along which the cursor moves
  ) {
    this.dots = series.map(({ curve }) => make("i", { style: `background: ${curve.colour}` }));
    this.area.append(this.line, this.mark, ...this.dots);
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
    this.placed = place;
    const { left, top, width, height, margins } = place;
    Object.assign(this.root.style, { left: px(left), top: px(top), width: px(width), height: px(height) });
    this.area.style.inset = px(...margins);
    this.root.append(...this.sheets.map((sheet) => sheet.canvas), this.area);
    this.update();
    this.draw();
  }

  redraw(): void {
    if (!this.isNear || !this.placed) return;
    this.update();
    if (!this.isPending) queueMicrotask(() => this.draw()); // one picture of all that changes together
    this.isPending = true;
  }

  // Where values lie from now on.
  private update(): void {
    const { width, height, margins } = this.placed!;
    this.frame = new Frame(width - margins[1] - margins[3], height - margins[0] - margins[2], this.chart, this.ends());
    this.showCursor();
  }

  private draw(): void {
    this.isPending = false;
    const { chart, placed, frame } = this;
    const { point, isNarrow } = placed!;
    const isWhole = this.axis.zoom === null;
    const ticks = {
      x: ticksOf(chart.x, frame!.x.ends, frame!.width / ACROSS, isNarrow, isWhole),
      y: ticksOf(chart.y, frame!.y.ends, frame!.height / UP, false, isWhole),
    };
    const below = this.sheets[0]!.clear(placed!);
    drawAxes(below, frame!, chart, ticks, point);
    drawBelow(below, frame!, chart, this.shapes, point);
    this.drawLayer();
    const above = this.layer ? this.sheets[2]!.clear(placed!) : below;
    drawAbove(above, frame!, chart, this.series, point, isWhole);
  }

  // A layer between areas and lines, which has a canvas and can be drawn without them.
  setLayer(layer: Layer): void {
    this.layer = layer;
    this.sheets = [new Sheet(), new Sheet(), new Sheet()];
  }

  drawLayer(): void {
    const { frame, layer, placed } = this;
    if (!layer || !placed || !this.isNear) return;
    const context = this.sheets[1]!.clear(placed);
    clipped(context, frame!, () => layer(context, frame!, placed.point));
  }

  // Zooms to a rectangle of the abscissa and, of a path, of the ordinate; null: as drawn.
  zoom(x: Range | null, y: Range | null): void {
    this.ordinate = x && this.isPath ? y : null;
    this.axis.setZoom(x);
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
    const { x, y } = this.frame!;
    let [best, time] = [Infinity, null as number | null];
    for (const each of this.series) {
      if (!each.time || each.hidden) continue;
      for (let row = 0; row < each.x.length; row++) {
        const distance = (x.place(each.x[row]!) - left) ** 2 + (y.place(each.y(row)) - top) ** 2;
        if (distance < best) [best, time] = [distance, each.time[row]!];
      }
    }
    return time;
  }

  private showCursor(): void {
    const { frame } = this;
    if (!frame || !this.isNear) return;
    const at = this.time.cursor;
    this.moveLine(this.line, at);
    this.moveLine(this.mark, this.time.mark);
    this.series.forEach((each, index) => {
      const row = at !== null && this.isShown(each) && !each.curve.reduced ? each.rowWithin(at) : null;
      const [left, top] = row === null ? [NaN, NaN] : [frame.x.place(each.x[row]!), frame.y.place(each.y(row))];
      this.dots[index]!.hidden = !frame.has(left, top);
      this.dots[index]!.style.transform = `translate(${left}px, ${top}px)`;
    });
  }

  private moveLine(line: HTMLElement, at: number | null): void {
    const left = at === null || this.isPath ? NaN : this.frame!.x.place(at);
    line.hidden = !this.frame!.has(left, 0);
    line.style.transform = `translateX(${left}px)`;
  }

  // True if a line is one whose values are shown at the cursor.
  isShown(series: Series): boolean {
    const isLane = this.chart.y.named && !series.curve.name; // of an ordinate without quantity
    const isAlong = series.time !== null || !(this.isPath || series.isPath); // no outline, no unordered points
    const isNameless = !series.curve.name && this.series.some((each) => each.curve.name); // next to what has one
    return !series.hidden && series.x.length > 1 && !isLane && !isNameless && isAlong;
  }

  private ends(): { x: Range; y: Range } {
    const { x, y } = this.chart;
    const zoom = this.axis.zoom;
    if (!zoom) return { x: x.ends, y: y.ends };
    const range = this.isPath ? this.ordinate : this.reach(zoom);
    if (!range) return { x: zoom, y: y.ends };
    return { x: zoom, y: y.ends[0] < y.ends[1] ? range : [range[1], range[0]] };
  }

  // The ordinates of all lines within a range of the abscissa, with margins; null: as drawn.
  private reach(range: Range): Range | null {
    const { y } = this.chart;
    const reaches = this.series.filter((each) => !each.hidden).map((each) => each.reach(range)).filter((each) => each !== null);
    if (!reaches.length || y.named) return null;
    const [low, high] = [Math.min(...reaches.map((each) => each[0])), Math.max(...reaches.map((each) => each[1]))];
    if (y.logarithmic) return low > 0 ? [low / 1.2, high * 1.2] : null;
    const margin = MARGIN * (high - low) || MARGIN * Math.abs(high) || 1;
    return [low - margin, high + margin];
  }
}

function px(...sizes: number[]): string {
  return sizes.map((size) => `${size}px`).join(" ");
}
