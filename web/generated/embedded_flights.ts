// Written by build_web.py from analysis/documents/of/batch/embedded_flights.py.

// A signal in a panel, with its colour.
export interface PanelLine {
  name: string;
  colour: string;
}

// A panel over time; its numbers are in SI units, and ``factor`` converts them to ``unit``.
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

// Recorded simulations over time: panels with lines, and the columns of each simulation.
export interface RecordedDocument<Column = number> {
  panels: FlightsPanel[];
  flights: FlightColumns<Column>[];
}
