// Whose light is seen, where two are compared.

import type { Settings, Whose } from '../contract';

/** Whose light is seen so far across the picture, 0 to 1. */
export function whoseAt({ compare, mode, split }: Readonly<Settings>, hasOtherMap: boolean, across: number): Whose {
  if (mode === 'difference' || across <= split) return 'own';
  if (compare === 'dimmings') return 'dimming';
  return compare === 'maps' && hasOtherMap ? 'map' : 'own';
}

/** What the map is compared with, `null` for nothing: a difference is that of two dimmings where there is no other map. */
export function comparedWith({ compare, mode }: Readonly<Settings>, hasOtherLight: boolean): Exclude<Whose, 'own'> | null {
  if (compare === 'dimmings') return 'dimming';
  if (hasOtherLight && (compare === 'maps' || mode === 'difference')) return 'map';
  return mode === 'difference' ? 'dimming' : null;
}
