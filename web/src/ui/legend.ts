// The scale of false colours: bar, ticks, limits to edit.

import type { Legend, Settings } from '../contract';
import { h, perFrame, segments, select, setText, toggle } from './dom';
import { tick } from './format';
import { icon } from './icons';
import { MODE_NAMES, type Ui } from './ui';

export function legend(ui: Ui): HTMLElement {
  const { viewer } = ui;
  const title = h('div', { class: 'legend-title' });
  const bar = h('div', { class: 'legend-bar', 'aria-hidden': 'true' });
  const ticks = h('div', { class: 'legend-ticks', 'aria-hidden': 'true' });
  const high = limit('Upper limit', (value) => setLimits(ui, { high: value }));
  const low = limit('Lower limit', (value) => setLimits(ui, { low: value }));
  const units = [h('span', { class: 'faint' }), h('span', { class: 'faint' })];
  const row = (input: HTMLElement, unit: HTMLElement): HTMLElement => h('div', { class: 'legend-row' }, input, unit);
  const more = options(ui);
  const gear = h('button', { type: 'button', class: 'quiet', 'aria-label': 'Scale options', title: 'Scale options', 'aria-expanded': 'false',
    onclick: () => {
      more.root.hidden = !more.root.hidden;
      root.classList.toggle('open', !more.root.hidden);
      gear.setAttribute('aria-expanded', String(!more.root.hidden));
    } }, icon('gear'));
  const root = h('section', { class: 'legend card', 'aria-label': 'Scale' },
    h('header', {}, title, gear), row(high.input, units[0]!), h('div', { class: 'legend-scale' }, bar, ticks), row(low.input, units[1]!), more.root);
  const refresh = perFrame(() => {
    const now = viewer.legend();
    root.hidden = now === null;
    if (!now) return;
    setText(title, MODE_NAMES[viewer.settings.mode]);
    title.dataset.unit = now.unit;
    units.forEach((u) => setText(u, now.unit));
    bar.style.setProperty('--colours', now.colours.join(', '));
    ticks.replaceChildren(...placed(now));
    high.show(now.high);
    low.show(now.low);
    more.refresh();
  });
  viewer.on('legend', refresh);
  viewer.on('settings', refresh);
  refresh();
  return root;
}

/** Where on the bar a value is, 0 to 1. */
export function position(of: Legend, value: number): number {
  const at = of.logarithmic && of.low > 0
    ? Math.log(value / of.low) / Math.log(of.high / of.low)
    : (value - of.low) / (of.high - of.low);
  return Number.isFinite(at) ? at : 0;
}

function placed(of: Legend): HTMLElement[] {
  const marks = of.ticks.map((value) => ({ value, at: position(of, value) })).filter(({ at }) => at >= 0 && at <= 1);
  const spare = spareTicks(marks.map(({ value }) => value));
  return marks.map(({ value, at }, i) => {
    const mark = h('span', { class: [at < 0.04 || at > 0.96 ? 'end' : '', spare.has(i) ? 'spare' : ''].join(' ').trim() || null }, tick(value));
    mark.style.setProperty('--at', `${100 * at}%`);
    return mark;
  });
}

/** Width of a scale that lies on a phone, and of a sign on it, CSS pixels. */
const [LYING, SIGN] = [320, 7.5];

/** Every other tick, where all of them have no room side by side; nought and the first one stay. */
export function spareTicks(values: number[]): Set<number> {
  const width = values.reduce((sum, value) => sum + SIGN * (tick(value).length + 1), 0);
  const kept = Math.max(0, values.indexOf(0)) % 2;
  return new Set(width > LYING ? [...values.keys()].filter((i) => i % 2 !== kept) : []);
}

/** Changes one limit; says why where that cannot be. */
function setLimits({ viewer, say }: Ui, change: Partial<{ low: number; high: number }>): void {
  const now = viewer.legend();
  if (!now) return;
  const limits = { low: change.low ?? now.low, high: change.high ?? now.high };
  if (limits.low >= limits.high) say('The lower limit has to be less than the upper one.', 'bad');
  else if (viewer.settings.logarithmic && limits.low <= 0 && viewer.settings.mode !== 'difference') say('A logarithmic scale has to begin above 0.', 'bad');
  else viewer.set({ limits });
}

function limit(label: string, change: (value: number) => void): { input: HTMLInputElement; show(value: number): void } {
  let shown = 0;
  const read = (): void => {
    const value = Number(input.value.replace(',', '.').replace(/\s/g, '').replace('−', '-'));
    const typed = input.value.trim() !== '' && Number.isFinite(value);
    if (typed && value !== shown) change(value);
    input.value = tick(shown);
  };
  const input = h('input', { class: 'legend-limit', type: 'text', inputmode: 'decimal', 'aria-label': label, title: `${label}: click to edit`, onchange: read });
  input.addEventListener('focus', () => input.select());
  input.addEventListener('keydown', (event) => {
    if (event.key === 'Enter' || event.key === 'Escape') {
      if (event.key === 'Escape') input.value = tick(shown);
      input.blur();
    }
  });
  return { input, show: (value) => {
    shown = Number(value.toPrecision(6));
    if (document.activeElement !== input) input.value = tick(shown);
  } };
}

/** Linear or logarithmic, colours, automatic limits. */
function options({ viewer }: Ui): { root: HTMLElement; refresh(): void } {
  const s = (): Readonly<Settings> => viewer.settings;
  const scale = segments('Scale', [['linear', 'Linear'], ['log', 'Log']] as const, 'linear', (v) => viewer.set({ logarithmic: v === 'log' }));
  const names = viewer.scene.colour_maps.map(({ name }): [string, string] => [name, name]);
  const colours = select('Colours', names, s().colourMap, (colourMap) => viewer.set({ colourMap }));
  const automatic = toggle('Automatic limits', s().limits === null, (on) => {
    const now = viewer.legend();
    viewer.set({ limits: on || !now ? null : { low: now.low, high: now.high } });
  });
  const root = h('div', { class: 'legend-options', hidden: true }, scale.row, colours, automatic.row);
  const refresh = (): void => {
    scale.show(s().logarithmic ? 'log' : 'linear');
    colours.value = s().colourMap;
    colours.disabled = s().mode === 'difference';
    automatic.input.checked = s().limits === null;
  };
  return { root, refresh };
}
