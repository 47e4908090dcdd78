// Written by build_web.py from analysis/show/query.py.

// The rows of which a column is in the bins from ``first`` to ``last``.
export interface Range {
  column: number;
  first: number;
  last: number;
}

// Query of ``histograms`` and ``grids`` of columns, over the rows in all ranges, of the outcome and variants.
export interface Query {
  histograms?: number[];
  grids?: [number, number][];
  ranges?: Range[];
  outcome?: "all" | "success" | "failure";
  variants?: number[] | null;
}
