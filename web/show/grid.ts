// Two columns against each other: squares by their number of trials and fraction of failures, or dots of few trials.

import { format } from "../page/numbers";
import { Canvas, type Span } from "./canvas";
import type { GridCounts, QuantityEntry, ShowDocument, VariantEntry } from "../generated/documents";
import { type Dots, decodeDots, nearestDot } from "./dots";
import { make } from "../page/elements";
import { choice, colour, labelOf, shortName } from "./elements";
import type { Filter } from "./filter";
import { lineColour } from "./histogram";
import { Scale } from "./scale";

const NEAR = 20; // px, from which on a dot is under the pointer
const SUCCESS = [0, 114, 178];
const FAILURE = [213, 94, 0];

export class Grid {
  readonly element = make("figure", { class: "counted grid" });
  private readonly canvas: Canvas;
  private readonly reading = make("output", { "aria-live": "polite" });
  private counts: GridCounts | null = null;
  private scales: { x: Scale; y: Scale } | null = null;
  private dots: Dots | null = null;
  private cursor: { x: number; y: number } | null = null; // a square
  private anchor: { x: number; y: number } | null = null;

  constructor(
    readonly columns: [x: number, y: number],
    private readonly quantities: QuantityEntry[],
    private readonly variants: VariantEntry[],
    private readonly sizes: ShowDocument,
    private readonly filter: Filter,
    private readonly onSelect: () => void,
    private readonly onTrial: (row: number) => void,
  ) {
    this.canvas = new Canvas({ left: 58, top: 26, width: 12, height: 38 }, this, () => this.draw());
    const keys = "arrow keys move over the squares, with shift they select, escape selects all";
    this.canvas.element.setAttribute("aria-label", `Trials over two quantities; ${keys}`);
    const chooser = (axis: 0 | 1) =>
      choice(axis ? "vertical" : "horizontal", quantities.map(labelOf), columns[axis], (index) => {
        this.columns[axis] = index;
        onSelect();
      });
    this.element.append(make("div", { class: "head" }, chooser(0), chooser(1)), this.canvas.element, this.reading);
  }

  show(counts: GridCounts): void {
    this.counts = counts;
    this.scales = counts.x && counts.y && { x: new Scale(counts.x), y: new Scale(counts.y) };
    this.dots = counts.dots ? decodeDots(counts.dots) : null;
    this.draw();
  }

  brush({ x, y }: Span): void {
    const bin = (fraction: number) => Math.min(Math.floor(fraction * this.sizes.bins), this.sizes.bins - 1);
    if (this.scales) this.select({ x: [bin(x[0]), bin(x[1])], y: [bin(y[0]), bin(y[1])] });
    this.onSelect();
  }

  click(x: number, y: number): void {
    const dot = this.dotAt(x, y);
    if (dot >= 0) this.onTrial(this.dots!.rows[dot]!);
    else if (this.columns.some((each) => this.filter.range(each))) {
      this.select(null);
      this.onSelect();
    }
  }

  point(x: number | null, y: number): void {
    const square = (fraction: number) => Math.min(Math.floor(fraction * this.sizes.bars), this.sizes.bars - 1);
    this.cursor = x === null ? null : { x: square(x), y: square(y) };
    this.anchor = null;
    this.read();
    this.canvas.element.style.cursor = x !== null && this.dotAt(x, y) >= 0 ? "pointer" : "";
  }

  press(key: string, extend: boolean): boolean {
    const steps: [string, number, number][] = [["ArrowLeft", -1, 0], ["ArrowRight", 1, 0], ["ArrowUp", 0, 1], ["ArrowDown", 0, -1]];
    const step = steps.find(([name]) => name === key);
    if (key === "Escape") {
      this.anchor = null;
      this.select(null);
      this.onSelect();
    } else if (key === "Enter" && this.cursor && this.dots) {
      this.click((this.cursor.x + 0.5) / this.sizes.bars, (this.cursor.y + 0.5) / this.sizes.bars);
    } else if (step && this.scales) this.move(step[1], step[2], extend);
    else return false;
    return true;
  }

  private move(byX: number, byY: number, extend: boolean): void {
    const last = this.sizes.bars - 1;
    const before = this.cursor ?? { x: this.sizes.bars / 2, y: this.sizes.bars / 2 };
    const within = (square: number) => Math.min(Math.max(square, 0), last);
    this.cursor = { x: within(before.x + byX), y: within(before.y + byY) };
    if (extend) {
      this.anchor ??= before;
      const bins = this.sizes.bins / this.sizes.bars;
      const range = (one: number, other: number): [number, number] => [Math.min(one, other) * bins, (Math.max(one, other) + 1) * bins - 1];
      this.select({ x: range(this.anchor.x, this.cursor.x), y: range(this.anchor.y, this.cursor.y) });
      this.onSelect();
    } else this.anchor = null;
    this.read();
    this.draw();
  }

  private select(area: { x: [number, number]; y: [number, number] } | null): void {
    this.filter.select(this.columns[0], area && area.x);
    this.filter.select(this.columns[1], area && area.y);
  }

