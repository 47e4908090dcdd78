// Where an axis has its ticks between two ends: round numbers, of which there are never more than a few.
//
// They are multiples of a step: adding it until an end is passed never ends where the sum is rounded back.

const STEPS = [1, 2, 2.5, 5, 10];
const SLACK = 1e-9; // of a step, by which an end may miss a multiple

// Multiples of a round step, about ``most`` of them; both ends where they are too near to each other for any.
export function linearSplits(low: number, high: number, most: number): number[] {
  const rough = (high - low) / Math.max(most, 1);
  if (!(rough > 0) || !Number.isFinite(rough)) return [];
  const power = Math.floor(Math.log10(rough));
  const factor = STEPS.find((each) => each * 10 ** power >= rough * (1 - SLACK)) ?? 10;
  const multiple = (index: number) => (power < 0 ? (index * factor) / 10 ** -power : index * factor * 10 ** power);
  const step = multiple(1);
  const first = Math.ceil(low / step - SLACK);
  const last = Math.floor(high / step + SLACK);
  if (!Number.isSafeInteger(first) || !Number.isSafeInteger(last) || last - first > most + 1) return [low, high];
  return within(Array.from({ length: Math.max(last - first + 1, 0) }, (_, index) => multiple(first + index)), low, high);
}

// Powers of ten, with 2 and 5 times them or all whole multiples where a zoom has few.
export function logarithmicSplits(low: number, high: number, most: number): number[] {
  if (!(low > 0) || !(high > low) || !Number.isFinite(high)) return [];
  const first = Math.floor(Math.log10(low));
  const last = Math.ceil(Math.log10(high));
  const stride = Math.max(1, Math.ceil((last - first - 1) / Math.max(most, 1)));
  for (const multiples of [[1], [1, 2, 5], [1, 2, 3, 4, 5, 6, 7, 8, 9]]) {
    const all: number[] = [];
    for (let power = first; power <= last; power++) {
      if (power % stride === 0) all.push(...multiples.map((each) => Number(`${each}e${power}`)).filter((at) => at > 0));
    }
    const inside = within(all, low, high);
    if (inside.length > 2 || stride > 1) return inside;
  }
  return linearSplits(low, high, most);
}

function within(all: number[], low: number, high: number): number[] {
  const slack = SLACK * (high - low);
  return all.filter((at, index) => at >= low - slack && at <= high + slack && (index === 0 || at > all[index - 1]!));
}
