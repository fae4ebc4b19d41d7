import { describe, expect, it } from 'vitest';
import type { Reading } from '../wire';
import { differenceOf, differenceText } from './difference';

const reading = (illuminance_lx: number | null, standard_error_lx: number | null): Reading => ({
  position: [0, 0, 0], normal: [0, 0, 1], shape: '', material: '', diffuse_reflectance: null, illuminance_lx, standard_error_lx, direct_lx: null,
  indirect_lx: null, rgb_lx: null, luminance_cd_m2: null, found: 'probe',
});

describe('a difference', () => {
  it('is the first less the second, errors added by squares', () => {
    expect(differenceOf({ own: reading(512, 3), other: reading(500, 4) })).toEqual({ value: 12, error: 5 });
    expect(differenceText({ own: reading(512, 3), other: reading(500, 4) })).toEqual({ value: '+12.0', error: '5.0' });
    expect(differenceText({ own: reading(500, 3), other: reading(512, 4) })).toEqual({ value: '−12.0', error: '5.0' });
  });
  it('has an error only where both have', () => {
    for (const unknown of [null, Infinity, NaN]) {
      expect(differenceOf({ own: reading(512, 3), other: reading(500, unknown) })).toEqual({ value: 12, error: null });
    }
  });
  it('is not known where one of both is not', () => {
    expect(differenceText({ own: reading(null, null), other: reading(500, 4) })).toEqual({ value: null, error: null });
  });
  it('of nothing has no sign', () => {
    expect(differenceText({ own: reading(5, 0), other: reading(5, 0) }).value).toBe('0');
    expect(differenceText({ own: reading(5.001, 3), other: reading(5, 4) }).value).toBe('0.0');
  });
});
