import { describe, expect, it } from 'vitest';
import type { ToneTable } from '../wire';
import { fromSrgb, shownBy, toneRow, toSrgb } from './tone';

const table = (rows: number): ToneTable => ({
  name: 'power', label: 'Power', on: 'luminance', whites: { first: 0, step: 2, count: rows }, exposed: { first: -4, step: 1, count: 9 },
  values: { offset: 0, count: 9 * rows, type: 'f32' },
});

describe('tables of tone operators', () => {
  // Row k shows exposed luminance to the power 1 / (k + 1).
  const values = Float32Array.from({ length: 27 }, (_, i) => ((i % 9) - 4) / (Math.floor(i / 9) + 1));

  it('have a row between rows', () => {
    const row = toneRow(table(3), values, 2, new Float32Array(9));
    expect(row[0]).toBeCloseTo(-3, 6);
    expect(toneRow(table(3), values, 1e9, new Float32Array(9))[0]).toBeCloseTo(-4 / 3, 6);
    expect(toneRow(table(1), values, 77, new Float32Array(9))[0]).toBeCloseTo(-4, 6);
  });

  it('go on straight at both ends, and are cut at 1', () => {
    const row = toneRow(table(1), values, 1, new Float32Array(9));
    expect(shownBy(row, table(1), 2 ** -9)).toBeCloseTo(2 ** -9, 9);
    expect(shownBy(row, table(1), 0.3)).toBeCloseTo(0.3, 6);
    expect(shownBy(row, table(1), 1e6)).toBe(1);
    expect(shownBy(row, table(1), 0)).toBe(0);
  });
});

it('codes of sRGB come back', () => {
  for (const c of [0, 0.002, 0.18, 0.5, 1]) expect(fromSrgb(toSrgb(c))).toBeCloseTo(c, 12);
});