  private dotAt(x: number, y: number): number {
    if (!this.dots) return -1;
    const { bins } = this.sizes;
    const { width, height } = this.canvas.box;
    return nearestDot(this.dots, { x: x * bins, y: y * bins }, { x: width / bins, y: height / bins }, NEAR);
  }

  private read(): void {
    const { scales, cursor, counts } = this;
    if (!cursor || !scales || !counts) {
      this.reading.textContent = "";
      return;
    }
    const place = (["x", "y"] as const).map((axis, index) => {
      const quantity = this.quantities[this.columns[index]!]!;
      const fraction = (cursor[axis] + 0.5) / this.sizes.bars;
      const text = format(scales[axis].at(fraction) * quantity.factor, scales[axis].digits(fraction, this.sizes.bars));
      return `${shortName(quantity)} ${text} ${quantity.unit}`.trim();
    });
    this.reading.textContent = `${place.join(", ")}${this.describe(cursor)}`;
  }

  private describe({ x, y }: { x: number; y: number }): string {
    if (!this.counts?.counts) return "";
    const square = y * this.sizes.bars + x;
    return `: ${this.counts.counts[square]} trials, ${this.counts.failures![square]} failures`;
  }

  private draw(): void {
    this.canvas.start();
    if (!this.counts || !this.scales) return;
    const [x, y] = this.columns.map((column) => this.quantities[column]!) as [QuantityEntry, QuantityEntry];
    this.canvas.xAxis(this.scales.x, x.factor, labelOf(x));
    this.canvas.yAxis(this.scales.y, y.factor, labelOf(y));
    if (this.dots) this.drawDots(this.dots);
    else if (this.counts.counts) this.drawSquares(this.counts.counts, this.counts.failures!);
    const span = this.canvas.marked ?? this.selected();
    if (span) this.canvas.drawSpan(span);
    if (this.cursor && document.activeElement === this.canvas.element && !this.canvas.marked) {
      const { left, top, width, height } = this.canvas.box;
      const [side, rise] = [width / this.sizes.bars, height / this.sizes.bars];
      this.canvas.context.strokeStyle = colour("ink");
      this.canvas.context.strokeRect(left + this.cursor.x * side, top + height - (this.cursor.y + 1) * rise, side, rise);
    }
  }

  private selected(): Span | null {
    const [x, y] = this.columns.map((each) => this.filter.range(each));
    if (!x && !y) return null;
    const ends = (range: { first: number; last: number } | undefined): [number, number] =>
      range ? [range.first / this.sizes.bins, (range.last + 1) / this.sizes.bins] : [0, 1];
    return { x: ends(x), y: ends(y) };
  }

  private drawSquares(counts: number[], failures: number[]): void {
    const { context, box } = this.canvas;
    const { bars } = this.sizes;
    const most = Math.log1p(counts.reduce((one, other) => Math.max(one, other), 1));
    for (let square = 0; square < counts.length; square++) {
      const count = counts[square]!;
      if (!count) continue;
      const fraction = failures[square]! / count;
      const mixed = SUCCESS.map((each, index) => Math.round(each + fraction * (FAILURE[index]! - each)));
      context.fillStyle = `rgb(${mixed.join(" ")} / ${0.12 + 0.88 * (Math.log1p(count) / most)})`;
      const [x, y] = [square % bars, Math.floor(square / bars)];
      const left = Math.round(box.left + (x / bars) * box.width);
      const top = Math.round(box.top + (1 - (y + 1) / bars) * box.height);
      const right = Math.round(box.left + ((x + 1) / bars) * box.width);
      const bottom = Math.round(box.top + (1 - y / bars) * box.height);
      context.fillRect(left, top, right - left, bottom - top);
    }
  }

  // Successes are squares in the colour of their variant, failures crosses above them.
  private drawDots({ x, y, success, variants }: Dots): void {
    const { context, box } = this.canvas;
    const { bins } = this.sizes;
    const size = x.length > 3000 ? 2 : 3.5;
    const [crosses, colours] = [new Path2D(), this.variants.map(lineColour)];
    const squares = this.variants.map(() => new Path2D());
    for (let dot = 0; dot < x.length; dot++) {
      const left = box.left + ((x[dot]! + 0.5) / bins) * box.width;
      const top = box.top + (1 - (y[dot]! + 0.5) / bins) * box.height;
      if (success[dot]) squares[variants[dot]!]!.rect(left - size / 2, top - size / 2, size, size);
      else {
        crosses.moveTo(left - size, top - size);
        crosses.lineTo(left + size, top + size);
        crosses.moveTo(left - size, top + size);
        crosses.lineTo(left + size, top - size);
      }
    }
    context.globalAlpha = 0.75;
    squares.forEach((path, index) => {
      context.fillStyle = colours[index]!;
      context.fill(path);
    });
    context.globalAlpha = 1;
    context.strokeStyle = colour("ink");
    context.lineWidth = 1.2;
    context.stroke(crosses);
  }
}
