// The histogram of a column: a line for each variant over bars of equal width on its scale.

import { format } from "../page/numbers";
import { Canvas, type Span } from "./canvas";
import type { HistogramCounts, QuantityEntry, ShowDocument, VariantEntry } from "../generated/documents";
import { make } from "../page/elements";
import { colour, labelOf, shortName } from "./elements";
import type { Filter } from "./filter";
import { Scale } from "./scale";

export class Histogram {
  readonly element = make("figure", { class: "counted" });
  private readonly canvas: Canvas;
  private readonly reading = make("output", { "aria-live": "polite" });
  private readonly outside = make("p", { class: "note" });
  private counts: HistogramCounts | null = null;
  private scale: Scale | null = null;
  private cursor: number | null = null; // a bar
  private anchor: number | null = null; // the bar from which keys extend a range

  constructor(
    readonly column: number,
    private readonly quantity: QuantityEntry,
    private readonly variants: VariantEntry[],
    private readonly sizes: ShowDocument,
    private readonly filter: Filter,
    private readonly onSelect: () => void,
    onRemove: () => void,
  ) {
    this.canvas = new Canvas({ left: 50, top: 26, width: 8, height: 38 }, this, () => this.draw());
    const name = shortName(quantity);
    const keys = "left and right move along the bars, with shift they select, escape selects all";
    this.canvas.element.setAttribute("aria-label", `Histogram of ${name}; ${keys}`);
    const remove = make("button", { type: "button", class: "remove", "aria-label": `Remove ${name}` }, "\u00d7");
    remove.addEventListener("click", onRemove);
    const title = make("figcaption", { title: quantity.meaning }, labelOf(quantity));
    this.element.append(make("div", { class: "head" }, title, remove), this.canvas.element, this.reading, this.outside);
  }

  show(counts: HistogramCounts): void {
    this.counts = counts;
    this.scale = counts.scale && new Scale(counts.scale);
    this.outside.textContent = this.describeOutside();
    this.draw();
  }

  brush({ x }: Span): void {
    if (!this.scale) return;
    const last = this.sizes.bins - 1;
    this.select(Math.min(Math.floor(x[0] * this.sizes.bins), last), Math.min(Math.floor(x[1] * this.sizes.bins), last));
  }

  click(): void {
    this.anchor = null;
    if (!this.filter.range(this.column)) return;
    this.filter.select(this.column, null);
    this.onSelect();
  }

  point(x: number | null): void {
    this.cursor = x === null ? null : Math.min(Math.floor(x * this.sizes.bars), this.sizes.bars - 1);
    this.anchor = null;
    this.read();
    this.draw();
  }

  press(key: string, extend: boolean): boolean {
    const by = key === "ArrowLeft" ? -1 : key === "ArrowRight" ? 1 : 0;
    if (key === "Escape") this.click();
    else if (by && this.scale) this.move(by, extend);
    else return false;
    return true;
  }

  private move(by: number, extend: boolean): void {
    const before = this.cursor ?? (by > 0 ? -1 : this.sizes.bars);
    this.cursor = Math.min(Math.max(before + by, 0), this.sizes.bars - 1);
    if (extend) {
      this.anchor ??= Math.min(Math.max(before, 0), this.sizes.bars - 1);
      const bins = this.sizes.bins / this.sizes.bars;
      this.select(Math.min(this.anchor, this.cursor) * bins, (Math.max(this.anchor, this.cursor) + 1) * bins - 1);
    } else this.anchor = null;
    this.read();
    this.draw();
  }

  private select(first: number, last: number): void {
    this.filter.select(this.column, [first, last]);
    this.onSelect();
  }

  private describeOutside(): string {
    if (!this.scale) return "No finite value in any trial.";
    const sums = [0, 1, 2].map((kind) => this.counts!.counts.reduce((sum, each) => sum + each[this.sizes.bars + kind]!, 0));
    const texts = ["not a number", "\u221e", "\u2212\u221e"].flatMap((text, kind) => (sums[kind] ? [`${text}: ${sums[kind]}`] : []));
    return texts.join(", ");
  }

  private read(): void {
    const { scale, cursor, counts } = this;
    if (cursor === null || !scale || !counts) {
      this.reading.textContent = "";
      return;
    }
    const { factor, unit } = this.quantity;
    const { bars } = this.sizes;
    const [low, high] = [cursor, cursor + 1].map((bar) => format(scale.at(bar / bars) * factor, scale.digits(bar / bars, bars)));
    const texts = counts.counts.map((each, index) => (this.variants.length > 1 ? `${this.variants[index]!.name} ${each[cursor]}` : `${each[cursor]}`));
    this.reading.textContent = `${low} to ${high} ${unit}`.trim() + `: ${texts.join(", ")}`;
  }

  private draw(): void {
    const context = this.canvas.start();
    if (!this.counts || !this.scale) return;
    const { left, top, width, height } = this.canvas.box;
    const { bars } = this.sizes;
    const most = Math.max(1, ...this.counts.counts.flatMap((each) => each.slice(0, bars)));
    this.canvas.xAxis(this.scale, this.quantity.factor, labelOf(this.quantity));
    this.canvas.yAxis(new Scale({ low: 0, high: most, knee: 0 }), 1, "trials");
    this.counts.counts.forEach((each, index) => {
      if (this.filter.hides(index)) return;
      const path = new Path2D();
      path.moveTo(left, top + height);
      for (let bar = 0; bar < bars; bar++) {
        const y = top + height * (1 - each[bar]! / most);
        path.lineTo(left + (bar / bars) * width, y);
        path.lineTo(left + ((bar + 1) / bars) * width, y);
      }
      path.lineTo(left + width, top + height);
      context.strokeStyle = context.fillStyle = lineColour(this.variants[index]!);
      context.globalAlpha = this.variants.length > 1 ? 0.12 : 0.35;
      context.fill(path);
      context.globalAlpha = 1;
      context.lineWidth = 1.3;
      context.stroke(path);
    });
    if (this.cursor !== null) {
      const x = left + ((this.cursor + 0.5) / bars) * width;
      this.canvas.line(x, top, x, top + height, "ink");
    }
    const range = this.filter.range(this.column);
    const span: Span | null = range ? { x: [range.first / this.sizes.bins, (range.last + 1) / this.sizes.bins], y: [0, 1] } : null;
    const marked: Span | null = this.canvas.marked && { x: this.canvas.marked.x, y: [0, 1] };
    if (marked ?? span) this.canvas.drawSpan((marked ?? span)!);
  }
}

// Black is drawn in the colour of texts, which is light on a dark page.
export function lineColour({ colour: named }: VariantEntry): string {
  return named === "#000000" ? colour("ink") : named;
}
