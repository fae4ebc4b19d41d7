import { describe, expect, it } from 'vitest';
import type { Legend } from '../contract';
import { keyText } from './keys';
import { position, spareTicks } from './legend';
import { dimmingName } from './ui';

describe('the scale', () => {
  const scale = (logarithmic: boolean): Legend => ({ low: 1, high: 100, ticks: [], unit: 'lx', logarithmic, colours: [] });
  it('puts values where the colours are', () => {
    expect(position(scale(false), 50.5)).toBeCloseTo(0.5);
    expect(position(scale(true), 10)).toBeCloseTo(0.5);
    expect(position({ ...scale(true), low: 0 }, 50)).toBeCloseTo(0.5);
    expect(position({ ...scale(false), high: 1 }, 5)).toBe(0);
  });
  it('leaves out every other tick where they have no room side by side, but not nought', () => {
    expect(spareTicks([0, 50, 100, 150, 200, 250, 300, 350, 400, 450, 500])).toEqual(new Set());
    expect(spareTicks([-250, -200, -150, -100, -50, 0, 50, 100, 150, 200, 250])).toEqual(new Set([0, 2, 4, 6, 8, 10]));
    expect(spareTicks([10000, 20000, 30000, 40000, 50000, 60000, 70000])).toEqual(new Set([1, 3, 5]));
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
