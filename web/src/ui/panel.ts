// The panel at the right (a sheet at the foot on phones), and the strip of tabs that opens it.

import { h } from './dom';
import { icon, type IconName } from './icons';

export interface Tab {
  id: string;
  label: string;
  icon: IconName;
  body: HTMLElement;
  /** Called when it comes to sight and when it leaves. */
  shown?(is: boolean): void;
}

export interface Panel {
  root: HTMLElement;
  add(tab: Tab): void;
  open(id: string): void;
  close(): void;
  current(): string | null;
  /** A small number at a tab. */
  badge(id: string, text: string): void;
  onChange(call: () => void): void;
}

interface Held {
  tab: Tab;
  button: HTMLButtonElement;
  badge: HTMLElement;
}

export function panel(): Panel {
  const held = new Map<string, Held>();
  const changed: (() => void)[] = [];
  let current: string | null = null;
  const title = h('h2', {});
  const body = h('div', { class: 'panel-body' });
  const handle = h('div', { class: 'sheet-handle', 'aria-hidden': 'true' });
  const closing = h('button', { type: 'button', class: 'quiet', 'aria-label': 'Close the panel', title: 'Close the panel', onclick: () => show(null) }, icon('close'));
  const head = h('header', { class: 'panel-head' }, handle, title, closing);
  const sheet = h('section', { class: 'panel', hidden: true, 'aria-label': 'Details' }, head, body);
  const strip = h('nav', { class: 'tabs', 'aria-label': 'Panels' });
  const root = h('div', { class: 'side' }, sheet, strip);

  const show = (id: string | null): void => {
    if (id === current) return;
    const before = current ? held.get(current) : undefined;
    current = id;
    const now = id ? held.get(id) : undefined;
    before?.button.setAttribute('aria-expanded', 'false');
    now?.button.setAttribute('aria-expanded', 'true');
    sheet.hidden = !now;
    document.documentElement.classList.toggle('panel-open', Boolean(now));
    if (now) {
      title.textContent = now.tab.label;
      body.replaceChildren(now.tab.body);
      body.scrollTop = 0;
    }
    before?.tab.shown?.(false);
    now?.tab.shown?.(true);
    changed.forEach((call) => call());
  };
  dragSheet(head, sheet, () => show(null));
  return {
    root,
    add: (tab) => {
      const badge = h('span', { class: 'badge', hidden: true });
      const button = h('button', { type: 'button', 'aria-expanded': 'false', title: tab.label, onclick: () => show(current === tab.id ? null : tab.id) },
        icon(tab.icon), h('span', {}, tab.label), badge);
      held.set(tab.id, { tab, button, badge });
      strip.append(button);
    },
    open: show,
    close: () => show(null),
    current: () => current,
    badge: (id, text) => {
      const of = held.get(id)?.badge;
      if (!of) return;
      of.textContent = text;
      of.hidden = text === '';
    },
    onChange: (call) => void changed.push(call),
  };
}

/** On phones the head of the sheet drags it taller, lower, or away. */
function dragSheet(head: HTMLElement, sheet: HTMLElement, close: () => void): void {
  let from: { y: number; height: number } | null = null;
  head.addEventListener('pointerdown', (event) => {
    const isSheet = getComputedStyle(head.firstElementChild!).display !== 'none';
    if (!isSheet || (event.target as Element).closest('button')) return;
    from = { y: event.clientY, height: sheet.offsetHeight };
    head.setPointerCapture(event.pointerId);
  });
  head.addEventListener('pointermove', (event) => {
    if (from) document.documentElement.style.setProperty('--sheet', `${Math.max(90, from.height + from.y - event.clientY)}px`);
  });
  const end = (): void => {
    if (from && sheet.offsetHeight < 130) {
      document.documentElement.style.removeProperty('--sheet');
      close();
    }
    from = null;
  };
  head.addEventListener('pointerup', end);
  head.addEventListener('pointercancel', end);
}
