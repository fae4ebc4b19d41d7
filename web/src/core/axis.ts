// Scales of false colour: round limits and round numbers, as pictures of the command line have them.

/** The share of values that automatic limits may leave outside at either end. */
const OUTSIDE = 0.005;
/** Automatic logarithmic limits span at most this ratio. */
const WIDEST_RATIO = 1e4;
const MOST_TICKS = 10;
const ROUNDING = 1e-9;
const EVENLY_DIVIDED = [1, 1.5, 2, 2.5, 3, 4, 5, 6, 8];
const LABELLED = [1, 2, 5];

export interface Limits {
  low: number;
  high: number;
}

/** Round limits that hold all but the outermost half per cent of the values; they are sorted in place. A linear scale begins at zero. */
export function roundLimits(values: Float64Array, logarithmic: boolean): Limits {
  values.sort();
  const from = logarithmic ? values.findIndex((v) => v > 0) : 0;
  const known = from < 0 ? values.subarray(0, 0) : values.subarray(from);
  if (known.length === 0) return logarithmic ? { low: 1, high: 10 } : { low: 0, high: 1 };
  const outside = Math.floor(OUTSIDE * known.length);
  let [low, high] = [known[outside]!, known[known.length - 1 - outside]!];
  if (!(low < high)) [low, high] = [known[0]!, known[known.length - 1]!];
  if (!logarithmic) return { low: 0, high: high > 0 ? roundUp(high, EVENLY_DIVIDED) : 1 };
  const top = roundUp(high, LABELLED);
  const bottom = roundDown(Math.max(low, top / WIDEST_RATIO));
  return { low: bottom, high: top > bottom ? top : 10 * bottom };
}

const decadeOf = (value: number): number => 10 ** Math.floor(Math.log10(value));

/** The least of the leading digits times a power of ten that is not below the value. */
export function roundUp(value: number, digits: number[] = EVENLY_DIVIDED): number {
  const decade = decadeOf(value);
  const found = digits.map((d) => d * decade).find((v) => v >= value * (1 - ROUNDING));
  return found ?? 10 * decade;
}

function roundDown(value: number): number {
  const decade = decadeOf(value);
  return LABELLED.map((d) => d * decade).findLast((v) => v <= value * (1 + ROUNDING)) ?? decade;
}

/** Round numbers from the lower to the upper limit. */
export function ticksOf({ low, high }: Limits, logarithmic: boolean): number[] {
  return logarithmic ? logarithmicTicks(low, high) : linearTicks(low, high);
}

function linearTicks(low: number, high: number): number[] {
  const span = high - low;
  const least = span / MOST_TICKS;
  const decade = decadeOf(least);
  const few = [1, 2, 2.5, 5, 10].map((m) => m * decade).filter((step) => step >= least * (1 - ROUNDING));
  const isWhole = (step: number): boolean => Math.abs(span / step - Math.round(span / step)) < ROUNDING;
  const step = few.find(isWhole) ?? few[0] ?? span;
  const [first, last] = [Math.ceil(low / step - ROUNDING), Math.floor(high / step + ROUNDING)];
  return Array.from({ length: Math.max(0, last - first + 1) }, (_, k) => rounded((first + k) * step));
}

function logarithmicTicks(low: number, high: number): number[] {
  const decades = Math.log10(high / low);
  const mantissas = decades <= 1 ? [1, 1.5, 2, 3, 4, 5, 7] : decades <= 4 ? [1, 2, 5] : [1];
  const every = Math.max(1, Math.ceil(decades / MOST_TICKS));
  const ticks: number[] = [];
  for (let d = Math.floor(Math.log10(low)); d <= Math.ceil(Math.log10(high)); d += every) ticks.push(...mantissas.map((m) => rounded(m * 10 ** d)));
  return ticks.filter((t) => t >= low * (1 - ROUNDING) && t <= high * (1 + ROUNDING));
}

const rounded = (value: number): number => Number(value.toPrecision(12));

/** Where a value lies between the limits: 0 at the lower, 1 at the upper. */
export function positionOf(value: number, { low, high }: Limits, logarithmic: boolean): number {
  if (!logarithmic) return (value - low) / (high - low);
  return value <= 0 ? -Infinity : Math.log(value / low) / Math.log(high / low);
}

/** Which of the 256 colours a value has. */
export const stepOf = (value: number, limits: Limits, logarithmic: boolean): number =>
  Math.floor(Math.min(Math.max(positionOf(value, limits, logarithmic) * 256, 0), 255));
