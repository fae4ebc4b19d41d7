// What is compared, and the slider over the view.

import type { Settings } from '../contract';
import { h, perFrame, segments, setText } from './dom';
import { differenceNames, isComparable, sideNames, type Ui } from './ui';

/** The choice, in the panel. */
export function compareChoice(ui: Ui): HTMLElement {
  const { viewer } = ui;
  const options: (readonly [Settings['compare'], string])[] = [['off', 'Off'], ['dimmings', 'Two dimmings']];
  if (isComparable(viewer)) options.splice(1, 0, ['maps', 'Two maps']);
  const choice = segments('Compare', options, viewer.settings.compare, (compare) => viewer.set(
    compare === 'dimmings' && viewer.settings.compare !== 'dimmings' ? { compare, otherDimming: [...viewer.settings.dimming] } : { compare }));
  const hint = h('p', { class: 'faint' });
  const refresh = (): void => {
    choice.show(viewer.settings.compare);
    const [left, right] = sideNames(viewer, viewer.settings.compare);
    const { compare } = viewer.settings;
    setText(hint, compare === 'off' ? 'Two states of the light side by side, with a slider between.'
      : compare === 'maps' ? `Left: ${left}. Right: ${right}.` : 'The dimmers change the side that is chosen above them.');
  };
  viewer.on('settings', refresh);
  refresh();
  return h('section', { class: 'block' }, h('h3', {}, 'Compare'), choice.row, hint);
}

/** The slider over the view, with names left and right. */
export function compareSlider(ui: Ui): HTMLElement {
  const { viewer, stage } = ui;
  const [left, right] = [h('span', { class: 'side-name left' }), h('span', { class: 'side-name right' })];
  const grip = h('div', { class: 'split-grip', role: 'slider', tabindex: 0, 'aria-label': 'Where the two sides meet', 'aria-valuemin': 0, 'aria-valuemax': 100, 'aria-orientation': 'horizontal' },
    h('span', { 'aria-hidden': 'true' }, '‹ ›'));
  const root = h('div', { class: 'split', hidden: true }, left, right, grip);
  const set = perFrame((split: number) => viewer.set({ split: Math.min(1, Math.max(0, split)) }));
  const refresh = (): void => {
    const { compare, mode, split } = viewer.settings;
    const isDifference = mode === 'difference';
    root.hidden = compare === 'off' && !isDifference;
    root.classList.toggle('difference', isDifference);
    root.style.setProperty('--split', `${100 * split}%`);
    grip.setAttribute('aria-valuenow', String(Math.round(100 * split)));
    const names = isDifference ? differenceNames(viewer) : sideNames(viewer, compare);
    setText(left, isDifference ? names.join('  −  ') : names[0]);
    setText(right, names[1]);
  };
  grip.addEventListener('pointerdown', (event) => {
    event.preventDefault();
    grip.focus({ preventScroll: true });
    grip.setPointerCapture(event.pointerId);
  });
  grip.addEventListener('pointermove', (event) => {
    if (!grip.hasPointerCapture(event.pointerId)) return;
    const box = stage.getBoundingClientRect();
    set((event.clientX - box.left) / box.width);
  });
  grip.addEventListener('keydown', (event) => {
    const to = moved(event, viewer.settings.split);
    if (to === null) return;
    event.preventDefault();
    event.stopPropagation();
    set(to);
  });
  viewer.on('settings', refresh);
  refresh();
  return root;
}

function moved(event: KeyboardEvent, split: number): number | null {
  const step = event.shiftKey ? 0.1 : 0.02;
  if (event.key === 'ArrowLeft' || event.key === 'ArrowDown') return split - step;
  if (event.key === 'ArrowRight' || event.key === 'ArrowUp') return split + step;
  if (event.key === 'Home') return 0;
  return event.key === 'End' ? 1 : null;
}
