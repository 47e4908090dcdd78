// An abscissa that several figures share: what of it is shown, and where the cursor is.

export type Range = [number, number];

export class SharedAxis {
  cursor: number | null = null;
  zoom: Range | null = null; // null: each figure as it was drawn
  private readonly followers: { onCursor: () => void; onZoom: () => void }[] = [];
  private whole: Range = [Infinity, -Infinity];

  constructor(readonly label: string, readonly logarithmic: boolean) {}

  get shown(): Range {
    return this.zoom ?? this.whole;
  }

  follow(ends: Range, onCursor: () => void, onZoom: () => void): void {
    this.whole = [Math.min(this.whole[0], ...ends), Math.max(this.whole[1], ...ends)];
    this.followers.push({ onCursor, onZoom });
  }

  moveCursor(to: number | null): void {
    this.cursor = to;
    if (to !== null && this.zoom && (to < this.zoom[0] || to > this.zoom[1])) this.pan((to - this.middle(0.5)) / this.length());
    for (const each of this.followers) each.onCursor();
  }

  setZoom(range: Range | null): void {
    this.zoom = range && range[1] > range[0] ? range : null;
    for (const each of this.followers) each.onZoom();
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
