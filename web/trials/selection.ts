// The trials that a brush has chosen: shared by all figures of a page.

import type { Variant } from "./trials";

export interface Trial {
  variant: Variant;
  row: number;
}

export class Selection {
  source: object | null = null; // the plot whose brush has chosen
  private chosen: Map<Variant, number[]> | null = null; // rows in ascending order; null: all
  private readonly marks = new Map<Variant, Uint8Array>(); // 1 for each chosen row
  private readonly followers: (() => void)[] = [];

  follow(onChange: () => void): void {
    this.followers.push(onChange);
  }

  choose(trials: [variant: Variant, rows: number[]][] | null, source: object | null = null): void {
    this.source = source;
    this.marks.clear();
    for (const [variant, rows] of trials ?? []) {
      const marks = this.marks.get(variant) ?? new Uint8Array(variant.numbers.length);
      for (const row of rows) marks[row] = 1;
      if (rows.length) this.marks.set(variant, marks);
    }
    const rowsOf = (marks: Uint8Array) => [...marks.keys()].filter((row) => marks[row]);
    this.chosen = trials && new Map([...this.marks].map(([variant, marks]) => [variant, rowsOf(marks)]));
    for (const each of this.followers) each();
  }

  get isWhole(): boolean {
    return this.chosen === null;
  }

  // The variants with chosen trials, and the rows of these in ascending order.
  get variants(): [variant: Variant, rows: number[]][] {
    return [...(this.chosen ?? [])];
  }

  has(variant: Variant, row: number): boolean {
    return this.chosen === null || this.marks.get(variant)?.[row] === 1;
  }

  // The rows of a variant that a brush has chosen.
  rows(variant: Variant): number[] {
    return this.chosen?.get(variant) ?? [];
  }
}
