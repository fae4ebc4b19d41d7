// Short messages that come and go at the foot of the view.

import { h } from './dom';
import { icon } from './icons';

export type Kind = 'plain' | 'bad';

export interface Notices {
  root: HTMLElement;
  say(text: string, kind?: Kind): void;
}

const STAYS_MS = { plain: 3500, bad: 12000 };
const MOST = 3;

export function notices(): Notices {
  const root = h('div', { class: 'notices', role: 'status', 'aria-live': 'polite' });
  const say = (text: string, kind: Kind = 'plain'): void => {
    const same = [...root.children].find((n) => n.firstChild?.textContent === text);
    same?.remove();
    const note = h('div', { class: `notice ${kind}` }, h('span', {}, text),
      h('button', { type: 'button', class: 'quiet', 'aria-label': 'Close this message', onclick: () => note.remove() }, icon('close')));
    root.append(note);
    while (root.children.length > MOST) root.firstElementChild?.remove();
    window.setTimeout(() => note.remove(), STAYS_MS[kind]);
  };
  return { root, say };
}

/** Copies text, and says so or why not. */
export async function copy(text: string, what: string, say: Notices['say']): Promise<void> {
  try {
    await navigator.clipboard.writeText(text);
    say(`${what} copied.`);
  } catch {
    say(copyByHand(text) ? `${what} copied.` : `This browser does not let the page copy. ${what}: ${text}`, 'plain');
  }
}

/** The old way, for pages that are not of a secure origin. */
function copyByHand(text: string): boolean {
  const area = h('textarea', { class: 'off-screen', 'aria-hidden': 'true' });
  area.value = text;
  document.body.append(area);
  area.select();
  const copied = document.execCommand('copy');
  area.remove();
  return copied;
}

/** Offers bytes as a file. */
export function download(name: string, content: Blob | string, type = 'text/csv;charset=utf-8'): void {
  const blob = typeof content === 'string' ? new Blob([content], { type }) : content;
  const url = URL.createObjectURL(blob);
  h('a', { href: url, download: name }).click();
  window.setTimeout(() => URL.revokeObjectURL(url), 10_000);
}
