// Keys, the locked pointer and fingers of somebody who walks.

const MOVES: Record<string, [number, number, number]> = {
  KeyW: [1, 0, 0], ArrowUp: [1, 0, 0], KeyS: [-1, 0, 0], ArrowDown: [-1, 0, 0], KeyD: [0, 1, 0], ArrowRight: [0, 1, 0],
  KeyA: [0, -1, 0], ArrowLeft: [0, -1, 0], KeyE: [0, 0, 1], PageUp: [0, 0, 1], KeyQ: [0, 0, -1], PageDown: [0, 0, -1],
};
const TURN = 0.0022;
const TOUCH_TURN = 0.005;
/** A finger this far from where it came down walks at full speed, px. */
const FULL_PX = 60;

const isTyping = (target: EventTarget | null): boolean => target instanceof HTMLElement && target.closest('input, textarea, select, [contenteditable], dialog') !== null;

export class WalkInput {
  readonly #held = new Set<string>();
  readonly #fingers = new Map<number, { x: number; y: number; walks: boolean }>();
  #stick: [number, number] = [0, 0];
  #isRunning = false;
  #end: AbortController | null = null;

  /** `turn` by radians to the right and up; `changed` whenever there is something to do. */
  constructor(readonly canvas: HTMLCanvasElement, readonly turn: (right: number, up: number) => void, readonly changed: () => void) {}

  start(): void {
    this.#end = new AbortController();
    const { signal } = this.#end;
    const on = <K extends keyof DocumentEventMap>(name: K, call: (event: DocumentEventMap[K]) => void): void => document.addEventListener(name, call, { signal });
    on('keydown', (event) => this.#key(event, true));
    on('keyup', (event) => this.#key(event, false));
    on('mousemove', (event) => this.#mouse(event));
    on('pointerlockchange', () => this.#held.clear());
    window.addEventListener('blur', () => this.#held.clear(), { signal });
    this.canvas.addEventListener('click', () => this.#lock(), { signal });
    this.canvas.addEventListener('pointerdown', (event) => this.#down(event), { signal });
    this.canvas.addEventListener('pointermove', (event) => this.#move(event), { signal });
    for (const name of ['pointerup', 'pointercancel'] as const) this.canvas.addEventListener(name, (event) => this.#up(event), { signal });
  }

  stop(): void {
    this.#end?.abort();
    this.#held.clear();
    this.#fingers.clear();
    this.#stick = [0, 0];
    if (document.pointerLockElement === this.canvas) document.exitPointerLock();
  }

  /** Which way to go: ahead, right, up; each from -1 to 1. */
  way(): [number, number, number] {
    const sum: [number, number, number] = [this.#stick[0], this.#stick[1], 0];
    for (const code of this.#held) MOVES[code]!.forEach((m, k) => (sum[k]! += m));
    return sum.map((m) => Math.max(-1, Math.min(1, m))) as [number, number, number];
  }

  get isRunning(): boolean {
    return this.#isRunning;
  }

  #lock(): void {
    // Without a locked pointer (refused, or not to be had) keys still work.
    if (document.pointerLockElement !== this.canvas && matchMedia('(pointer: fine)').matches) {
      void Promise.resolve(this.canvas.requestPointerLock?.()).catch(() => {});
    }
  }

  #key(event: KeyboardEvent, isDown: boolean): void {
    this.#isRunning = event.shiftKey;
    if (!MOVES[event.code]) return;
    if (!isDown) this.#held.delete(event.code);
    else if (!event.ctrlKey && !event.metaKey && !event.altKey && !isTyping(event.target)) {
      this.#held.add(event.code);
      event.preventDefault();
    }
    this.changed();
  }

  #mouse(event: MouseEvent): void {
    if (document.pointerLockElement !== this.canvas) return;
    this.turn(event.movementX * TURN, -event.movementY * TURN);
  }

  #down(event: PointerEvent): void {
    if (event.pointerType === 'mouse') return;
    const box = this.canvas.getBoundingClientRect();
    this.#fingers.set(event.pointerId, { x: event.clientX, y: event.clientY, walks: event.clientX - box.left < box.width / 2 });
    this.canvas.setPointerCapture(event.pointerId);
  }

  #move(event: PointerEvent): void {
    const finger = this.#fingers.get(event.pointerId);
    if (!finger) {
      if (event.pointerType === 'mouse' && event.buttons & 1 && document.pointerLockElement === null) this.turn(-event.movementX * TURN, event.movementY * TURN);
      return;
    }
    const [dx, dy] = [event.clientX - finger.x, event.clientY - finger.y];
    if (finger.walks) this.#stick = [Math.max(-1, Math.min(1, -dy / FULL_PX)), Math.max(-1, Math.min(1, dx / FULL_PX))];
    else {
      this.turn(-dx * TOUCH_TURN, dy * TOUCH_TURN);
      Object.assign(finger, { x: event.clientX, y: event.clientY });
    }
    this.changed();
  }

  #up(event: PointerEvent): void {
    if (this.#fingers.get(event.pointerId)?.walks) this.#stick = [0, 0];
    this.#fingers.delete(event.pointerId);
  }
}
