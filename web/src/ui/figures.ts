// The figures of a section: mean, least, greatest, uniformity, with intervals as those of calculation grids.

import type { Reading } from '../wire';
import { isKnown } from './format';

export interface Sample {
  at: number;
  reading: Reading;
}

export interface Figure {
  value: number;
  low: number;
  high: number;
}

export interface Figures {
  length: number;
  /** Samples without a value. */
  unknown: number;
  mean: Figure;
  least: Figure;
  greatest: Figure;
  /** Least over mean. */
  uniformity: Figure;
}

interface Known {
  at: number;
  value: number;
  low: number;
  high: number;
}

/**
 * Figures along a section; null where nothing is known. The mean is that of the line, not of the samples, and its interval is as if
 * all samples erred together, because a map does not tell how much errors of neighbours have in common.
 */
export function figuresOf(samples: Sample[]): Figures | null {
  const known = samples.flatMap(asKnown);
  if (known.length === 0) return null;
  const mean = {
    value: meanOf(known, (k) => k.value), low: meanOf(known, (k) => k.low), high: meanOf(known, (k) => k.high),
  };
  const least = extreme(known, Math.min);
  return {
    length: lengthOf(samples), unknown: samples.length - known.length, mean, least, greatest: extreme(known, Math.max),
    uniformity: ratio(least, mean),
  };
}

function asKnown({ at, reading }: Sample): Known[] {
  const value = reading.illuminance_lx;
  if (!isKnown(value)) return [];
  const wide = isKnown(reading.standard_error_lx) ? 2 * reading.standard_error_lx : 0;
  return [{ at, value, low: Math.max(0, value - wide), high: value + wide }];
}

function lengthOf(samples: Sample[]): number {
  return (samples[samples.length - 1]?.at ?? 0) - (samples[0]?.at ?? 0);
}

/** Mean over the length, linear between samples. */
function meanOf(known: Known[], of: (k: Known) => number): number {
  let [area, length] = [0, 0];
  for (let i = 1; i < known.length; i++) {
    const [a, b] = [known[i - 1]!, known[i]!];
    area += (b.at - a.at) * (of(a) + of(b)) / 2;
    length += b.at - a.at;
  }
  return length > 0 ? area / length : known.reduce((sum, k) => sum + of(k), 0) / known.length;
}

function extreme(known: Known[], pick: (...values: number[]) => number): Figure {
  const over = (of: (k: Known) => number): number => known.reduce((best, k) => pick(best, of(k)), of(known[0]!));
  return { value: over((k) => k.value), low: over((k) => k.low), high: over((k) => k.high) };
}

/** Ends of both figures against each other; a least value is never above the mean. */
function ratio(a: Figure, b: Figure): Figure {
  const over = (x: number, y: number): number => (y > 0 ? Math.min(1, x / y) : 0);
  return { value: over(a.value, b.value), low: over(a.low, b.high), high: over(a.high, b.low) };
}
