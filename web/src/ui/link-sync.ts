// Keeps the address as what is shown, and shows what an address says.

import type { Settings } from '../contract';
import { throttled } from './dom';
import { decodeLink, encodeLink, type LinkState } from './link';
import type { Pins } from './pins';
import { isComparable, layerNames, modesOf, type Ui } from './ui';

/** Browsers allow some hundred changes of the address in half a minute. */
const EVERY_MS = 400;

export interface LinkSync {
  /** The whole address of what is shown. */
  link(): string;
}

export function syncLink(ui: Ui, pins: Pins): LinkSync {
  const start = { ...ui.viewer.settings };
  const hash = (): string => encodeLink(stateOf(ui, pins, start));
  let written = location.hash;
  const write = throttled(() => {
    written = hash();
    try {
      history.replaceState(history.state, '', written);
    } catch {
      // Some browsers refuse it for files; the link can still be copied.
    }
  }, EVERY_MS);
  const read = (): void => {
    if (location.hash.length > 1 && location.hash !== written) apply(ui, pins, start, location.hash);
  };
  if (written.length > 1) apply(ui, pins, start, written);
  for (const event of ['view', 'settings', 'navigation'] as const) ui.viewer.on(event, write);
  pins.onChange(write);
  window.addEventListener('hashchange', read);
  return { link: () => location.href.replace(/#.*$/, '') + hash() };
}

function stateOf({ viewer }: Ui, pins: Pins, start: Readonly<Settings>): LinkState {
  const s = viewer.settings;
  const other = s.compare === 'dimmings' ? { otherDimming: [...s.otherDimming] } : {};
  const dimming = s.dimming.some((v) => v !== 1) ? { dimming: [...s.dimming] } : {};
  const names = { ...(s.tone !== start.tone ? { tone: s.tone } : {}), ...(s.colourMap !== start.colourMap ? { colourMap: s.colourMap } : {}) };
  const ev = s.autoExposure ? { autoExposure: true } : { autoExposure: false, ev100: s.ev100 };
  return {
    view: viewer.view(), pins: pins.links(), ...(viewer.navigation === 'walk' ? { navigation: 'walk' as const } : {}),
    settings: {
      mode: s.mode, limits: s.limits, logarithmic: s.logarithmic, contours: s.contours, mesh: s.mesh, grids: s.grids, luminaires: s.luminaires,
      compare: s.compare, split: s.split, ...ev, ...names, ...dimming, ...other,
    },
  };
}

function apply(ui: Ui, pins: Pins, start: Readonly<Settings>, hash: string): void {
  const decoded = decodeLink(hash);
  if (!decoded) {
    ui.say('The address names no view of this page; it is left out.');
    return;
  }
  const { state, bad } = decoded;
  const settings = fitting(ui, state.settings, bad);
  ui.viewer.set({ ...start, ...settings });
  if (state.navigation) ui.viewer.setNavigation(state.navigation);
  if (state.view) ui.viewer.goTo(state.view, false);
  const known = state.pins.filter(({ whose }) => whose !== 'map' || ui.viewer.otherScene !== null);
  if (known.length < state.pins.length) bad.push('pin');
  pins.restore(known);
  if (bad.length > 0) ui.say(`Some of the address could not be used: ${[...new Set(bad)].join(', ')}.`);
}

/** Leaves out what this scene has not. */
function fitting({ viewer }: Ui, asked: Partial<Settings>, bad: string[]): Partial<Settings> {
  const settings = { ...asked };
  const leave = (key: keyof Settings, unless: boolean): void => {
    if (settings[key] === undefined || unless) return;
    delete settings[key];
    bad.push(key);
  };
  const layers = layerNames(viewer).length;
  leave('tone', viewer.scene.tones.some((t) => t.name === settings.tone));
  leave('colourMap', viewer.scene.colour_maps.some((m) => m.name === settings.colourMap));
  leave('dimming', settings.dimming?.length === layers);
  leave('otherDimming', settings.otherDimming?.length === layers);
  leave('mode', settings.mode === undefined || modesOf(viewer).includes(settings.mode));
  leave('compare', settings.compare !== 'maps' || isComparable(viewer));
  return settings;
}
