// Written by build_web.py from analysis/show/documents.py.

// A column of a campaign; numbers are in SI, times ``factor`` in ``unit``.
export interface Quantity {
  name: string;
  unit: string;
  factor: number;
  meaning: string;
}

// A variant of a campaign, and its colour.
export interface Variant {
  name: string;
  colour: string;
}

// A campaign in a folder; ``flown`` of its trials are there.
export interface Campaign {
  folder: string;
  system: string;
  description: string;
  criterion: string;
  trials: number;
  flown: number;
  variants: Variant[];
  quantities: Quantity[];
}

// Campaigns, and sizes: bins of a column, bars of a histogram, histograms at first.
export interface ShowDocument {
  campaigns: Campaign[];
  bins: number;
  bars: number;
  figures: number;
}

// A range of numbers; of asinh(x / knee) unless the knee is 0.
export interface ScaleDocument {
  low: number;
  high: number;
  knee: number;
}

// Counts by variant: of the bars, then of nan, infinity and minus infinity.
export interface HistogramCounts {
  counts: number[][];
  scale: ScaleDocument | null;
}

// Trials one by one: row numbers, bins, outcomes and variants as little-endian integers in base64.
export interface DotsDocument {
  rows: string;
  x: string;
  y: string;
  success: string;
  variants: string;
}

// Trials over two columns: counts and failures of squares, rows from the bottom; or dots of few trials.
export interface GridCounts {
  x: ScaleDocument | null;
  y: ScaleDocument | null;
  counts?: number[];
  failures?: number[];
  dots?: DotsDocument;
}

// The ends of a range in SI, ``low`` included, ``high`` not; ``step`` is the least distance to another end.
export interface RangeEnds {
  low: number;
  high: number;
  step: number;
}

// The answer to a query; ``outcomes`` are failures and successes of each variant.
export interface Counts {
  outcomes: [number, number][];
  ranges: (RangeEnds | null)[];
  histograms: HistogramCounts[];
  grids: GridCounts[];
}

// A trial, the command that simulates it again, and numbers: null is nan, a text infinite.
export interface TrialEntry {
  row: number;
  trial: number;
  variant: string;
  success: boolean;
  status: string;
  command: string;
  numbers: (number | string | null)[];
}
