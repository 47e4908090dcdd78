// Written by build_web.py from analysis/documents/interactive/charts.py.

// An axis: its ends as drawn, the first at the left or the bottom, and its ticks in between with their texts.
//
// ``label`` is what figures that share an abscissa have in common; ``named`` where texts are no numbers, ``bare``
// where ticks have none; ``size`` (pt) is that of the texts; ``grid`` and ``marked`` where ticks have lines, strokes;
// ``few`` are the numbers of those ticks that a figure has up to the width ``narrow`` (px), where it has not all.
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

// A mark at points of a line: a circle of diameter ``size`` (pt), or the strokes ``outline`` in units of it.
//
// A stroke is abscissas and ordinates in turn. ``fill`` and ``edge`` are colours, empty where nothing is drawn.
export interface Marker {
  size: number;
  outline?: number[][];
  fill?: string;
  edge?: string;
  width: number;
}

// A line; ``signal`` where its ``name`` is not that of the signal; ``time`` (s) where its abscissa is another
// quantity; ``reduced`` where it is the envelope of its rows;
// ``metric`` where it is the distribution of that over the trials of a variant; ``beyond`` where marks reach beyond
// the area of the axes.
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

// Marks of trials, `TrialDots`; ``cross`` or a filled circle.
export interface Dots {
  variant: string;
  names: [string, string];
  success?: boolean;
  colour: string;
  size: number;
  cross?: boolean;
}

// A filled polygon, or strokes from each second point to the next; a coordinate is of the data or of the axes.
export interface Area<Column = number> {
  x: Column;
  y: Column;
  of_axes: [boolean, boolean];
  colour: string;
  opacity: number;
  stroke: number;
  dashes?: number[];
}

// A straight line across the axes, at ``at`` of the abscissa (``upright``) or of the ordinate.
export interface Rule {
  at: number;
  upright?: boolean;
  colour: string;
  width: number;
  dashes?: number[];
}

// The background of a text: a rectangle that is larger by ``margin`` (pt) on each side.
export interface Backing {
  colour: string;
  opacity: number;
  margin: number;
}

// A text at a point, each coordinate of the data or of the axes, ``offset`` (pt) from it to the right and up.
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

// A figure of any width: its axes keep their distances (px) from its left, top, right and bottom.
//
// ``point``: px of a pt. ``to_scale``: its height follows its width, so that the axes keep the ratio of their lengths.
export interface Fluid {
  margins: [number, number, number, number];
  point: number;
}

// A pair of axes; ``box`` is left, top, width and height of their area as fractions of the figure.
//
// With ``fluid`` margins they are those of a figure as wide as on a wide screen. The ``title`` stands above the axes.
//
// A ``picture`` is one of a figure that is not stated in full: the page's script marks the cursor in it.
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
