import { describe, expect, it } from 'vitest';
import { auditText, done, errorText, lossText, parseTarget, phaseText, seconds, timeLeft } from './predict';

const at = (elapsed_s: number, finish_s: number, earliest_s: number, latest_s: number) =>
  ({ phase: 'increments' as const, elapsed_s, prediction: { finish_s, earliest_s, latest_s } });

describe('what a run says', () => {
  it('tells the time left with its interval', () => {
    expect(timeLeft(at(10, 22, 18, 30))).toBe('about 12 s left, 8 to 20 s');
    expect(timeLeft(at(20, 22, 18, 30))).toBe('about 2 s left, up to 10 s');
    expect(timeLeft(at(25, 22, 18, 30))).toBe('up to 5 s left');
    expect(timeLeft(at(31, 22, 18, 30))).toBe('about to end');
    expect(timeLeft(at(0, 90, 60, 190))).toBe('about 90 s left, 60 s to 3 min 10 s');
    expect(timeLeft(at(0, 387, 297, 577))).toBe('about 6 min left, 5 to 10 min');
    expect(timeLeft(at(0, 121, 118, 7300))).toBe('about 2 min left, 118 s to 2 h 2 min');
  });
  it('says so where nothing is predicted', () => {
    expect(timeLeft({ phase: 'elements', elapsed_s: 1, prediction: null })).toBe('time left not known yet');
    expect(timeLeft({ phase: 'done', elapsed_s: 1, prediction: null })).toBe('');
  });
  it('shows how far it is', () => {
    expect(done(at(11, 22, 18, 30))).toBe(0.5);
    expect(done({ phase: 'elements', elapsed_s: 1, prediction: null })).toBe(0);
    expect(done({ phase: 'done', elapsed_s: 1, prediction: null })).toBe(1);
  });
  it('writes errors and phases', () => {
    expect(errorText({ error: 0.0134, target: 0.01 })).toEqual({ now: '1.34 %', of: 'of 1.0 %' });
    expect(errorText({ error: null, target: null })).toEqual({ now: 'not known yet', of: '' });
    expect(phaseText({ phase: 'increments', paused: true })).toBe('Paused (gathering light)');
    expect(auditText({ error: 0.009, low: 0.004, high: 0.012, told: 0.008, places: 240, contradicts: false }))
      .toBe('0.90 % (0.40 to 1.2 %), by 240 places: agrees with the reported error of 0.80 %');
  });
  it('writes lengths of time', () => {
    expect([0.451, 9.21, 48.2, 125, 11400].map(seconds)).toEqual(['0.45 s', '9.2 s', '48 s', '2 min 5 s', '3 h 10 min']);
  });
});

describe('a target', () => {
  it('says what is lost by another', () => {
    const state = { elapsed_s: 125, increments: 12, error: 0.0134 };
    expect(lossText(state, 0.005)).toBe('Begin the run anew for 0.50 %? The light of 2 min 5 s so far (12 increments, with an error of 1.3 %) is lost. Nothing of it is saved.');
    expect(lossText({ ...state, increments: 1, error: null }, 0.01)).toContain('(1 increment) is lost');
  });
  it('is a percentage', () => {
    expect(parseTarget('1%')).toEqual({ accuracy: 0.01 });
    expect(parseTarget(' 0,5 % ')).toEqual({ accuracy: 0.005 });
  });
  it('or is told to be none', () => {
    for (const text of ['', '1', 'abc', '0%', '100%', '-1%', '1%%', '1e999%']) expect(parseTarget(text)).toHaveProperty('problem');
  });
});
