// Trials one by one, as analysis/show/dots.py encodes them.

import type { DotData } from "./document";

export interface Dots {
  rows: Uint32Array;
  x: Uint16Array; // bins
  y: Uint16Array;
  success: Uint8Array;
  variants: Uint16Array;
}

export function decodeDots(data: DotData): Dots {
  return {
    rows: new Uint32Array(bytes(data.rows).buffer),
    x: new Uint16Array(bytes(data.x).buffer),
    y: new Uint16Array(bytes(data.y).buffer),
    success: bytes(data.success),
    variants: new Uint16Array(bytes(data.variants).buffer),
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

function bytes(text: string): Uint8Array<ArrayBuffer> {
  return Uint8Array.from(atob(text), (character) => character.charCodeAt(0));
}
