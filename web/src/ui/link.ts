// What is shown as the part of an address after "#": short, and of a version. Reading one never throws.

import type { Mode, Settings, View, Whose } from '../contract';
import type { Vec3 } from '../wire';

/** A pin of a link: its place, and what was read there when the link was made. */
export interface LinkPin {
  position: Vec3;
  normal: Vec3;
  illuminance_lx: number | null;
  standard_error_lx: number | null;
  whose: Whose;
}

export interface LinkState {
  view?: View;
  navigation?: 'orbit' | 'walk';
  settings: Partial<Settings>;
  pins: LinkPin[];
}

export const MODES: Mode[] = ['seen', 'illuminance', 'luminance', 'direct', 'indirect', 'error', 'relative', 'difference'];
/** Pins of other light than that of the map have a letter at their end. */
const LETTERS: Record<Whose, string> = { own: '', map: 'm', dimming: 'd' };
const VERSION = 'v1';
const MOST_PINS = 64;
const MOST_LAYERS = 256;

function short(value: number, digits = 5): string {
  return String(Number(value.toPrecision(digits)));
}

/** Metres to a millimetre. */
function place(at: number[]): string {
  return at.map((v) => String(Number(v.toFixed(4)))).join(',');
}

export function encodeLink(state: LinkState): string {
  const parts: string[] = [VERSION];
  const put = (key: string, value: string): void => void parts.push(`${key}=${value}`);
  if (state.view) put('at', `${place([...state.view.position, ...state.view.target])},${short(state.view.fovDeg)}`);
  if (state.navigation) put('nav', state.navigation);
  encodeSettings(state.settings, put);
  for (const pin of state.pins.slice(0, MOST_PINS)) put('pin', encodePin(pin));
  return `#${parts.join('&')}`;
}

function encodePin(pin: LinkPin): string {
  const numbers = [pin.illuminance_lx, pin.standard_error_lx].map((v) => (v === null || !Number.isFinite(v) ? '' : short(v)));
  return `${place(pin.position)},${pin.normal.map((v) => short(v, 3)).join(',')},${numbers.join(',')}${pin.whose === 'own' ? '' : `,${LETTERS[pin.whose]}`}`;
}

const FLAGS: [string, 'contours' | 'mesh' | 'grids' | 'logarithmic'][] =
  [['c', 'contours'], ['m', 'mesh'], ['g', 'grids'], ['l', 'logarithmic']];

function encodeSettings(s: Partial<Settings>, put: (key: string, value: string) => void): void {
  if (s.mode) put('mode', s.mode);
  if (s.tone) put('tone', encodeURIComponent(s.tone));
  if (s.autoExposure) put('ev', 'auto');
  else if (s.ev100 !== undefined) put('ev', short(s.ev100, 4));
  if (s.colourMap) put('map', encodeURIComponent(s.colourMap));
  if (s.limits) put('lim', `${short(s.limits.low)},${short(s.limits.high)}`);
  const flags = FLAGS.filter(([, name]) => s[name]).map(([letter]) => letter).join('');
  if (flags) put('on', flags);
  if (s.luminaires) put('lum', s.luminaires);
  if (s.dimming) put('dim', s.dimming.map((v) => short(v, 3)).join(','));
  if (s.otherDimming) put('dim2', s.otherDimming.map((v) => short(v, 3)).join(','));
  if (s.compare) put('cmp', `${s.compare},${short(s.split ?? 0.5, 3)}`);
}

