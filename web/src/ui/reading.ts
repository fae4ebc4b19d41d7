// A reading as text.

import type { Reading, Vec3 } from '../wire';
import { h } from './dom';
import { quantity, significant, valueAndError } from './format';

/** `E = 512.3 ± 6.2 lx`, the value large. */
export function illuminanceLine(r: Reading): HTMLElement {
  const { value, error } = valueAndError(r.illuminance_lx, r.standard_error_lx);
  if (value === null) return h('p', { class: 'value' }, h('span', { class: 'symbol' }, 'E'), h('span', { class: 'unknown' }, 'not known'));
  return h('p', { class: 'value' }, h('span', { class: 'symbol' }, 'E'), h('b', {}, value),
    error === null ? ' lx' : ` ± ${error} lx`, error === null ? h('small', { class: 'unknown' }, 'error not known') : null);
}

/** Where the value is from. */
export function sourceText(r: Reading): string {
  return r.found === 'probe' ? 'as probe reads it: direct light afresh' : 'interpolated between vertices of the map; ± is their noise alone';
}

export function placeText(at: Vec3 | null): string {
  return at ? `${at.map((v) => v.toFixed(3)).join('  ')} m` : 'not known';
}

export function normalText(n: Vec3 | null): string {
  return n ? n.map((v) => v.toFixed(2)).join('  ') : 'not known';
}

/** What else is known of the place. */
export function details(r: Reading): HTMLElement {
  const rows: [string, string][] = [
    ['Direct', quantity(r.direct_lx, 'lx')], ['Indirect', quantity(r.indirect_lx, 'lx')], ['Luminance', quantity(r.luminance_cd_m2, 'cd/m²')],
    ['Reflectance', r.diffuse_reflectance === null ? 'not known' : significant(r.diffuse_reflectance, 2)],
    ['Material', r.material || 'not known'], ['Shape', r.shape || 'not known'],
  ];
  return h('dl', { class: 'facts reading' }, ...rows.flatMap(([name, text]) => [h('dt', {}, name), h('dd', { title: text }, text)]));
}
