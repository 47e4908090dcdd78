// Columns of numbers inside a page: the inverse of analysis/reports/interactive/columns.py.

export interface Encoded {
  rows: number;
  data: string;
  low?: number; // of the range of a column in 16 bits; of asinh(x / knee) unless the knee is 0
  high?: number;
  knee?: number;
}

const STEPS = 65534; // of such a range; the number above is nan

export async function decode(column: Encoded): Promise<Float32Array | Float64Array> {
  const bytes = await inflate(column.data);
  const size = column.low === undefined ? 4 : 2;
  const numbers = integrate(ungroup(bytes, column.rows, size), 8 * size);
  return size === 4 ? floats(numbers as Uint32Array) : spread(numbers, column);
}

// Half the distance between neighbours of a number in its column: how far it may be from what it was.
export function uncertainty({ low, high, knee }: Encoded, number: number): number {
  if (low === undefined || high === undefined) return 2 ** -25 * Math.abs(number);
  if (!knee && (number === low || number === high)) return 0;
  const step = (high - low) / STEPS / 2;
  return knee ? step * Math.hypot(number, knee) : step;
}

async function inflate(text: string): Promise<Uint8Array> {
  const characters = atob(text);
  const packed = new Uint8Array(characters.length);
  for (let index = 0; index < packed.length; index++) packed[index] = characters.charCodeAt(index);
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
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
