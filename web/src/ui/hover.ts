// The reading under the pointer: at once from vertices, and as `probe` reads it once the pointer rests.

import type { Reading } from '../wire';
import { h, perFrame, replace, throttled } from './dom';
import { details, illuminanceLine, sourceText } from './reading';
import { sideNames, type Ui } from './ui';

const RESTS_MS = 80;
const AGAIN_MS = 300;

export interface Hover {
  root: HTMLElement;
  /** The pointer is here now (CSS pixels of the canvas). */
  at(x: number, y: number): void;
  /** Shows a reading that is known already, near a point. */
  show(reading: Reading, x: number, y: number): void;
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
      const reading = await ui.viewer.readAt(x, y, mine.signal);
      if (!mine.signal.aborted && reading?.position) show(reading, x, y);
    } catch {
      // A reading that failed leaves the interpolated value; the viewer tells what went wrong.
    }
  };
  const show = (reading: Reading, x: number, y: number, glance = false): void => {
    replace(root, illuminanceLine(reading), details(reading),
      h('p', { class: 'faint' }, glance ? 'between vertices' : sourceText(reading)), sideNote(ui, x));
    root.hidden = false;
    place(root, stage, x, y);
  };
  const glance = perFrame((x: number, y: number, mine: number) => {
    if (mine !== moves) return;
    const reading = viewer.glanceAt(x, y);
    if (reading?.position) show(reading, x, y, true);
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
      show(reading, x, y);
    },
    hide: () => {
      here = null;
      forget();
      moves++;
      root.hidden = true;
    },
  };
}

/** Readings are those of the left side, also where the right one is seen. */
/** Whose value it is, where two are shown. */
function sideNote({ viewer, canvas }: Ui, x: number): HTMLElement | null {
  const { compare, split } = viewer.settings;
  const isRight = compare === 'maps' && viewer.otherScene !== null && x > split * canvas.clientWidth;
  return compare === 'off' ? null : h('p', { class: 'faint clip' }, `of ${sideNames(viewer, compare)[isRight ? 1 : 0]}`);
}

/** Beside the point, on the side where there is room. */
function place(card: HTMLElement, stage: HTMLElement, x: number, y: number): void {
  const [width, height] = [card.offsetWidth, card.offsetHeight];
  const left = x + 18 + width < stage.clientWidth ? x + 18 : x - 18 - width;
  const top = y + 18 + height < stage.clientHeight ? y + 18 : y - 18 - height;
  const inside = (v: number, most: number): number => Math.max(6, Math.min(v, most));
  card.style.transform = `translate(${inside(left, stage.clientWidth - width - 6)}px, ${inside(top, stage.clientHeight - height - 6)}px)`;
}
