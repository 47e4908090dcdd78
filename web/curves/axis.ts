// An abscissa that several figures share: what of it is shown, and where the cursor is.

export type Range = [number, number];

export class SharedAxis {
  cursor: number | null = null;
  mark: number | null = null; // the second cursor
  hasStatistics = false; // of the range that is shown, next to the values at the cursor
  zoom: Range | null = null; // null: each figure as it was drawn
  private readonly onCursor: (() => void)[] = [];
  private readonly onZoom: (() => void)[] = [];
  private whole: Range = [Infinity, -Infinity];

  constructor(readonly label: string, readonly logarithmic: boolean) {}

  get shown(): Range {
    return this.zoom ?? this.whole;
  }

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
    if (this.zoom && (at < this.zoom[0] || at > this.zoom[1])) this.pan((at - this.middle(0.5)) / this.length());
    this.moveCursor(at);
  }

  setZoom(range: Range | null): void {
    this.zoom = range && range[1] > range[0] ? range : null;
    for (const call of this.onZoom) call();
  }

  // Zooms by a factor, below 1: nearer; what is at ``about`` remains where it is.
  zoomBy(factor: number, about: number | null): void {
    const [low, high] = this.shown.map((end) => this.forth(end)) as Range;
    const fixed = about === null ? (low + high) / 2 : this.forth(about);
    const ends: Range = [fixed + (low - fixed) * factor, fixed + (high - fixed) * factor];
    const [least, greatest] = this.whole.map((end) => this.forth(end)) as Range;
    if (ends[1] - ends[0] >= greatest - least) this.setZoom(null);
    else if (ends[1] - ends[0] > 1e-9 * (greatest - least)) this.setZoom(this.fit(ends));
  }

  // Moves what is shown by a fraction of its length.
  pan(fraction: number): void {
    if (!this.zoom) return;
    const [low, high] = this.zoom.map((end) => this.forth(end)) as Range;
    this.setZoom(this.fit([low + fraction * (high - low), high + fraction * (high - low)]));
  }

  private fit(ends: Range): Range {
    const [least, greatest] = this.whole.map((end) => this.forth(end)) as Range;
    const shift = Math.max(least - ends[0], 0) || Math.min(greatest - ends[1], 0);
    return [this.back(ends[0] + shift), this.back(ends[1] + shift)];
  }

  private middle(fraction: number): number {
    return this.shown[0] + fraction * this.length();
  }

  private length(): number {
    return this.shown[1] - this.shown[0];
  }

  private forth(value: number): number {
    return this.logarithmic ? Math.log10(value) : value;
  }

  private back(value: number): number {
    return this.logarithmic ? 10 ** value : value;
  }
}
