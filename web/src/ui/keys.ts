// Keys of the page. None acts while somebody writes, and those that walk do not act while walking.

import type { Action } from './actions';
import { isTyping } from './dom';
import type { Ui } from './ui';

/** Listens to keys; `escape` closes what is open. */
export function listenToKeys(ui: Ui, actions: Action[], escape: () => void): void {
  const byKey = new Map(actions.map((a) => [a.key, a]));
  document.addEventListener('keydown', (event) => {
    if (event.defaultPrevented || event.ctrlKey || event.metaKey || event.altKey || isTyping(event.target)) return;
    if (event.key === 'Escape') {
      // A dialog closes by itself.
      if (!document.querySelector('dialog[open]')) escape();
      return;
    }
    const action = byKey.get(keyOf(event));
    if (!action || (event.repeat && !['[', ']'].includes(action.key)) || isForWalking(ui, action)) return;
    if (document.querySelector('dialog[open]') && action.id !== 'help') return;
    if (event.key === 'Home' && event.target instanceof HTMLElement && event.target.closest('.panel, input')) return;
    event.preventDefault();
    action.run();
  });
}

function keyOf(event: KeyboardEvent): string {
  const key = event.key.toLowerCase();
  return event.shiftKey && /^[a-z]$/.test(key) ? `shift+${key}` : key;
}

function isForWalking(ui: Ui, action: Action): boolean {
  return Boolean(action.walks) && (ui.viewer.navigation === 'walk' || document.pointerLockElement !== null);
}

/** A key as it is written on keyboards. */
export function keyText(key: string): string {
  if (key === 'home') return 'Home';
  return key.startsWith('shift+') ? `Shift ${key.slice(6).toUpperCase()}` : key.toUpperCase();
}
