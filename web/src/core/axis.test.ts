import { describe, expect, it } from 'vitest';
import { positionOf, roundLimits, stepOf, ticksOf } from './axis';

const values = (n: number, of: (i: number) => number): Float64Array => Float64Array.from({ length: n }, (_, i) => of(i));

describe('limits', () => {
  it('of linear scales begin at zero and are round', () => {
    expect(roundLimits(values(1000, (i) => i * 0.77), false)).toEqual({ low: 0, high: 800 });
    expect(roundLimits(values(10, () => 42), false)).toEqual({ low: 0, high: 50 });
    expect(roundLimits(values(0, () => 0), false)).toEqual({ low: 0, high: 1 });
    expect(roundLimits(values(5, () => 0), false)).toEqual({ low: 0, high: 1 });
  });

  it('leave out the outermost half per cent', () => {
    expect(roundLimits(values(1000, (i) => (i < 4 ? 1e6 : 80 + i / 100)), false).high).toBe(100);
  });

  it('of logarithmic scales span four decades at most', () => {
    expect(roundLimits(values(1000, (i) => 10 ** (i / 100 - 5)), true)).toEqual({ low: 10, high: 100_000 });
    expect(roundLimits(values(10, (i) => -i), true)).toEqual({ low: 1, high: 10 });
  });
});

describe('ticks', () => {
  it('are round and few', () => {
    expect(ticksOf({ low: 0, high: 800 }, false)).toEqual([0, 100, 200, 300, 400, 500, 600, 700, 800]);
    expect(ticksOf({ low: 0, high: 0.3 }, false)).toEqual([0, 0.05, 0.1, 0.15, 0.2, 0.25, 0.3]);
    expect(ticksOf({ low: 1, high: 1000 }, true)).toEqual([1, 2, 5, 10, 20, 50, 100, 200, 500, 1000]);
    expect(ticksOf({ low: -100, high: 100 }, false)).toHaveLength(11);
  });
});

describe('steps', () => {
  it('are 256, cut off at both ends', () => {
    const limits = { low: 0, high: 256 };
    expect([-5, 0, 0.999, 1, 255, 256, 1e9].map((v) => stepOf(v, limits, false))).toEqual([0, 0, 0, 1, 255, 255, 255]);
  });

  it('of logarithmic scales go by ratios', () => {
    expect(positionOf(10, { low: 1, high: 100 }, true)).toBeCloseTo(0.5, 12);
    expect(stepOf(0, { low: 1, high: 100 }, true)).toBe(0);
  });
});
