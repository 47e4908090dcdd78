// The document inside a page, its columns decoded once each.

import type { Chart } from "../generated/charts";
import type { Encoded } from "../generated/columns";
import type { PageDocument } from "../generated/page_types";
import { decode } from "./columns";

export type Values = Float32Array | Float64Array;

export class Page {
  readonly figures: Chart[][];
  readonly encoded: Encoded[];
  private readonly decoded = new Map<number, Promise<Values>>();

  constructor(readonly document: PageDocument) {
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
