// What the server says: analysis/show/page.py, counts.py and dots.py.

export interface Quantity {
  name: string;
  unit: string;
  factor: number; // from SI to the unit
  meaning: string;
}

export interface Variant {
  name: string;
  colour: string;
}

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

export interface Document {
  campaigns: Campaign[];
  bins: number;
  bars: number;
  figures: number; // histograms to begin with
  rows: number; // of the table
}

export interface ScaleData {
  low: number;
  high: number;
  knee: number;
}

export interface HistogramCounts {
  counts: number[][]; // by variant: bars, then nan, infinite, minus infinite
  scale: ScaleData | null;
}

export interface DotData {
  rows: string; // base64 of integers, as are the others
  x: string;
  y: string;
  success: string;
  variants: string;
}

export interface GridCounts {
  x: ScaleData | null;
  y: ScaleData | null;
  counts?: number[]; // of squares, rows from the bottom
  failures?: number[];
  dots?: DotData;
}

export interface RangeEnds {
  low: number; // included
  high: number; // not included
  step: number; // the least distance of another end from one of these
}

export interface Counts {
  outcomes: [failures: number, successes: number][]; // by variant
  ranges: (RangeEnds | null)[];
  histograms: HistogramCounts[];
  grids: GridCounts[];
}

export interface TrialEntry {
  row: number;
  trial: number;
  variant: string;
  success: boolean;
  status: string;
  command: string;
  numbers: (number | string | null)[];
}
