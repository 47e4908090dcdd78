// Trials one by one, as analysis/show/dots.py encodes them.

import { fromBase64 } from "../page/columns";
import type { DotsDocument } from "../generated/documents";

export interface Dots {
  rows: Uint32Array;
  x: Uint16Array; // bins
  y: Uint16Array;
  success: Uint8Array;
  variants: Uint16Array;
}

export function decodeDots(data: DotsDocument): Dots {
  return {
    rows: new Uint32Array(fromBase64(data.rows).buffer),
    x: new Uint16Array(fromBase64(data.x).buffer),
    y: new Uint16Array(fromBase64(data.y).buffer),
    success: fromBase64(data.success),
    variants: new Uint16Array(fromBase64(data.variants).buffer),
  };
}

// The dot nearest to a point, in bins; -1 where none is within the distance.
export function nearestDot({ x, y }: Dots, at: { x: number; y: number }, unit: { x: number; y: number }, within: number): number {
  let [best, nearest] = [within ** 2, -1];
  for (let dot = 0; dot < x.length; dot++) {
    const distance = ((x[dot]! + 0.5 - at.x) * unit.x) ** 2 + ((y[dot]! + 0.5 - at.y) * unit.y) ** 2;
    if (distance <= best) [best, nearest] = [distance, dot];
  }
  return nearest;
}
