import { describe, expect, it } from 'vitest';
import type { Legend } from '../contract';
import { keyText } from './keys';
import { position } from './legend';
import { dimmingName } from './ui';

describe('the scale', () => {
  const scale = (logarithmic: boolean): Legend => ({ low: 1, high: 100, ticks: [], unit: 'lx', logarithmic, colours: [] });
  it('puts values where the colours are', () => {
    expect(position(scale(false), 50.5)).toBeCloseTo(0.5);
    expect(position(scale(true), 10)).toBeCloseTo(0.5);
    expect(position({ ...scale(true), low: 0 }, 50)).toBeCloseTo(0.5);
    expect(position({ ...scale(false), high: 1 }, 5)).toBe(0);
  });
});

describe('words', () => {
  it('name keys as keyboards do', () => {
    expect(['home', 'shift+n', 'c', '['].map(keyText)).toEqual(['Home', 'Shift N', 'C', '[']);
  });
  it('name dimmings', () => {
    expect(dimmingName(['panels', 'spots'], [1, 1])).toBe('undimmed');
    expect(dimmingName(['panels', 'spots'], [0, 0.3])).toBe('panels off, spots 30 %');
    expect(dimmingName(['a', 'b', 'c'], [0, 0.3, 0.5])).toBe('a off, b 30 % and 1 more');
  });
});
