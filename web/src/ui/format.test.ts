import { describe, expect, it } from 'vitest';
import { bytes, count, decimalsFor, intervalText, quantity, rounded, share, significant, tick, withError } from './format';

describe('numbers by their error', () => {
  it('shows two digits of the error, and the value to the same place', () => {
    expect(withError(512.34, 6.21, 'lx')).toBe('512.3 ± 6.2 lx');
    expect(withError(512.34, 62.1, 'lx')).toBe('512 ± 62 lx');
    expect(withError(512.34, 123, 'lx')).toBe('510 ± 120 lx');
    expect(withError(0.0456, 0.00123, 'lx')).toBe('0.0456 ± 0.0012 lx');
  });
  it('counts the digits of the error after rounding', () => {
    expect(decimalsFor(0.0996)).toBe(2);
    expect(withError(3, 0.0996, 'lx')).toBe('3.00 ± 0.10 lx');
    expect(decimalsFor(99.6)).toBe(-1);
  });
  it('says in words what is not known', () => {
    expect(withError(null, 1, 'lx')).toBe('not known');
    expect(withError(Number.NaN, 1, 'lx')).toBe('not known');
    expect(withError(512.34, null, 'lx')).toBe('512 lx, error not known');
    expect(withError(512.34, Infinity, 'lx')).toBe('512 lx, error not known');
    expect(quantity(null, 'cd/m²')).toBe('not known');
  });
  it('holds at the ends', () => {
    expect(withError(0, 0, 'lx')).toBe('0 ± 0 lx');
    expect(withError(0, 0.5, 'lx')).toBe('0.00 ± 0.50 lx');
    expect(withError(512.3456789, 1e-9, 'lx')).toBe('512.3457 ± 0.0000 lx');
    expect(withError(0.3, 120, 'lx')).toBe('0 ± 120 lx');
  });
  it('groups thousands from five digits on', () => {
    expect(rounded(1234, 0)).toBe('1234');
    expect(rounded(12345, -2)).toBe('12\u202f300');
    expect(tick(100000)).toBe('100\u202f000');
    expect(rounded(-0.2, 0)).toBe('0');
    expect(rounded(-12, 0)).toBe('−12');
  });
});

describe('other numbers', () => {
  it('have the digits asked for', () => {
    expect(significant(0.012345, 2)).toBe('0.012');
    expect(significant(1995, 2)).toBe('2000');
    expect(share(0.0134, 3)).toBe('1.34 %');
    expect(share(0.01)).toBe('1.0 %');
    expect(count(3_140_000)).toBe('3.14 M');
    expect(count(950)).toBe('950');
    expect(bytes(86_400_000)).toBe('86.4 MB');
  });
  it('intervals have digits by their width', () => {
    expect(intervalText(480.2, 519.7)).toBe('480 to 520');
    expect(intervalText(0.612, 0.668)).toBe('0.612 to 0.668');
    expect(intervalText(365, 421)).toBe('365 to 421');
    expect(intervalText(503, 521)).toBe('503 to 521');
    expect(intervalText(3, 3)).toBe('3.00');
  });
});
