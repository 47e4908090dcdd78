// The document inside a page: analysis/reports/interactive/embedded.py.

import { type Encoded, type Packed, decode } from "./columns";

export interface Axis {
  label?: string;
  ends: [number, number];
  logarithmic?: boolean;
  ticks?: [number, string][];
}

export interface Curve {
  x: number; // of a column, as are y and time
  y: number; // in SI; as displayed times the factor
  factor: number;
  time?: number;
  name?: string;
  unit?: string;
  colour: string;
  width: number;
  dashes?: number[];
  steps?: boolean;
  joined?: boolean;
  marker: number;
  filled?: boolean;
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
  of_axes?: boolean;
  offset: [number, number];
  align: [string, string];
  colour: string;
  bold?: boolean;
}

export interface Chart {
  box: [number, number, number, number];
  title?: string;
  aside?: string;
  x: Axis;
  y: Axis;
  equal?: boolean;
  curves?: Curve[];
  dots?: Dots[];
  areas?: Area[];
  rules?: Rule[];
  notes?: Note[];
}

export type Values = Float32Array | Float64Array;

export class Page {
  readonly figures: (Chart | null)[][];
  readonly encoded: Encoded[];
  private readonly decoded = new Map<number, Promise<Values>>();

  constructor(readonly document: Packed & { figures: (Chart | null)[][] } & Record<string, unknown>) {
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
