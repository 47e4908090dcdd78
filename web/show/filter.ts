// Which trials are selected: ranges of columns in bins, an outcome, variants.

import type { Query, Range } from "../generated/query";

export type Outcome = NonNullable<Query["outcome"]>;

export class Filter {
  outcome: Outcome = "all";
  private readonly byColumn = new Map<number, Range>();
  private hidden = new Set<number>(); // variants

  constructor(private readonly variants: number) {}

  get ranges(): Range[] {
    return [...this.byColumn.values()];
  }

  get isEmpty(): boolean {
    return this.byColumn.size === 0 && this.outcome === "all" && this.hidden.size === 0;
  }

  range(column: number): Range | undefined {
    return this.byColumn.get(column);
  }

  select(column: number, ends: [first: number, last: number] | null): void {
    if (ends) this.byColumn.set(column, { column, first: ends[0], last: ends[1] });
    else this.byColumn.delete(column);
  }

  hides(variant: number): boolean {
    return this.hidden.has(variant);
  }

  toggle(variant: number): void {
    if (!this.hidden.delete(variant)) this.hidden.add(variant);
  }

  reset(): void {
    this.byColumn.clear();
    this.hidden.clear();
    this.outcome = "all";
  }

  query(): Query {
    const shown = [...Array(this.variants).keys()].filter((each) => !this.hidden.has(each));
    return { ranges: this.ranges, outcome: this.outcome, variants: this.hidden.size ? shown : null };
  }
}
