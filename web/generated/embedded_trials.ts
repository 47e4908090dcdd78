// Written by build_web.py from analysis/documents/of/batch/embedded_trials.py.

// A metric or sampled input, by column name; its numbers are in SI, and ``factor`` converts them to ``unit``.
export interface TrialQuantity {
  name: string;
  unit: string;
  factor: number;
}

// The trials of a variant as columns.
//
// ``command`` is the text before and after a trial's number in its replay command. ``status`` are indices of
// ``statuses``. ``exact`` contains numbers by row; non-finite ones are texts.
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

// The trials of a batch, and the quantities for which each variant has a column.
export interface TrialsDocument<Column = number> {
  quantities: TrialQuantity[];
  variants: VariantTrials<Column>[];
}
