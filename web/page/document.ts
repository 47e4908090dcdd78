// The document inside a page: analysis/reports/interactive/embedded.py.

import { type Encoded, type Packed, decode } from "./columns";

export interface Axis {
  label?: string;
  ends: [number, number]; // the first at the left or the bottom
  logarithmic?: boolean;
  ticks?: [at: number, text: string][]; // as drawn; without them numbers of the script's own
  named?: boolean; // the texts of ticks are no numbers
  bare?: boolean; // ticks have no texts
  size: number; // pt, of the texts
  grid?: boolean;
  marked?: boolean; // ticks have strokes
}

export interface Marker {
  size: number; // pt
  outline?: number[][]; // strokes, in units of the size; without them a circle
  fill?: string;
  edge?: string;
  width: number; // pt
}

export interface Curve {
  x: number; // of a column, as are y and time
  y: number; // in SI; as displayed times the factor
  factor: number;
  time?: number;
  name?: string;
  unit?: string;
  colour: string;
  opacity: number;
  width: number;
  dashes?: number[];
  steps?: boolean;
  joined?: boolean;
  marker?: Marker;
  beyond?: boolean; // marks reach beyond the area
  reduced?: boolean;
  metric?: string;
}

export interface Dots {
  variant: string;
  names: [x: string, y: string];
  success?: boolean;
  colour: string;
  size: number;
  cross?: boolean;
}

export interface Area {
  x: number;
  y: number;
  of_axes: [boolean, boolean];
  colour: string;
  opacity: number;
  stroke: number;
  dashes?: number[];
}

export interface Rule {
  at: number;
  upright?: boolean;
  colour: string;
  width: number;
  dashes?: number[];
}

export interface Note {
  text: string;
  at: [number, number];
  of_axes: [boolean, boolean];
  offset: [number, number];
  align: [string, string];
  colour: string;
  size: number; // pt
  bold?: boolean;
  backing?: { colour: string; opacity: number; margin: number };
}

export interface Chart {
  box: [number, number, number, number];
  x: Axis;
  y: Axis;
  picture?: boolean; // of a figure that remains one
  curves?: Curve[];
  dots?: Dots[];
  areas?: Area[];
  rules?: Rule[];
  notes?: Note[];
}

export type Values = Float32Array | Float64Array;

export class Page {
  readonly figures: Chart[][];
  readonly encoded: Encoded[];
  private readonly decoded = new Map<number, Promise<Values>>();

  constructor(readonly document: Packed & { figures: Chart[][] } & Record<string, unknown>) {
    this.encoded = document.columns;
    this.figures = document.figures;
  }

  // A column by its number, decoded once.
  column(number: number): Promise<Values> {
    let values = this.decoded.get(number);
    if (!values) {
      values = decode(this.document, number);
      this.decoded.set(number, values);
    }
    return values;
  }
}

const SHARED = Symbol.for("perilune.page");

// One for all scripts of a page, each of which has a copy of this module.
export function readPage(): Page | null {
  const shared = globalThis as { [SHARED]?: Page };
  const element = document.getElementById("page-data");
  return element && (shared[SHARED] ??= new Page(JSON.parse(element.textContent ?? "")));
}
