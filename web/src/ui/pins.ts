// Readings that are kept: which there are, and which of them is chosen.

import type { Whose } from '../contract';
import type { Reading } from '../wire';
import type { LinkPin } from './link';
import type { Ui } from './ui';

export interface Pin {
  /** What people call it: 1, 2, 3. */
  number: number;
  reading: Reading;
  /** Whose light was read. */
  whose: Whose;
  /** The light has changed since. */
  stale: boolean;
}

export interface Pins {
  all(): readonly Pin[];
  chosen(): Pin | null;
  add(reading: Reading, whose: Whose): Pin;
  /** A newer reading of the same place; null: there is none, and the one there is has become old. */
  renew(pin: Pin, reading: Reading | null): void;
  choose(pin: Pin | null): void;
  remove(pin: Pin): void;
  clear(): void;
  restore(pins: LinkPin[]): void;
  links(): LinkPin[];
  onChange(call: () => void): void;
}

const MOST = 64;

export function pinsOf(ui: Ui): Pins {
  const { viewer } = ui;
  let pins: Pin[] = [];
  let chosen: Pin | null = null;
  const calls: (() => void)[] = [];
  const changed = (): void => {
    viewer.pin(chosen?.reading ?? null);
    calls.forEach((call) => call());
  };
  const choose = (pin: Pin | null): void => {
    chosen = pin;
    changed();
  };
  const add = (reading: Reading, whose: Whose): Pin => {
    const pin = { number: (pins.at(-1)?.number ?? 0) + 1, reading, whose, stale: false };
    if (pins.length >= MOST) ui.say(`At most ${MOST} pins: the oldest is gone.`);
    pins = [...pins, pin].slice(-MOST);
    choose(pin);
    return pin;
  };
  const renew = (pin: Pin, reading: Reading | null): void => {
    if (!pins.includes(pin) || (pin.stale && !reading)) return;
    pin.reading = reading ?? pin.reading;
    pin.stale = reading === null;
    changed();
  };
  return {
    all: () => pins, chosen: () => chosen, add, choose, renew, onChange: (call) => void calls.push(call),
    remove: (pin) => {
      pins = pins.filter((p) => p !== pin);
      choose(chosen === pin ? null : chosen);
    },
    clear: () => {
      pins = [];
      choose(null);
    },
    restore: (links) => {
      pins = links.map((link, i) => ({ number: i + 1, reading: asReading(link), whose: link.whose, stale: true }));
      choose(null);
    },
    links: () => pins.flatMap(({ reading: r, whose }) => (r.position && r.normal
      ? [{ position: r.position, normal: r.normal, illuminance_lx: r.illuminance_lx, standard_error_lx: r.standard_error_lx, whose }] : [])),
  };
}

/** What a link tells of a pin, until it has been read again. */
function asReading({ whose: _, ...known }: LinkPin): Reading {
  return {
    ...known, shape: '', material: '', diffuse_reflectance: null, direct_lx: null, indirect_lx: null, rgb_lx: null, luminance_cd_m2: null,
    found: 'vertices',
  };
}
