// Written by build_web.py from analysis/documents/of/batch/embedded_trials.py.

// A metric or a draw by the name of its column; numbers are in SI, times ``factor`` in ``unit``.
export interface TrialQuantity {
  name: string;
  unit: string;
  factor: number;
}

// The trials of a variant: columns, by ``command`` what is before and after a trial's number in its replay command.
//
// ``status`` are indices of ``statuses``; ``exact`` has numbers by row, a text where one is not finite.
export interface VariantTrials<Column = number> {
  name: string;
  command: [string, string];
  trial: Column;
  success: Column;
  statuses: string[];
  status: Column;
  columns: Column[];
  exact: Record<string, (number | string)[]>;
}

// The trials of a batch, and the quantities that each variant has a column of.
export interface TrialsDocument<Column = number> {
  quantities: TrialQuantity[];
  variants: VariantTrials<Column>[];
}
