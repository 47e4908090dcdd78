// An abscissa that several figures share: what of it is shown, and where the cursor is.

import { type Range, Scale } from "../chart/frame";

export class SharedAxis {
  cursor: number | null = null;
  mark: number | null = null; // the second cursor
  hasStatistics = false; // of the range that is shown, next to the values at the cursor
  zoom: Range | null = null; // null: each figure as it was drawn
  private readonly onCursor: (() => void)[] = [];
  private readonly onZoom: (() => void)[] = [];
  private whole: Range = [Infinity, -Infinity];

  constructor(readonly label: string, readonly logarithmic: boolean) {}

  followCursor(call: () => void): void {
    this.onCursor.push(call);
  }

  // ``ends``: what a figure shows of the axis as drawn.
  followZoom(ends: Range, call: () => void): void {
    this.whole = [Math.min(this.whole[0], ends[0]), Math.max(this.whole[1], ends[1])];
    this.onZoom.push(call);
  }

  moveCursor(to: number | null): void {
    this.cursor = to;
    for (const call of this.onCursor) call();
  }

  // Leaves the second cursor where the first one is, or removes it from there.
  setMark(): void {
    this.mark = this.mark === this.cursor ? null : this.cursor;
    this.moveCursor(this.cursor);
  }

  clearMark(): void {
    this.mark = null;
    this.moveCursor(null);
  }

  toggleStatistics(): void {
    this.hasStatistics = !this.hasStatistics;
    this.moveCursor(this.cursor);
  }

  // Name and unit of the quantity.
  get quantity(): { name: string; unit: string } {
    const [, name = this.label, unit = ""] = /^(.*), ([^,]*)$/.exec(this.label) ?? [];
    return { name, unit };
  }

  // Moves the cursor, and what is shown to it.
  goTo(at: number): void {
    if (this.zoom && (at < this.zoom[0] || at > this.zoom[1])) this.pan(this.shown.place(at) - 0.5);
    this.moveCursor(at);
  }

  setZoom(range: Range | null): void {
    this.zoom = range && range[1] > range[0] ? range : null;
    for (const call of this.onZoom) call();
  }

  // Zooms by a factor, below 1: nearer; what is at ``about`` remains where it is.
  zoomBy(factor: number, about: number | null): void {
    const fixed = about === null ? 0.5 : this.shown.place(about);
    this.show(fixed * (1 - factor), factor);
  }

  // Moves what is shown by a fraction of its length.
  pan(fraction: number): void {
    if (this.zoom) this.show(fraction, 1);
  }

  // Shows a range within the whole, its begin and length in lengths of what is shown.
  private show(begin: number, length: number): void {
    const shown = this.shown;
    const [least, greatest] = this.whole.map((end) => shown.place(end)) as Range;
    const first = Math.min(Math.max(begin, least), greatest - length);
    if (length >= greatest - least) this.setZoom(null);
    else if (length > 1e-9 * (greatest - least)) this.setZoom([shown.value(first), shown.value(first + length)]);
  }

  private get shown(): Scale {
    return new Scale(this.logarithmic, this.zoom ?? this.whole, 0, 1);
  }
}