/** What a link says, or null where it is none of this version. Parts that make no sense are left out and named in `bad`. */
export function decodeLink(hash: string): { state: LinkState; bad: string[] } | null {
  const [version, ...parts] = hash.replace(/^#/, '').split('&');
  if (version !== VERSION) return null;
  const state: LinkState = { settings: {}, pins: [] };
  const bad: string[] = [];
  for (const part of parts) {
    const cut = part.indexOf('=');
    const key = cut < 0 ? part : part.slice(0, cut);
    const read = Object.hasOwn(READERS, key) ? READERS[key] : undefined;
    if (!read || cut < 0 || !read(part.slice(cut + 1), state)) bad.push(key.slice(0, 20));
  }
  // A link tells all flags: those not named are off.
  if (parts.length > 0) for (const [, name] of FLAGS) state.settings[name] ??= false;
  return { state, bad };
}

type Reader = (text: string, into: LinkState) => boolean;

const READERS: Record<string, Reader> = {
  at: (text, into) => {
    const n = numbers(text, 7, -1e7, 1e7);
    if (!n || n[6]! < 1 || n[6]! > 170) return false;
    into.view = { position: [n[0]!, n[1]!, n[2]!], target: [n[3]!, n[4]!, n[5]!], fovDeg: n[6]! };
    return true;
  },
  nav: (text, into) => oneOf(text, ['orbit', 'walk'] as const, (v) => { into.navigation = v; }),
  mode: (text, into) => oneOf(text, MODES, (v) => { into.settings.mode = v; }),
  tone: (text, into) => name(text, (v) => { into.settings.tone = v; }),
  map: (text, into) => name(text, (v) => { into.settings.colourMap = v; }),
  ev: (text, into) => {
    const n = text === 'auto' ? [] : numbers(text, 1, -30, 40);
    if (!n) return false;
    into.settings.autoExposure = n.length === 0;
    if (n.length > 0) into.settings.ev100 = n[0]!;
    return true;
  },
  lim: (text, into) => {
    const n = numbers(text, 2, -1e12, 1e12);
    if (!n || n[0]! >= n[1]!) return false;
    into.settings.limits = { low: n[0]!, high: n[1]! };
    return true;
  },
  on: (text, into) => {
    if (!/^[cmgl]{0,4}$/.test(text)) return false;
    for (const [letter, flag] of FLAGS) into.settings[flag] = text.includes(letter);
    return true;
  },
  lum: (text, into) => oneOf(text, ['off', 'points', 'solids'] as const, (v) => { into.settings.luminaires = v; }),
  dim: (text, into) => layers(text, (v) => { into.settings.dimming = v; }),
  dim2: (text, into) => layers(text, (v) => { into.settings.otherDimming = v; }),
  cmp: (text, into) => {
    const [what = '', at = ''] = text.split(',');
    const split = numbers(at, 1, 0, 1);
    if (!split) return false;
    into.settings.split = split[0]!;
    return oneOf(what, ['off', 'maps', 'dimmings'] as const, (v) => { into.settings.compare = v; });
  },
  pin: (text, into) => {
    const cells = text.split(',');
    const at = numbers(cells.slice(0, 6).join(','), 6, -1e7, 1e7);
    const whose = (['own', 'map', 'dimming'] as const).find((w) => LETTERS[w] === (cells[8] ?? ''));
    if (!at || !whose || cells.length < 8 || cells.length > 9 || into.pins.length >= MOST_PINS) return false;
    const value = (cell: string): number | null => numbers(cell, 1, 0, 1e12)?.[0] ?? null;
    into.pins.push({
      position: [at[0]!, at[1]!, at[2]!], normal: [at[3]!, at[4]!, at[5]!],
      illuminance_lx: value(cells[6]!), standard_error_lx: value(cells[7]!), whose,
    });
    return true;
  },
};

/** So many plain numbers between two limits. */
function numbers(text: string, many: number, least: number, most: number): number[] | null {
  const cells = text.split(',');
  if (cells.length !== many || !cells.every((c) => /^-?\d{1,14}(\.\d{1,20})?(e[-+]?\d{1,3})?$/.test(c))) return null;
  const values = cells.map(Number);
  return values.every((v) => v >= least && v <= most) ? values : null;
}

function oneOf<T extends string>(text: string, known: readonly T[], use: (value: T) => void): boolean {
  const found = known.find((k) => k === text);
  if (found !== undefined) use(found);
  return found !== undefined;
}

function name(text: string, use: (value: string) => void): boolean {
  let plain: string;
  try {
    plain = decodeURIComponent(text);
  } catch {
    return false;
  }
  if (plain === '' || plain.length > 60) return false;
  use(plain);
  return true;
}

function layers(text: string, use: (value: number[]) => void): boolean {
  const many = text.split(',').length;
  const values = many <= MOST_LAYERS ? numbers(text, many, 0, 2) : null;
  if (values) use(values);
  return values !== null;
}
