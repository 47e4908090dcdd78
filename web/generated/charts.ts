// Written by build_web.py from analysis/documents/interactive/charts.py.

// An axis: its ends as drawn, the first at the left or bottom, and its ticks with their labels.
//
// - ``label``: identifier of an abscissa shared by figures.
// - ``named``: True if tick labels are not numbers; ``bare``: True if there are no tick labels.
// - ``size``: text size of tick labels (pt).
// - ``grid``, ``marked``: True if ticks have grid lines, tick marks.
// - ``few``: indices of the ticks that a figure shows up to the width ``narrow`` (px), if not all.
export interface Axis {
  label?: string;
  ends: [number, number];
  logarithmic?: boolean;
  ticks?: [number, string][];
  named?: boolean;
  bare?: boolean;
  size: number;
  grid?: boolean;
  marked?: boolean;
  few?: number[];
  narrow?: number;
}

// A mark at points of a line: a circle of diameter ``size`` (pt), or the strokes ``outline`` in multiples of it.
//
// A stroke is a sequence x, y, x, y, ...; ``fill`` and ``edge`` are colours, empty for none.
export interface Marker {
  size: number;
  outline?: number[][];
  fill?: string;
  edge?: string;
  width: number;
}

// A line through ``x`` and ``factor`` * ``y``.
//
// - ``signal``: name of the signal, if it differs from ``name``.
// - ``time``: times (s), if the abscissa is another quantity.
// - ``metric``: metric of which the line is the distribution over the trials of a variant.
// - ``reduced``: True if the line is an envelope.
// - ``beyond``: True if marks are not clipped at the axes.
export interface Curve<Column = number> {
  x: Column;
  y: Column;
  factor: number;
  time?: Column;
  name?: string;
  signal?: string;
  unit?: string;
  colour: string;
  opacity: number;
  width: number;
  dashes?: number[];
  steps?: boolean;
  joined?: boolean;
  marker?: Marker;
  beyond?: boolean;
  reduced?: boolean;
  metric?: string;
}

// Marks of the successful or the failed trials of a variant, as a ``cross`` or a filled circle.
export interface Dots {
  variant: string;
  names: [string, string];
  success?: boolean;
  colour: string;
  size: number;
  cross?: boolean;
}

// A filled polygon, or strokes between points 1 and 2, 3 and 4, ...; coordinates are of the data or of the axes.
export interface Area<Column = number> {
  x: Column;
  y: Column;
  of_axes: [boolean, boolean];
  colour: string;
  opacity: number;
  stroke: number;
  dashes?: number[];
}

// A straight line across the axes at ``at``, an abscissa if ``upright``, else an ordinate.
export interface Rule {
  at: number;
  upright?: boolean;
  colour: string;
  width: number;
  dashes?: number[];
}

// The background of a text: a rectangle that extends beyond it by ``margin`` (pt).
export interface Backing {
  colour: string;
  opacity: number;
  margin: number;
}

// A text at a point with coordinates of the data or of the axes, ``offset`` (pt) to the right and up.
export interface ChartNote {
  text: string;
  at: [number, number];
  of_axes: [boolean, boolean];
  offset: [number, number];
  align: [string, string];
  colour: string;
  size: number;
  bold?: boolean;
  backing?: Backing;
}

// Margins of a figure of variable width: distances (px) of its axes from its left, top, right and bottom.
//
// ``point`` is the size of a pt in px. With ``to_scale`` the height follows the width, so the aspect ratio is
// constant.
export interface Fluid {
  margins: [number, number, number, number];
  point: number;
}

// A pair of axes with their content.
//
// ``box`` is the plotting area as left, top, width and height, in fractions of the figure; with ``fluid`` margins it
// applies to a figure on a wide screen. ``title`` is above the axes. A chart that is a ``picture`` has no data for the
// page's script, which only marks the cursor in it.
export interface Chart<Column = number> {
  x: Axis;
  y: Axis;
  title?: string;
  picture?: boolean;
  fluid?: Fluid;
  curves?: Curve<Column>[];
  dots?: Dots[];
  areas?: Area<Column>[];
  rules?: Rule[];
  notes?: ChartNote[];
}
