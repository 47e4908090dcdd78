// One figure of the page: its charts over its picture, which remains for print and gives the size.

import type { Axis, Chart } from "../generated/charts";
import type { Page } from "../page/document";
import { fontOf, widthOf } from "../chart/axes";
import type { SharedAxis } from "./axis";
import { markCursor } from "./marker";
import { Plot } from "./plot";
import { describePlot } from "./readout";
import type { Place } from "../chart/sheet";

const GAP = 18; // px above axes
const LABELS = 44; // px at least, left of axes
const TICKS = 24; // px at least, below axes
const BESIDE = 4; // px, from a text to the edge, pt for strokes of ticks alone
const MARGIN = { rootMargin: "400px 0px" }; // around the screen, within which figures get their canvases

export class Figure {
  readonly frame = document.createElement("div");
  readonly values = document.createElement("output");
  private size = { width: 0, height: 0 }; // px; 0 while it is folded away
  private isNear = false; // to the screen: far ones have no canvas yet, or an old one, since all at once stop the page
  private isDrawn = false; // for its size

  private constructor(
    readonly picture: SVGElement,
    private readonly charts: Chart[],
    readonly plots: Plot[],
  ) {
    this.frame.className = "live";
    picture.before(this.frame);
    this.frame.append(picture, ...plots.map((plot) => plot.root));
    this.values.className = "values";
    this.frame.after(this.values);
    // Calls once when it begins to observe, for all new figures together after the page was laid out.
    new ResizeObserver(([entry]) => this.resize(entry!.contentRect)).observe(this.frame);
    new IntersectionObserver((entries) => this.move(entries.at(-1)!.isIntersecting), MARGIN).observe(this.frame);
    window.addEventListener("resize", () => this.isNear && this.draw()); // another screen has other pixels
    this.frame.addEventListener("focusin", () => this.move(true));
    for (const plot of plots) plot.time.followCursor(() => this.showValues());
  }

  // Null where the figure remains a picture.
  static async load(picture: SVGElement, page: Page, sharing: (axis: Axis) => SharedAxis, time: () => SharedAxis): Promise<Figure | null> {
    const charts = page.figures[Number(picture.dataset.figure)]!;
    if (charts.some((chart) => chart.picture)) {
      markCursor(picture, charts, sharing);
      return null;
    }
    const plots = await Promise.all(charts.map((chart) => Plot.load(chart, page, sharing, time)));
    return new Figure(picture, charts, plots);
  }

  private resize({ width, height }: { width: number; height: number }): void {
    if (width === this.size.width && height === this.size.height) return;
    this.size = { width, height };
    this.isDrawn = false;
    if (this.isNear) this.draw();
  }

  private move(isNear: boolean): void {
    if (isNear === this.isNear) return;
    this.isNear = isNear;
    for (const plot of this.plots) plot.isNear = isNear;
    if (isNear) this.draw();
  }

  private draw(): void {
    const { width, height } = this.size;
    if (!width || !height) return;
    if (this.isDrawn) for (const plot of this.plots) plot.redraw();
    else {
      const boxes = this.charts.map((chart) => boxOf(chart, width, height));
      this.plots.forEach((plot, index) => plot.place(placeOf(this.charts[index]!, boxes, index, width)));
      this.reserve();
    }
    this.isDrawn = true;
    this.frame.classList.add("drawn"); // from now on the picture is hidden
  }

  // Hides the lines of which it says so, by their name, number and all names, and shows the others.
  hide(hides: (name: string, line: number, names: ReadonlySet<string>) => boolean): void {
    for (const plot of this.plots) {
      const names = new Set(plot.series.map(({ curve }) => curve.name ?? ""));
      plot.series.forEach((series, line) => (series.hidden = hides(series.curve.name ?? "", line, names)));
      plot.redraw();
    }
    this.showValues();
  }

  // What the lines show at the cursor.
  describe(): string {
    return this.plots
      .flatMap((plot) => (plot.time.cursor === null ? [] : describePlot(plot, plot.time.cursor).map(([text]) => text)))
      .join("; ");
  }

  // The height of values in the middle of the lines, so that the page does not move under the cursor.
  private reserve(): void {
    this.values.style.minHeight = "";
    this.write(
      this.plots.flatMap((plot) => {
        const along = plot.series.find((each) => plot.isShown(each))?.along;
        return along ? describePlot(plot, along[along.length >> 1]!) : [];
      }),
    );
    this.values.style.minHeight = `${this.values.offsetHeight}px`;
    this.showValues();
  }

  private showValues(): void {
    if (!this.size.height) return;
    this.write(this.plots.flatMap((plot) => (plot.time.cursor === null ? [] : describePlot(plot, plot.time.cursor))));
  }

  private write(entries: [text: string, colour: string][]): void {
    const spans = this.values.children;
    while (spans.length > entries.length) spans[entries.length]!.remove();
    for (const [index, [text, colour]] of entries.entries()) {
      const span = (spans[index] ?? this.values.appendChild(document.createElement("span"))) as HTMLElement;
      if (span.textContent !== text) span.textContent = text;
      if (span.dataset.colour !== colour) span.style.borderColor = span.dataset.colour = colour;
    }
  }
}

const measuring = document.createElement("canvas").getContext("2d")!;

type Box = [left: number, top: number, right: number, bottom: number]; // px in the figure

// The area of the axes in a figure of this size (px).
function boxOf({ fluid }: Chart, width: number, height: number): Box {
  const [left, top, right, bottom] = fluid!.margins;
  return [left, top, width - right, height - bottom];
}

// Where a chart's element lies in the figure: the axes' area is that of the picture, the margins reach to its neighbours.
function placeOf(chart: Chart, boxes: Box[], index: number, width: number): Place {
  const { x, y } = chart;
  const { point } = chart.fluid!;
  const [left, top, right, bottom] = boxes[index]!;
  const before = boxes.map((box) => box[2]).filter((end) => end <= left);
  const names = widthOf(y, measuring, point) + 2 * BESIDE;
  const margins: Place["margins"] = [
    Math.min(GAP, top),
    Math.min(Math.max(GAP, widthOf(x, measuring, point) / 2 + BESIDE, reachOf(chart, point)), width - right + 2 * BESIDE),
    x.bare ? BESIDE * point : Math.max(TICKS, 2 * x.size * point),
    y.bare ? BESIDE : Math.max(LABELS, names, Math.min(left - Math.max(0, ...before), 1.5 * LABELS)),
  ];
  return {
    left: left - margins[3],
    top: top - margins[0],
    width: right - left + margins[1] + margins[3],
    height: bottom - top + margins[0] + margins[2],
    margins,
    point,
    isNarrow: x.narrow !== undefined && width <= x.narrow,
  };
}

// How far (px) notes reach to the right of the axes.
function reachOf(chart: Chart, point: number): number {
  const beside = (chart.notes ?? []).filter(({ at, of_axes }) => of_axes[0] && at[0] > 1);
  return Math.max(0, ...beside.map((note) => {
    measuring.font = fontOf(note.size * point);
    return measuring.measureText(note.text).width + GAP;
  }));
}
