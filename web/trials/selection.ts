// The trials that a brush has chosen, and the one under the cursor: shared by all figures of a page.

import type { Variant } from "./trials";

export interface Trial {
  variant: Variant;
  row: number;
}

export class Selection {
  source: object | null = null; // the plot whose brush has chosen
  private chosen: Map<Variant, Set<number>> | null = null; // null: all
  private readonly followers: (() => void)[] = [];

  follow(onChange: () => void): void {
    this.followers.push(onChange);
  }

  choose(trials: Trial[] | null, source: object | null = null): void {
    this.source = source;
    this.chosen = trials && new Map();
    for (const { variant, row } of trials ?? []) {
      const rows = this.chosen!.get(variant) ?? new Set();
      this.chosen!.set(variant, rows.add(row));
    }
    for (const each of this.followers) each();
  }

  get isWhole(): boolean {
    return this.chosen === null;
  }

  // The variants with chosen trials, and the rows of these in ascending order.
  get variants(): [variant: Variant, rows: number[]][] {
    return [...(this.chosen ?? [])].map(([variant, rows]) => [variant, [...rows].sort((one, other) => one - other)]);
  }

  has(variant: Variant, row: number): boolean {
    return this.chosen === null || (this.chosen.get(variant)?.has(row) ?? false);
  }

  rows(variant: Variant): Iterable<number> {
    return this.chosen?.get(variant) ?? [];
  }
}
