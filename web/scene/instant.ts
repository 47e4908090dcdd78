// Values of columns at any time: between samples positions are on straight lines, attitudes on the shortest turn.

import { Quaternion, type Vector3 } from "three";
import type { Values } from "../page/document";

export interface Instant {
  time: number; // s
  row: number; // of the sample at this time or before it
  fraction: number; // of the way to the next sample
}

export function instantAt(times: Values, time: number): Instant {
  let low = 0;
  let high = times.length - 1;
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (times[middle]! <= time) low = middle;
    else high = middle - 1;
  }
  if (low + 1 >= times.length) return { time, row: low, fraction: 0 };
  const fraction = (time - times[low]!) / (times[low + 1]! - times[low]!);
  return { time, row: low, fraction: Math.min(Math.max(fraction, 0), 1) };
}

export function nearestRow(instant: Instant): number {
  return instant.fraction > 0.5 ? instant.row + 1 : instant.row;
}

export function scalarAt(values: Values, { row, fraction }: Instant): number {
  const first = values[row]!;
  return fraction === 0 ? first : first + fraction * (values[row + 1]! - first);
}

// Whether all coordinates are finite.
export function positionAt(columns: Values[], instant: Instant, result: Vector3): boolean {
  result.set(scalarAt(columns[0]!, instant), scalarAt(columns[1]!, instant), scalarAt(columns[2]!, instant));
  return Number.isFinite(result.x + result.y + result.z);
}

// The same at a sample.
export function sampleAt(columns: Values[], row: number, result: Vector3): boolean {
  result.set(columns[0]![row]!, columns[1]![row]!, columns[2]![row]!);
  return Number.isFinite(result.x + result.y + result.z);
}

const next = new Quaternion();

// Whether the attitude is known. Columns are scalar first, three's quaternions scalar last.
export function attitudeAt(columns: Values[], { row, fraction }: Instant, result: Quaternion): boolean {
  if (!columns.length) return false;
  const read = (into: Quaternion, at: number) =>
    into.set(columns[1]![at]!, columns[2]![at]!, columns[3]![at]!, columns[0]![at]!);
  read(result, row);
  if (fraction > 0) result.slerp(read(next, row + 1), fraction);
  return Number.isFinite(result.x + result.y + result.z + result.w);
}
