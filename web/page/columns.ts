// Columns of numbers inside a page: the inverse of analysis/documents/interactive/columns.py.

import type { Encoded } from "../generated/columns";
import type { PageDocument } from "../generated/page_types";

const STEPS = 65534; // of the range of a column in 16 bits; the number above is nan

const inflated = new WeakMap<PageDocument, Promise<Uint8Array>[]>();

// A column by its number; the first one of a kind takes the time that all of it take.
export async function decode(page: PageDocument, number: number): Promise<Float32Array | Float64Array> {
  const column = page.columns[number]!;
  const size = sizeOf(column);
  const kinds = inflated.get(page) ?? [];
  inflated.set(page, kinds);
  const kind = size === 4 ? 0 : 1;
  const bytes = await (kinds[kind] ??= inflate(page.packed[kind]));
  const before = page.columns.slice(0, number).reduce((sum, each) => sum + (sizeOf(each) === size ? size * each.rows : 0), 0);
  const numbers = integrate(ungroup(bytes.subarray(before), column.rows, size), 8 * size);
  return size === 4 ? floats(numbers as Uint32Array) : spread(numbers, column);
}

function sizeOf(column: Encoded): 2 | 4 {
  return column.low === undefined ? 4 : 2;
}

// Half the distance between neighbours of a number in its column: how far it may be from what it was.
export function uncertainty({ low, high, knee }: Encoded, number: number): number {
  if (low === undefined || high === undefined) return 2 ** -25 * Math.abs(number);
  if (!knee && (number === low || number === high)) return 0;
  const step = (high - low) / STEPS / 2;
  return knee ? step * Math.hypot(number, knee) : step;
}

async function inflate(text: string): Promise<Uint8Array> {
  const packed = fromBase64(text);
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

// Browsers of before 2025 have no function of their own for it, which is ten times as quick.
export function fromBase64(text: string): Uint8Array<ArrayBuffer> {
  return Uint8Array.fromBase64?.(text) ?? Uint8Array.from(atob(text), (character) => character.charCodeAt(0));
}

function ungroup(bytes: Uint8Array, rows: number, size: number): Uint16Array | Uint32Array {
  const numbers = size === 4 ? new Uint32Array(rows) : new Uint16Array(rows);
  for (let byte = 0; byte < size; byte++) {
    for (let row = 0; row < rows; row++) numbers[row]! |= bytes[byte * rows + row]! << (8 * byte);
  }
  return numbers;
}

// Unfolds the signs and adds the second differences up twice, modulo the size of a number, as typed arrays do.
function integrate<T extends Uint16Array | Uint32Array>(numbers: T, bits: number): T {
  for (let row = 0; row < numbers.length; row++) {
    const folded = numbers[row]!;
    numbers[row] = (folded >>> 1) ^ -(folded & 1);
    if (bits === 16) numbers[row]! &= 0xffff;
  }
  for (let pass = 0; pass < 2; pass++) {
    for (let row = 1; row < numbers.length; row++) numbers[row]! += numbers[row - 1]!;
  }
  return numbers;
}

function floats(ordered: Uint32Array): Float32Array {
  for (let row = 0; row < ordered.length; row++) {
    const number = ordered[row]!;
    ordered[row] = number >>> 31 ? number & 0x7fffffff : ~number;
  }
  return new Float32Array(ordered.buffer);
}

function spread(steps: Uint16Array | Uint32Array, { low = 0, high = 0, knee = 0 }: Encoded): Float64Array {
  return Float64Array.from(steps, (step) => {
    if (step > STEPS) return NaN;
    const bent = low + (step * (high - low)) / STEPS;
    return knee ? knee * Math.sinh(bent) : bent;
  });
}
