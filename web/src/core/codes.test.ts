import { describe, expect, it } from 'vitest';
import { fromHalf, fromOctahedral, fromRgb9e5, isUnknown, luminance, toHalf, toRgb9e5 } from './codes';

describe('shared exponents', () => {
  it('come back within half a step of the largest', () => {
    for (const colour of [[0, 0, 0], [1, 1, 1], [500, 480, 333.25], [1e-4, 2e-4, 0], [65408, 3, 70], [0.1, 1000, 2.7]] as [number, number, number][]) {
      const back = fromRgb9e5(toRgb9e5(...colour), [0, 0, 0]);
      back.forEach((c, k) => expect(Math.abs(c - colour[k]!)).toBeLessThanOrEqual(Math.max(...colour) / 510));
    }
  });

  it('are those of the extension', () => {
    // 1.0 is 256 x 2^-8: exponent 16.
    expect(toRgb9e5(1, 1, 1)).toBe(((16 << 27) | (256 << 18) | (256 << 9) | 256) >>> 0);
    expect(toRgb9e5(-1, Number.NaN, 0)).toBe(0);
    expect(fromRgb9e5(toRgb9e5(1e9, 0, 0), [0, 0, 0])[0]).toBe(65408);
  });
});

describe('half floats', () => {
  it('come back', () => {
    for (let code = 0; code < 0x7c00; code += 7) expect(toHalf(fromHalf(code))).toBe(code);
    expect(fromHalf(0x3c00)).toBe(1);
    expect(fromHalf(toHalf(0.1))).toBeCloseTo(0.1, 4);
  });

  it('tell what is not known', () => {
    expect([0, 0x3c00, 0x7c00, 0x7c01, 0x7e00, 0xfe00].map(isUnknown)).toEqual([false, false, false, true, true, true]);
    expect([toHalf(Infinity), toHalf(Number.NaN), fromHalf(0x7c00)]).toEqual([0x7c00, 0x7e00, Infinity]);
  });
});

it('octahedral normals are unit vectors', () => {
  expect(fromOctahedral(0, 0)).toEqual([0, 0, 1]);
  expect(fromOctahedral(127, 0)).toEqual([1, 0, 0]);
  expect(fromOctahedral(127, 127).map((c) => Math.round(c))).toEqual([0, 0, -1]);
  expect(Math.hypot(...fromOctahedral(-100, 77))).toBeCloseTo(1, 12);
});

it('luminance of white is 1', () => expect(luminance([1, 1, 1])).toBeCloseTo(1, 12));
