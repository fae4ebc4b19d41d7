// What is seen before there is a viewer, and where there cannot be one.

import '../style.css';
import { h, replace } from './dom';
import { applyTheme } from './theme';

function screen(): HTMLElement {
  applyTheme();
  return document.getElementById('ui') ?? document.body;
}

function mark(): HTMLElement {
  return h('p', { class: 'mark' }, h('span', { class: 'mark-dot', 'aria-hidden': 'true' }), 'isolux');
}

let words: HTMLElement | null = null;

/** Says what is being waited for; call it again with other words as things go on. */
export function showLoading(text: string): void {
  if (words?.isConnected) {
    words.textContent = text;
    return;
  }
  words = h('p', { class: 'splash-text' }, text);
  replace(screen(), h('div', { class: 'splash', role: 'status' },
    h('div', { class: 'splash-card' }, mark(), h('div', { class: 'splash-bar' }, h('i')), words)));
}

/** Says that there is nothing to see, and why. */
export function showFailure(text: string): void {
  words = null;
  const again = h('button', { type: 'button', class: 'primary', onclick: () => location.reload() }, 'Try again');
  replace(screen(), h('div', { class: 'splash', role: 'alert' },
    h('div', { class: 'splash-card' }, mark(), h('h1', {}, 'This map cannot be shown'), h('p', { class: 'splash-text' }, text), again)));
  again.focus();
}
