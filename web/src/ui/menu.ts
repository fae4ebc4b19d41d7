// A button with a menu under it: arrow keys, Home and End, Escape, first letters.

import { h, replace } from './dom';
import { icon, type IconName } from './icons';

export interface Item {
  label: string;
  /** A key, at the right. */
  hint?: string;
  /** Marked as chosen; undefined: an item that only acts. */
  checked?: boolean;
  /** A line above it. */
  divided?: boolean;
  act(): void;
}

export interface MenuButton {
  root: HTMLElement;
  button: HTMLButtonElement;
  /** What the button says. */
  label(text: string): void;
}

export function menuButton(
  options: { name: string; icon?: IconName; text?: string; arrow?: boolean; end?: boolean; items: () => Item[] },
): MenuButton {
  const words = h('span', { class: 'button-text' }, options.text ?? '');
  const button = h('button', { type: 'button', class: 'bar-button', 'aria-haspopup': 'menu', 'aria-expanded': 'false', 'aria-label': options.name, title: options.name });
  if (options.icon) button.append(icon(options.icon));
  if (options.text !== undefined) button.append(words);
  if (options.arrow) button.append(icon('down'));
  const list = h('div', { class: `menu${options.end ? ' menu-end' : ''}`, role: 'menu', 'aria-label': options.name, hidden: true });
  const root = h('div', { class: 'menu-root' }, button, list);
  wire(root, button, list, options.items);
  return { root, button, label: (text) => {
    words.textContent = text;
    button.setAttribute('aria-label', `${options.name}: ${text}`);
  } };
}

function wire(root: HTMLElement, button: HTMLButtonElement, list: HTMLElement, items: () => Item[]): void {
  const close = (back: boolean): void => {
    if (list.hidden) return;
    list.hidden = true;
    button.setAttribute('aria-expanded', 'false');
    if (back) button.focus();
  };
  const open = (): void => {
    replace(list, ...items().map((item) => row(item, () => close(true))));
    list.hidden = false;
    button.setAttribute('aria-expanded', 'true');
    const rows = rowsOf(list);
    (rows.find((r) => r.getAttribute('aria-checked') === 'true') ?? rows[0])?.focus();
  };
  button.addEventListener('click', () => (list.hidden ? open() : close(true)));
  button.addEventListener('keydown', (event) => {
    if (event.key === 'ArrowDown' && list.hidden) {
      event.preventDefault();
      open();
    }
  });
  list.addEventListener('keydown', (event) => {
    event.stopPropagation();
    if (event.key === 'Escape') close(true);
    else if (event.key === 'Tab') close(false);
    else if (move(list, event.key)) event.preventDefault();
  });
  root.addEventListener('focusout', (event) => {
    if (!(event.relatedTarget instanceof Node && root.contains(event.relatedTarget))) close(false);
  });
  document.addEventListener('pointerdown', (event) => {
    if (event.target instanceof Node && !root.contains(event.target)) close(false);
  });
}

function row(item: Item, close: () => void): HTMLElement {
  const role = item.checked === undefined ? 'menuitem' : 'menuitemradio';
  const act = (): void => {
    close();
    item.act();
  };
  return h('button', {
    type: 'button', role, tabindex: -1, class: item.divided ? 'divided' : null,
    'aria-checked': item.checked === undefined ? null : String(item.checked), onclick: act,
  }, h('span', { class: 'tick' }, item.checked ? icon('check') : ''), h('span', { class: 'item' }, item.label),
  item.hint ? h('kbd', {}, item.hint) : null);
}

function rowsOf(list: HTMLElement): HTMLElement[] {
  return [...list.querySelectorAll<HTMLElement>('[role^=menuitem]')];
}

/** Moves the focus; whether the key was one of these. */
function move(list: HTMLElement, key: string): boolean {
  const rows = rowsOf(list);
  const at = rows.indexOf(document.activeElement as HTMLElement);
  const to = {
    ArrowDown: rows[(at + 1) % rows.length], ArrowUp: rows[(at - 1 + rows.length) % rows.length], Home: rows[0], End: rows.at(-1),
  }[key] ?? (key.length === 1 ? byLetter(rows, at, key) : undefined);
  to?.focus();
  return to !== undefined;
}

function byLetter(rows: HTMLElement[], at: number, letter: string): HTMLElement | undefined {
  const turned = [...rows.slice(at + 1), ...rows.slice(0, at + 1)];
  return turned.find((r) => r.querySelector('.item')?.textContent?.toLowerCase().startsWith(letter.toLowerCase()));
}
