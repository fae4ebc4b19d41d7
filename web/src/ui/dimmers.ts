// Dimmers of the layers of light, and two dimmings side by side.

import { h, perFrame, segments, setText } from './dom';
import { MOST, parsePercent, percentText } from './percent';
import { layerNames, type Ui } from './ui';

type Side = 'dimming' | 'otherDimming';

export function dimmers(ui: Ui): HTMLElement {
  const { viewer } = ui;
  let side: Side = 'dimming';
  const names = layerNames(viewer);
  // Changes since the last picture, so that two dimmers can move in one.
  const moved = new Map<number, number>();
  const set = perFrame((of: Side) => {
    const values = names.map((_, k) => moved.get(k) ?? viewer.settings[of][k] ?? 1);
    moved.clear();
    viewer.set({ [of]: values });
  });
  const change = (i: number, factor: number): void => {
    moved.set(i, factor);
    set(side);
  };
  const rows = names.map((name, i) => dimmer(name, (factor) => change(i, factor)));
  const reset = h('button', { type: 'button', onclick: () => viewer.set({ [side]: names.map(() => 1) }) }, 'Reset');
  const compare = h('button', { type: 'button', onclick: () => {
    const on = viewer.settings.compare !== 'dimmings';
    viewer.set(on ? { compare: 'dimmings', otherDimming: [...viewer.settings.dimming] } : { compare: 'off' });
    pick(on ? 'otherDimming' : 'dimming');
  } });
  const which = segments('Which side the dimmers change', [['dimming', 'Left: A'], ['otherDimming', 'Right: B']] as const, side, (v) => pick(v));
  const refresh = perFrame(() => {
    const comparing = viewer.settings.compare === 'dimmings';
    if (!comparing && side === 'otherDimming') side = 'dimming';
    which.row.hidden = !comparing;
    which.show(side);
    setText(compare, comparing ? 'End comparison' : 'Compare with another dimming');
    rows.forEach((row, i) => row.show(viewer.settings[side][i] ?? 1));
    reset.disabled = rows.every((_, i) => (viewer.settings[side][i] ?? 1) === 1);
  });
  const pick = (v: Side): void => {
    side = v;
    refresh();
  };
  viewer.on('settings', refresh);
  refresh();
  return h('section', { class: 'block' }, h('h3', {}, names.length > 1 ? 'Dimmers' : 'Dimmer'), which.row,
    h('div', { class: 'dimmers' }, ...rows.map((r) => r.root)), h('div', { class: 'row' }, compare, reset));
}

let dimmersMade = 0;

function dimmer(name: string, change: (factor: number) => void): { root: HTMLElement; show(factor: number): void } {
  const slider = h('input', { type: 'range', min: 0, max: MOST * 100, step: 1, 'aria-label': name, oninput: () => act(Number(slider.value) / 100) });
  const problem = h('p', { class: 'problem', role: 'alert', hidden: true, id: `dimmer-problem-${++dimmersMade}` });
  const tell = (said: string): void => {
    setText(problem, said);
    problem.hidden = said === '';
    text.setAttribute('aria-invalid', String(said !== ''));
  };
  const text = h('input', { type: 'text', inputmode: 'decimal', class: 'percent', 'aria-label': `${name}, per cent`, 'aria-describedby': problem.id, oninput: () => tell(''), onchange: () => {
    const typed = parsePercent(text.value);
    if ('factor' in typed) {
      act(typed.factor);
      write();
    } else tell(`${typed.problem} It stays at ${percentText(shown)}.`);
  } });
  text.addEventListener('keydown', (event) => {
    if (event.key === 'Escape') write();
  });
  const power = h('button', { type: 'button', class: 'quiet dimmer-name', title: 'On or off', onclick: () => act(shown > 0 ? 0 : 1) },
    h('span', { class: 'lamp-dot', 'aria-hidden': 'true' }), h('span', {}, name));
  let shown = 1;
  const show = (factor: number): void => {
    const isSame = factor === shown;
    shown = factor;
    // What is wrong stays to be mended, until there is another value.
    if (!isSame || problem.hidden) write(document.activeElement === text);
    slider.value = String(Math.round(factor * 100));
    slider.setAttribute('aria-valuetext', percentText(factor));
    power.setAttribute('aria-pressed', String(factor > 0));
    root.style.setProperty('--on', String(Math.min(1, factor)));
  };
  const act = (factor: number): void => {
    // A light catch at 100 %: the state that the map was computed in is easy to come back to.
    const caught = Math.abs(factor - 1) < 0.015 ? 1 : factor;
    show(caught);
    change(caught);
  };
  const write = (isTyped = false): void => {
    tell('');
    if (!isTyped) text.value = percentText(shown);
  };
  const root = h('div', { class: 'dimmer' }, power, text, slider, problem);
  return { root, show };
}
