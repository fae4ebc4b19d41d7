import { describe, expect, it } from 'vitest';
import { parsePercent, percentText } from './percent';

describe('the box of a dimmer', () => {
  it('takes percentages as people write them', () => {
    const written: [string, number][] = [['75', 0.75], ['75 %', 0.75], [' 75% ', 0.75], ['12,5 %', 0.125], ['.5', 0.005], ['off', 0], ['Off', 0], ['0', 0], ['150', 1.5]];
    for (const [text, factor] of written) expect(parsePercent(text)).toEqual({ factor });
  });
  it('says what is wrong with anything else', () => {
    for (const text of ['abc', '', ' ', '1e1', '0x10', '50 lx', '5 0', '%', '--5', 'NaN', 'Infinity', '-5', '-0.1', '151', '1000 %']) {
      expect(parsePercent(text)).toHaveProperty('problem');
    }
    expect(parsePercent('abc')).toEqual({ problem: '"abc" is not a percentage.' });
    expect(parsePercent('200')).toEqual({ problem: 'Write 0 to 150 %.' });
  });
  it('takes what it shows', () => {
    for (const factor of [0, 0.01, 0.5, 1, 1.5]) expect(parsePercent(percentText(factor))).toEqual({ factor });
  });
});
