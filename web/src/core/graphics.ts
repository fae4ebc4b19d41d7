// The renderer, and how fine it draws.

import { ColorManagement, LinearSRGBColorSpace, WebGLRenderer } from 'three';
import type { Settings } from '../contract';

ColorManagement.enabled = false;

/** Frames that take longer than this make pictures coarser. */
const SLOW_MS = 40;
const SLOW_FRAMES = 8;

export class Unsupported extends Error {}

/** Makes a renderer; says clearly where there cannot be one. */
export function makeRenderer(canvas: HTMLCanvasElement): { renderer: WebGLRenderer; isSoftware: boolean } {
  const { context, isSoftware } = makeContext(canvas);
  const renderer = new WebGLRenderer({ canvas, context });
  renderer.outputColorSpace = LinearSRGBColorSpace;
  renderer.info.autoReset = false;
  renderer.setClearColor(0x14161a, 1);
  renderer.debug.checkShaderErrors = import.meta.env.DEV;
  return { renderer, isSoftware };
}

/** A context without smooth edges: those are drawn aside where a graphics card does it. */
function makeContext(canvas: HTMLCanvasElement): { context: WebGL2RenderingContext; isSoftware: boolean } {
  const context = canvas.getContext('webgl2', { alpha: false, stencil: false, depth: true, antialias: false, powerPreference: 'high-performance' });
  if (!context) throw new Unsupported('This browser has no WebGL 2, which drawing the map needs. A current browser with graphics acceleration shows it.');
  const info = context.getExtension('WEBGL_debug_renderer_info');
  const name = String(context.getParameter(info ? info.UNMASKED_RENDERER_WEBGL : context.RENDERER));
  return { context, isSoftware: /swiftshader|llvmpipe|software|basic render/i.test(name) };
}

/** How fine pictures are: 0 coarse, 2 as fine as the screen. */
export class Quality {
  #level: number;
  #slow = 0;
  #mean = 16;

  constructor(readonly isSoftware: boolean, public how: Settings['quality']) {
    this.#level = isSoftware ? 1 : 2;
  }

  get level(): number {
    return this.how === 'low' ? 0 : this.how === 'high' ? 2 : this.#level;
  }

  /** Device pixels of a CSS pixel; pictures that rest are finer. */
  pixelRatio(rests: boolean): number {
    const own = globalThis.devicePixelRatio || 1;
    if (this.how === 'low') return 1;
    if (this.level === 2) return Math.min(own, 2);
    return this.level === 1 || rests ? Math.min(own, 1) : 0.7;
  }

  /** The share of the picture's resolution that mirrors are drawn with. */
  get mirrorScale(): number {
    return [0.4, 0.6, 1][this.level]!;
  }

  /** Samples of a pixel. */
  get samples(): number {
    return this.level === 2 && !this.isSoftware ? 4 : 0;
  }

  get frameMs(): number {
    return this.#mean;
  }

  get fps(): number {
    return 1000 / this.#mean;
  }

  /** A frame of a movement took so long; true if pictures are coarser from now on. */
  took(milliseconds: number): boolean {
    if (milliseconds > 3000) return false;
    this.#mean += 0.25 * (milliseconds - this.#mean);
    this.#slow = milliseconds > SLOW_MS ? this.#slow + 1 : Math.max(0, this.#slow - 2);
    if (this.how !== 'auto' || this.#slow < SLOW_FRAMES || this.#level === 0) return false;
    this.#level -= 1;
    this.#slow = -SLOW_FRAMES;
    return true;
  }
}
