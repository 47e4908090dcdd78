// Written by build_web.py from analysis/show/documents.py.

// A column of a campaign; its numbers are in SI units, and ``factor`` converts them to ``unit``.
export interface QuantityEntry {
  name: string;
  unit: string;
  factor: number;
  meaning: string;
}

// A variant of a campaign with its colour.
export interface VariantEntry {
  name: string;
  colour: string;
}

// A campaign in a folder; ``flown`` is the number of trials available.
export interface CampaignEntry {
  folder: string;
  system: string;
  description: string;
  criterion: string;
  trials: number;
  flown: number;
  variants: VariantEntry[];
  quantities: QuantityEntry[];
}

// Campaigns, and the numbers of bins per column, of bars per histogram and of initial histograms.
export interface ShowDocument {
  campaigns: CampaignEntry[];
  bins: number;
  bars: number;
  figures: number;
}

// Scale over a range of numbers: linear if the knee is 0, else linear in asinh(x / knee).
export interface ScaleDocument {
  low: number;
  high: number;
  knee: number;
}

// Numbers of trials of each variant: in each bar, then with NaN, infinity and minus infinity.
export interface HistogramCounts {
  counts: number[][];
  scale: ScaleDocument | null;
}

// Individual trials: row numbers, bins, outcomes and variants as little-endian integers in base64.
export interface DotsDocument {
  rows: string;
  x: string;
  y: string;
  success: string;
  variants: string;
}

// Trials over two columns: trials and failures per square, in rows from the bottom, or dots if they are few.
export interface GridCounts {
  x: ScaleDocument | null;
  y: ScaleDocument | null;
  counts?: number[];
  failures?: number[];
  dots?: DotsDocument;
}

// The ends of a range in SI: ``low`` inclusive, ``high`` exclusive; ``step`` is the least distance between ends.
export interface RangeEnds {
  low: number;
  high: number;
  step: number;
}

// The answer to a query; ``outcomes`` are the failures and successes of each variant.
export interface Counts {
  outcomes: [number, number][];
  ranges: (RangeEnds | null)[];
  histograms: HistogramCounts[];
  grids: GridCounts[];
}

// A trial, the command that repeats it, and its numbers: NaN is null, and an infinite number is a text.
export interface TrialEntry {
  row: number;
  trial: number;
  variant: string;
  success: boolean;
  status: string;
  command: string;
  numbers: (number | string | null)[];
}
