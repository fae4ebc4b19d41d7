// The reading under the pointer: at once from vertices, and as `probe` reads it once the pointer rests.

import type { Both } from '../contract';
import type { Reading } from '../wire';
import { differenceLines } from './difference';
import { h, perFrame, replace, throttled } from './dom';
import { details, illuminanceLine, sourceText } from './reading';
import { differenceNames, whoseName, type Ui } from './ui';

const RESTS_MS = 80;
const AGAIN_MS = 300;

export interface Hover {
  root: HTMLElement;
  /** The pointer is here now (CSS pixels of the canvas). */
  at(x: number, y: number): void;
  /** Shows a reading that is known already, near a point. */
  show(reading: Reading | Both, x: number, y: number): void;
  hide(): void;
}

export function hover(ui: Ui): Hover {
  const { viewer, stage } = ui;
  const root = h('div', { class: 'hover card', role: 'status', 'aria-live': 'off', hidden: true });
  let asked: AbortController | null = null;
  let timer: number | undefined;
  const forget = (): void => {
    window.clearTimeout(timer);
    asked?.abort();
    asked = null;
  };
  const ask = async (x: number, y: number): Promise<void> => {
    const mine = new AbortController();
    asked = mine;
    try {
      const found = isDifference() ? await viewer.readBothAt(x, y, mine.signal) : await viewer.readAt(x, y, mine.signal);
      if (!mine.signal.aborted && found) present(found, x, y);
    } catch {
      // A reading that failed leaves the interpolated value; the viewer tells what went wrong.
    }
  };
  const isDifference = (): boolean => viewer.settings.mode === 'difference';
  const present = (found: Reading | Both, x: number, y: number, glance = false): void => {
    if ('other' in found) {
      replace(root, ...differenceLines(found, differenceNames(viewer)),
        h('p', { class: 'faint' }, glance ? 'between vertices' : `${sourceText(found.own)}; ± as if both erred by themselves`));
    } else {
      replace(root, illuminanceLine(found), details(found), h('p', { class: 'faint' }, glance ? 'between vertices' : sourceText(found)), sideNote(ui, x));
    }
    root.hidden = false;
    place(root, stage, x, y);
  };
  const glance = perFrame((x: number, y: number, mine: number) => {
    if (mine !== moves) return;
    const found = isDifference() ? viewer.glanceBothAt(x, y) : viewer.glanceAt(x, y);
    if (found) present(found, x, y, true);
    else root.hidden = true;
  });
  let moves = 0;
  let here: [number, number] | null = null;
  const at = (x: number, y: number): void => {
    here = [x, y];
    forget();
    glance(x, y, ++moves);
    timer = window.setTimeout(() => void ask(x, y), RESTS_MS);
  };
  // What is read changes with the light under a pointer that rests.
  const again = throttled(() => {
    if (here && !root.hidden) at(...here);
  }, AGAIN_MS);
  viewer.on('light', again);
  viewer.on('settings', again);
  return {
    root, at,
    show: (reading, x, y) => {
      here = null;
      forget();
      moves++;
      present(reading, x, y);
    },
    hide: () => {
      here = null;
      forget();
      moves++;
      root.hidden = true;
    },
  };
}

/** Whose value it is, where two are shown. */
function sideNote({ viewer }: Ui, x: number): HTMLElement | null {
  return viewer.settings.compare === 'off' ? null : h('p', { class: 'faint clip' }, `of ${whoseName(viewer, viewer.whoseAt(x))}`);
}

/** Beside the point, on the side where there is room. */
function place(card: HTMLElement, stage: HTMLElement, x: number, y: number): void {
  const [width, height] = [card.offsetWidth, card.offsetHeight];
  const left = x + 18 + width < stage.clientWidth ? x + 18 : x - 18 - width;
  const top = y + 18 + height < stage.clientHeight ? y + 18 : y - 18 - height;
  const inside = (v: number, most: number): number => Math.max(6, Math.min(v, most));
  // On phones it lies at the foot, above the scale, or at the head where that would hide what is read.
  card.classList.toggle('at-head', y > stage.clientHeight / 2);
  card.style.transform = `translate(${inside(left, stage.clientWidth - width - 6)}px, ${inside(top, stage.clientHeight - height - 6)}px)`;
}
