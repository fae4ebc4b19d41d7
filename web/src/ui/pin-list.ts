// The list of pins in the panel.

import { pinLine, pinsCsv, ptsLine, fileName } from './csv';
import { h, replace } from './dom';
import { withError } from './format';
import { icon } from './icons';
import { copy, download } from './notices';
import type { Pin, Pins } from './pins';
import { details, normalText, placeText, sourceText } from './reading';
import { whoseMark, whoseName, type Ui } from './ui';

export function pinList(ui: Ui, pins: Pins): HTMLElement {
  const list = h('ol', { class: 'pin-list' });
  const tools = h('div', { class: 'row' },
    h('button', { type: 'button', onclick: () => exportCsv(ui, pins) }, icon('download'), 'CSV'),
    h('button', { type: 'button', onclick: () => exportPts(ui, pins) }, icon('download'), 'Points (.pts)'),
    h('button', { type: 'button', class: 'end', onclick: () => pins.clear() }, 'Remove all'));
  const empty = h('div', { class: 'empty' }, icon('pin'),
    h('p', {}, 'Point at a surface to read it. Click (or tap) to keep a reading here.'),
    h('p', { class: 'faint' }, ui.source.hello.readings === 'probe'
      ? 'Kept readings are those of isolux probe: direct light is evaluated afresh at the place.'
      : 'Readings are interpolated between vertices of the map.'));
  const refresh = (): void => {
    const all = pins.all();
    replace(list, ...all.map((pin) => row(ui, pins, pin)));
    empty.hidden = all.length > 0;
    tools.hidden = all.length === 0;
    ui.panel.badge('readings', all.length > 0 ? String(all.length) : '');
    list.querySelector('.chosen')?.scrollIntoView({ block: 'nearest' });
  };
  pins.onChange(refresh);
  let compare = ui.viewer.settings.compare;
  ui.viewer.on('settings', () => {
    if (ui.viewer.settings.compare !== compare && pins.all().length > 0) refresh();
    compare = ui.viewer.settings.compare;
  });
  refresh();
  return h('section', { class: 'block' }, empty, list, tools);
}

function row(ui: Ui, pins: Pins, pin: Pin): HTMLElement {
  const r = pin.reading;
  const isChosen = pins.chosen() === pin;
  const head = h('button', { type: 'button', class: 'pin-head', 'aria-expanded': String(isChosen), onclick: () => pins.choose(isChosen ? null : pin) },
    h('span', { class: 'pin-number' }, String(pin.number)), h('span', { class: pin.stale ? 'pin-value faint' : 'pin-value' }, withError(r.illuminance_lx, r.standard_error_lx, 'lx')),
    h('span', { class: 'faint clip' }, [whoseMark(ui.viewer, pin.whose), r.shape].filter(Boolean).join(' · ')));
  return h('li', { class: isChosen ? 'chosen' : null, title: pin.stale ? 'Read before the light changed' : null },
    h('div', { class: 'row tight' }, head, h('button', { type: 'button', class: 'quiet', 'aria-label': `Remove pin ${pin.number}`, title: 'Remove', onclick: () => pins.remove(pin) }, icon('close'))),
    isChosen ? card(ui, pin) : null);
}

function card(ui: Ui, { reading: r, stale, whose }: Pin): HTMLElement {
  const of = whoseName(ui.viewer, whose);
  return h('div', { class: 'pin-card' }, details(r),
    h('dl', { class: 'facts wide-facts' }, of && h('dt', {}, 'Of'), of && h('dd', {}, of), h('dt', {}, 'Position'), h('dd', {}, placeText(r.position)), h('dt', {}, 'Normal'), h('dd', {}, normalText(r.normal)),
      h('dt', {}, 'Value'), h('dd', {}, stale ? 'read before the light changed' : sourceText(r))),
    h('div', { class: 'row' },
      h('button', { type: 'button', onclick: () => void copy(pinLine(r), 'CSV line', ui.say) }, icon('copy'), 'CSV line'),
      h('button', { type: 'button', onclick: () => void copy(ptsLine(r), 'Point', ui.say) }, icon('copy'), '.pts line')));
}

function exportCsv({ viewer }: Ui, pins: Pins): void {
  download(fileName([viewer.scene.name, 'readings'], 'csv'), pinsCsv(pins.all().map((p) => p.reading), pins.all().map((p) => whoseName(viewer, p.whose))));
}

function exportPts({ viewer }: Ui, pins: Pins): void {
  const lines = pins.all().map((p) => ptsLine(p.reading));
  download(fileName([viewer.scene.name, 'points'], 'pts'), `${lines.join('\n')}\n`, 'text/plain;charset=utf-8');
}
