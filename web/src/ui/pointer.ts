// Presses on the canvas: which are clicks and which are drags.

import type { Ui } from './ui';

const STILL_PX = 5;
const LONGEST_MS = 700;

export interface Pointing {
  /** The pointer is over the canvas and no button is down. */
  hover(x: number, y: number): void;
  leave(): void;
  click(x: number, y: number, touch: boolean): void;
}

/** Tells hovering, leaving and clicks, in CSS pixels of the canvas. With the pointer locked, the middle of the view is meant. */
export function watchPointer({ canvas, viewer }: Ui, on: Pointing): void {
  watchEnter(canvas, on);
  let down: { x: number; y: number; at: number; locked: boolean; moved: boolean } | null = null;
  let touches = 0;
  const isLocked = (): boolean => document.pointerLockElement !== null;
  const where = (event: PointerEvent): [number, number] => {
    const box = canvas.getBoundingClientRect();
    return isLocked() ? [box.width / 2, box.height / 2] : [event.clientX - box.left, event.clientY - box.top];
  };
  canvas.addEventListener('pointerdown', (event) => {
    touches += event.pointerType === 'touch' ? 1 : 0;
    down = event.button === 0 && touches < 2
      ? { x: event.clientX, y: event.clientY, at: event.timeStamp, locked: isLocked(), moved: false } : null;
    on.leave();
  });
  canvas.addEventListener('pointermove', (event) => {
    if (down && Math.hypot(event.clientX - down.x, event.clientY - down.y) > STILL_PX) down.moved = true;
    if (event.buttons === 0 && event.pointerType !== 'touch') on.hover(...where(event));
  });
  const end = (event: PointerEvent): void => {
    touches = Math.max(0, touches - (event.pointerType === 'touch' ? 1 : 0));
  };
  canvas.addEventListener('pointerup', (event) => {
    end(event);
    const was = down;
    down = null;
    // The press that locks the pointer is none that pins.
    if (!was || was.moved || event.timeStamp - was.at > LONGEST_MS || was.locked !== isLocked()) return;
    if (viewer.navigation === 'walk' && event.pointerType === 'mouse' && !was.locked) return;
    on.click(...where(event), event.pointerType === 'touch');
  });
  canvas.addEventListener('pointercancel', (event) => {
    end(event);
    down = null;
  });
  canvas.addEventListener('pointerleave', (event) => {
    // A finger that is lifted leaves too, and what it read is to be seen.
    if (event.pointerType !== 'touch') on.leave();
  });
  canvas.addEventListener('wheel', () => on.leave(), { passive: true });
  viewer.on('view', () => {
    if (isLocked()) on.hover(canvas.clientWidth / 2, canvas.clientHeight / 2);
  });
}

/** Without a pointer, Enter reads the middle of the view. */
function watchEnter(canvas: HTMLCanvasElement, on: Pointing): void {
  if (!canvas.hasAttribute('tabindex')) canvas.tabIndex = 0;
  if (!canvas.hasAttribute('aria-label')) canvas.setAttribute('aria-label', 'The scene. Enter reads the middle of the view.');
  canvas.addEventListener('keydown', (event) => {
    if (event.key === 'Enter' && !event.repeat) on.click(canvas.clientWidth / 2, canvas.clientHeight / 2, true);
  });
}
