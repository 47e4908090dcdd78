// Written by build_web.py from analysis/documents/interactive/columns.py.

// Description of a column; without a range its numbers are float32.
export interface Encoded {
  low?: number;
  high?: number;
  knee?: number;
  rows: number;
}
