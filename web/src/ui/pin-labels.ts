// Numbers of pins over the view.

import { h, perFrame, replace } from './dom';
import { quantity } from './format';
import { seen } from './pin-renew';
import type { Pin, Pins } from './pins';
import type { Ui } from './ui';

export function pinLabels(ui: Ui, pins: Pins): HTMLElement {
  const root = h('div', { class: 'pin-labels' });
  let labels: { pin: Pin; label: HTMLElement }[] = [];
  const place = perFrame(() => labels.forEach(({ pin, label }) => put(ui, pin, label)));
  pins.onChange(() => {
    labels = pins.all().map((pin) => ({ pin, label: label(pins, pin) }));
    replace(root, ...labels.map((l) => l.label));
    place();
  });
  ui.viewer.on('view', place);
  new ResizeObserver(place).observe(ui.canvas);
  return root;
}

function label(pins: Pins, pin: Pin): HTMLElement {
  const isChosen = pins.chosen() === pin;
  return h('button', { type: 'button', tabindex: -1, class: `pin-label${isChosen ? ' chosen' : ''}`, onclick: () => pins.choose(pin) },
    h('span', { class: 'pin-number' }, String(pin.number)), h('span', {}, quantity(pin.reading.illuminance_lx, 'lx')));
}

function put(ui: Ui, { reading }: Pin, label: HTMLElement): void {
  const found = reading.position && seen(ui, reading.position);
  label.hidden = !found;
  if (!found) return;
  label.classList.toggle('behind', found.hidden);
  label.style.transform = `translate(${found.at[0]}px, ${found.at[1]}px)`;
}
