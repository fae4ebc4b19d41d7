// A difference of two readings of one place.

import type { Both } from '../contract';
import type { Reading } from '../wire';
import { h } from './dom';
import { isKnown, valueAndError, withError } from './format';

/**
 * The first less the second, and its standard error where both have one: as if both erred by themselves, which is too much where they
 * have rays in common.
 */
export function differenceOf({ own, other }: { own: Reading; other: Reading }): { value: number | null; error: number | null } {
  const [a, b] = [own, other];
  if (!isKnown(a.illuminance_lx) || !isKnown(b.illuminance_lx)) return { value: null, error: null };
  const areKnown = isKnown(a.standard_error_lx) && isKnown(b.standard_error_lx);
  return { value: a.illuminance_lx - b.illuminance_lx, error: areKnown ? Math.hypot(a.standard_error_lx!, b.standard_error_lx!) : null };
}

/** `+12.3 ± 1.2 lx`, in two texts. */
export function differenceText(both: Both): { value: string | null; error: string | null } {
  const { value, error } = differenceOf(both);
  const text = valueAndError(value, error);
  return { ...text, value: text.value !== null && value! > 0 && /[1-9]/.test(text.value) ? `+${text.value}` : text.value };
}

/** The difference large, and both values with the names of what they are of. */
export function differenceLines(both: Both, [own, other]: [string, string]): HTMLElement[] {
  const { value, error } = differenceText(both);
  const large = value === null ? h('span', { class: 'unknown' }, 'not known') : h('b', {}, value);
  const rest = value === null ? null : error === null ? ' lx' : ` ± ${error} lx`;
  const row = (name: string, r: Reading): HTMLElement[] =>
    [h('dt', { class: 'clip', title: name }, name), h('dd', {}, withError(r.illuminance_lx, r.standard_error_lx, 'lx'))];
  return [
    h('p', { class: 'value' }, h('span', { class: 'symbol' }, 'ΔE'), large, rest, value !== null && error === null ? h('small', { class: 'unknown' }, 'error not known') : null),
    h('dl', { class: 'facts both' }, ...row(own, both.own), ...row(other, both.other)),
  ];
}
