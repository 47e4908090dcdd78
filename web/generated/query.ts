// Written by build_web.py from analysis/show/query.py.

// Rows whose value in a column is in the bins ``first`` to ``last``, both included.
export interface Range {
  column: number;
  first: number;
  last: number;
}

// Query for ``histograms`` and ``grids`` of columns, over the rows that match all ranges, outcome and variants.
export interface Query {
  histograms?: number[];
  grids?: [number, number][];
  ranges?: Range[];
  outcome?: "all" | "success" | "failure";
  variants?: number[] | null;
}
