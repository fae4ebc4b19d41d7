import { describe, expect, it } from 'vitest';
import type { Settings } from '../contract';
import { comparedWith, whoseAt } from './whose';

const shown = (change: Partial<Settings>): Settings => ({ mode: 'seen', compare: 'off', split: 0.5, ...change }) as Settings;

describe('whose light is seen', () => {
  it('is that of the other side right of the slider', () => {
    expect(whoseAt(shown({ compare: 'maps' }), true, 0.5)).toBe('own');
    expect(whoseAt(shown({ compare: 'maps' }), true, 0.51)).toBe('map');
    expect(whoseAt(shown({ compare: 'dimmings' }), false, 0.51)).toBe('dimming');
  });
  it('is that of the map where nothing else is there', () => {
    expect(whoseAt(shown({}), true, 0.9)).toBe('own');
    expect(whoseAt(shown({ compare: 'maps' }), false, 0.9)).toBe('own');
  });
  it('has no sides in a difference', () => {
    expect(whoseAt(shown({ compare: 'maps', mode: 'difference' }), true, 0.9)).toBe('own');
  });
});

describe('what is compared', () => {
  it('is another map, or another dimming', () => {
    expect(comparedWith(shown({ compare: 'maps' }), true)).toBe('map');
    expect(comparedWith(shown({ mode: 'difference' }), true)).toBe('map');
    expect(comparedWith(shown({ mode: 'difference', compare: 'dimmings' }), true)).toBe('dimming');
  });
  it('is never nothing in a difference', () => {
    expect(comparedWith(shown({ mode: 'difference' }), false)).toBe('dimming');
    expect(comparedWith(shown({ mode: 'difference', compare: 'maps' }), false)).toBe('dimming');
    expect(comparedWith(shown({}), true)).toBeNull();
  });
});
