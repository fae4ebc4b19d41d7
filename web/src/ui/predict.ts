// What the live run says about itself, in plain words.

import type { LiveState, Phase } from '../wire';
import { share, significant } from './format';

/** A length of time for reading: `0.45 s`, `9.2 s`, `48 s`, `2 min 5 s`, `3 h 10 min`. */
export function seconds(value: number): string {
  const whole = Math.round(value);
  if (value < 1) return `${value.toFixed(2)} s`;
  if (value < 9.95) return `${value.toFixed(1)} s`;
  if (whole < 120) return `${whole} s`;
  if (whole < 7200) return `${Math.floor(whole / 60)} min ${whole % 60} s`;
  return `${Math.floor(whole / 3600)} h ${Math.floor((whole % 3600) / 60)} min`;
}

/** A remaining time needs few digits: `48 s`, `2 min 30 s`, `6 min`, `3 h 10 min`. */
function left(value: number): string {
  if (value < 1) return '1 s';
  if (value < 119.5) return `${Math.round(value)} s`;
  if (value < 295) return seconds(10 * Math.round(value / 10)).replace(' 0 s', '');
  return value < 7170 ? `${Math.round(value / 60)} min` : seconds(60 * Math.round(value / 60));
}

/** When the run will end: `about 12 s left, 8 to 20 s`. */
export function timeLeft(state: Pick<LiveState, 'prediction' | 'elapsed_s' | 'phase'>): string {
  if (isOver(state.phase)) return '';
  const p = state.prediction;
  if (!p) return state.phase === 'audit' ? 'soon done' : 'time left not known yet';
  const [likely, early, late] = [p.finish_s, p.earliest_s, p.latest_s].map((at) => at - state.elapsed_s) as [number, number, number];
  if (late <= 0) return 'about to end';
  if (likely <= 0) return `up to ${left(late)} left`;
  if (early <= 0) return `about ${left(likely)} left, up to ${left(late)}`;
  return `about ${left(likely)} left, ${between(early, late)}`;
}

/** `8 to 20 s`: the unit once where it is the same. */
function between(early: number, late: number): string {
  const [a, b] = [left(early), left(late)];
  const unit = (text: string): string | undefined => /^\d+ (s|min)$/.exec(text)?.[1];
  return unit(a) && unit(a) === unit(b) ? `${a.split(' ')[0]} to ${b}` : `${a} to ${b}`;
}

/** Share of the predicted time that has passed. */
export function done(state: Pick<LiveState, 'prediction' | 'elapsed_s' | 'phase'>): number {
  if (isOver(state.phase)) return 1;
  const finish = state.prediction?.finish_s ?? 0;
  return finish > 0 ? Math.min(1, Math.max(0, state.elapsed_s / finish)) : 0;
}

const PHASES: Record<Phase, string> = {
  starting: 'Starting',
  elements: 'Dividing surfaces into elements',
  increments: 'Gathering light',
  audit: 'Testing the error by complete paths',
  done: 'Done',
  stopped: 'Stopped',
  failed: 'Failed',
};

export function phaseText(state: Pick<LiveState, 'phase' | 'paused'>): string {
  return state.paused && !isOver(state.phase) ? `Paused (${PHASES[state.phase].toLowerCase()})` : PHASES[state.phase];
}

export function isOver(phase: Phase): boolean {
  return phase === 'done' || phase === 'stopped' || phase === 'failed';
}

/** `1.34 % of 1.0 %`, without the word before it. */
export function errorText(state: Pick<LiveState, 'error' | 'target'> & { phase?: Phase }): { now: string; of: string } {
  return {
    now: state.error !== null ? share(state.error, 3) : state.phase && isOver(state.phase) ? 'not known' : 'not known yet',
    of: state.target === null ? '' : `of ${share(state.target)}`,
  };
}

/** `0.9 % (0.4 to 1.2 %), by 240 places: agrees with the reported error of 0.8 %`. */
export function auditText(audit: NonNullable<LiveState['audit']>): string {
  const verdict = audit.contradicts ? 'contradicts' : 'agrees with';
  const range = `${significant(100 * audit.low, 2)} to ${share(audit.high)}`;
  return `${share(audit.error)} (${range}), by ${audit.places} places: ${verdict} the reported error of ${share(audit.told)}`;
}

/** What is lost by another target. */
export function lossText(state: Pick<LiveState, 'elapsed_s' | 'increments' | 'error'>, accuracy: number): string {
  const error = state.error === null ? '' : `, with an error of ${share(state.error)}`;
  const many = state.increments === 1 ? '1 increment' : `${state.increments} increments`;
  return `Begin the run anew for ${share(accuracy)}? The light of ${seconds(state.elapsed_s)} so far (${many}${error}) is lost. Nothing of it is saved.`;
}

/** The accuracy that somebody typed, or what is wrong with it. */
export function parseTarget(text: string): { accuracy: number } | { problem: string } {
  const clean = text.trim().replace(',', '.');
  if (clean === '') return { problem: 'Write a percentage, like 1%.' };
  const match = /^(\d+(?:\.\d*)?|\.\d+)\s*(%?)$/.exec(clean);
  if (!match) return { problem: `"${text.trim()}" is not a percentage. Write it like 0.5%.` };
  if (match[2] === '') return { problem: `Add the sign: ${match[1]}%.` };
  const accuracy = Number(match[1]) / 100;
  if (!(accuracy > 0)) return { problem: 'An error of zero cannot be reached. Write more than 0%.' };
  if (accuracy >= 1) return { problem: 'Write less than 100%.' };
  return { accuracy };
}
