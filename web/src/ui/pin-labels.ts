// Numbers of pins over the view.

import { h, perFrame, replace } from './dom';
import { quantity } from './format';
import { seen } from './pin-renew';
import type { Pin, Pins } from './pins';
import { whoseMark, whoseName, type Ui } from './ui';

export function pinLabels(ui: Ui, pins: Pins): HTMLElement {
  const root = h('div', { class: 'pin-labels' });
  let labels: { pin: Pin; label: HTMLElement }[] = [];
  const place = perFrame(() => labels.forEach(({ pin, label }) => put(ui, pin, label)));
  const renew = (): void => {
    labels = pins.all().map((pin) => ({ pin, label: label(ui, pins, pin) }));
    replace(root, ...labels.map((l) => l.label));
    place();
  };
  pins.onChange(renew);
  let compare = ui.viewer.settings.compare;
  ui.viewer.on('settings', () => {
    if (ui.viewer.settings.compare !== compare) renew();
    compare = ui.viewer.settings.compare;
  });
  ui.viewer.on('view', place);
  new ResizeObserver(place).observe(ui.canvas);
  return root;
}

function label(ui: Ui, pins: Pins, pin: Pin): HTMLElement {
  const isChosen = pins.chosen() === pin;
  const mark = whoseMark(ui.viewer, pin.whose);
  return h('button', { type: 'button', tabindex: -1, title: mark && `of ${whoseName(ui.viewer, pin.whose)}`, class: `pin-label${isChosen ? ' chosen' : ''}`, onclick: () => pins.choose(pin) },
    h('span', { class: 'pin-number' }, String(pin.number)), h('span', {}, quantity(pin.reading.illuminance_lx, 'lx')), mark && h('span', { class: 'pin-of' }, mark));
}

function put(ui: Ui, { reading }: Pin, label: HTMLElement): void {
  const found = reading.position && seen(ui, reading.position);
  label.hidden = !found;
  if (!found) return;
  label.classList.toggle('behind', found.hidden);
  label.style.transform = `translate(${found.at[0]}px, ${found.at[1]}px)`;
}
