// Exposure and tone operator.

import { h, perFrame, select, setText, toggle } from './dom';
import { significant } from './format';
import type { Ui } from './ui';

const [LEAST_EV, MOST_EV] = [-4, 18];

export function exposure({ viewer }: Ui): HTMLElement {
  const automatic = toggle('Automatic', viewer.settings.autoExposure, (autoExposure) =>
    viewer.set(autoExposure ? { autoExposure } : { autoExposure, ev100: viewer.exposure().ev100 }));
  const set = perFrame((ev100: number) => viewer.set({ autoExposure: false, ev100 }));
  const slider = h('input', { type: 'range', min: LEAST_EV, max: MOST_EV, step: 0.1, 'aria-label': 'Exposure value at ISO 100', oninput: () => set(Number(slider.value)) });
  const ev = h('output', { class: 'figure' });
  const white = h('span', { class: 'faint' });
  const tone = select('Tone operator', viewer.scene.tones.map((t) => [t.name, t.label]), viewer.settings.tone, (name) => viewer.set({ tone: name }));
  const refresh = perFrame(() => {
    const now = viewer.exposure();
    automatic.input.checked = viewer.settings.autoExposure;
    tone.value = viewer.settings.tone;
    if (document.activeElement !== slider || viewer.settings.autoExposure) slider.value = String(now.ev100);
    slider.setAttribute('aria-valuetext', `EV ${now.ev100.toFixed(1)}`);
    setText(ev, `EV ${now.ev100.toFixed(1)}`);
    setText(white, `white ${significant(now.whiteCdM2, 3)} cd/m²`);
  });
  viewer.on('exposure', refresh);
  viewer.on('settings', refresh);
  refresh();
  return h('section', { class: 'block' }, h('h3', {}, 'Exposure'),
    h('div', { class: 'row spread' }, automatic.row, h('div', { class: 'row' }, ev, white)),
    slider, h('label', { class: 'row spread' }, h('span', {}, 'Tone operator'), tone));
}
