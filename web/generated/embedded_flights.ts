// Written by build_web.py from analysis/documents/of/batch/embedded_flights.py.

// A signal in a panel, and its colour.
export interface PanelLine {
  name: string;
  colour: string;
}

// A panel over time; numbers are in SI, times ``factor`` in ``unit``.
export interface FlightsPanel {
  title: string;
  unit: string;
  factor: number;
  steps: boolean;
  lines: PanelLine[];
}

// A recorded trial: its time (s), and a column for each line of the panels.
export interface FlightColumns<Column = number> {
  variant: string;
  trial: number;
  time: Column;
  columns: Column[];
}

// Recorded flights over time.
export interface RecordedDocument<Column = number> {
  panels: FlightsPanel[];
  flights: FlightColumns<Column>[];
}
