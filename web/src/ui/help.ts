// The list of keys, and how to move about.

import type { Action } from './actions';
import { h } from './dom';
import { icon } from './icons';
import { keyText } from './keys';

const MOVING: [string, string][] = [
  ['Drag', 'Orbit: turn around the point looked at'],
  ['Right drag', 'Orbit: move sideways'],
  ['Wheel', 'Orbit: nearer and farther'],
  ['W A S D', 'Walk (arrow keys too); Shift: faster'],
  ['Q  E', 'Walk: lower and higher (Page up and down too)'],
  ['Mouse', 'Walk: look around, once the view is clicked; Esc frees the pointer'],
  ['Two fingers', 'Touch: nearer, farther and sideways; walking: left half moves, right half looks'],
];

const READING: [string, string][] = [
  ['Point', 'The value under the pointer, with its standard error'],
  ['Click, tap', 'Pins the reading; pins are listed under Readings'],
  ['Esc', 'Closes what is open, ends the section tool'],
];

export interface Help {
  root: HTMLElement;
  toggle(): void;
  isOpen(): boolean;
  close(): void;
}

export function helpDialog(actions: Action[]): Help {
  const keys: [string, string][] = actions.map((a) => [keyText(a.key), a.label]);
  const root = h('dialog', { class: 'help', 'aria-label': 'Keys and help' },
    h('header', {}, h('h2', {}, 'Keys and help'),
      h('button', { type: 'button', class: 'quiet', 'aria-label': 'Close', onclick: () => root.close() }, icon('close'))),
    h('div', { class: 'help-columns' },
      h('div', {}, part('Moving', MOVING), part('Readings', READING)), part('Keys', keys)));
  root.addEventListener('click', (event) => {
    if (event.target === root) root.close();
  });
  return {
    root, isOpen: () => root.open, close: () => root.close(), toggle: () => (root.open ? root.close() : root.showModal()),
  };
}

function part(title: string, rows: [string, string][]): HTMLElement {
  return h('section', {}, h('h3', {}, title),
    h('dl', { class: 'key-list' }, ...rows.flatMap(([key, what]) => [h('dt', {}, h('kbd', {}, key)), h('dd', {}, what)])));
}
