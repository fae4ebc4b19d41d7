// Exposure: the small picture that it is read from, and how it follows.

import { Color, FloatType, HalfFloatType, PerspectiveCamera, RGBAFormat, WebGLRenderTarget, type Scene, type WebGLRenderer } from 'three';
import { fromHalf, luminance } from './codes';
import { LAYER } from './model';
import { OUTPUT, type Uniforms } from './uniforms';

const WIDTH = 160;
/** The share that the mean of a picture is shown as. */
export const MIDDLE_GREY = 0.18;
/** Luminance of white at an exposure value of nought, cd/m2. */
const SATURATION = 1.2;
/** How long adapting takes, s. */
const SLOWNESS = 0.22;

export const whiteOfEv = (ev: number): number => SATURATION * 2 ** ev;
export const evOfWhite = (white: number): number => Math.log2(white / SATURATION);

/** A small picture: luminance in three channels and illuminance (-1: none), rows from the bottom. */
export interface Sample {
  width: number;
  height: number;
  values: Float32Array;
}

export class Meter {
  readonly #target: WebGLRenderTarget;
  readonly #isFloat: boolean;
  #isBusy = false;

  constructor(renderer: WebGLRenderer) {
    this.#isFloat = renderer.extensions.has('EXT_color_buffer_float');
    this.#target = new WebGLRenderTarget(WIDTH, 90, { type: this.#isFloat ? FloatType : HalfFloatType, format: RGBAFormat });
  }

  get isBusy(): boolean {
    return this.#isBusy;
  }

  /** Draws the small picture and reads it when the GPU is done. */
  async read(renderer: WebGLRenderer, scene: Scene, camera: PerspectiveCamera, uniforms: Uniforms): Promise<Sample> {
    this.#isBusy = true;
    const [width, height] = [WIDTH, Math.max(1, Math.round(WIDTH / camera.aspect))];
    this.#target.setSize(width, height);
    this.#draw(renderer, scene, camera, uniforms);
    const values = this.#isFloat ? new Float32Array(4 * width * height) : new Uint16Array(4 * width * height);
    try {
      await renderer.readRenderTargetPixelsAsync(this.#target, 0, 0, width, height, values);
    } finally {
      this.#isBusy = false;
    }
    return { width, height, values: values instanceof Float32Array ? values : Float32Array.from(values, fromHalf) };
  }

  #draw(renderer: WebGLRenderer, scene: Scene, camera: PerspectiveCamera, uniforms: Uniforms): void {
    const [clear, alpha, mask] = [renderer.getClearColor(new Color()), renderer.getClearAlpha(), camera.layers.mask];
    renderer.setRenderTarget(this.#target);
    renderer.setClearColor(0, -1);
    renderer.clear();
    camera.layers.disable(LAYER.marks);
    uniforms.uOutput.value = OUTPUT.luminance;
    renderer.render(scene, camera);
    camera.layers.mask = mask;
    renderer.setRenderTarget(null);
    renderer.setClearColor(clear, alpha);
  }

  dispose(): void {
    this.#target.dispose();
  }
}

/** The log-average of lit pixels, or null where there are none. */
export function logAverage({ values }: Sample): number | null {
  let [sum, count] = [0, 0];
  for (let i = 0; i < values.length; i += 4) {
    const y = luminance([values[i]!, values[i + 1]!, values[i + 2]!]);
    if (!(y > 0) || !Number.isFinite(y)) continue;
    sum += Math.log(y);
    count += 1;
  }
  return count > 0 ? Math.exp(sum / count) : null;
}

/** The luminance of white, which follows what is wanted as eyes do. */
export class Adaptation {
  #wanted: number;
  #jumps = true;

  constructor(public white: number) {
    this.#wanted = white;
  }

  /** The next wish is met at once. */
  jump(): void {
    this.#jumps = true;
  }

  want(white: number): void {
    this.#wanted = white;
    if (this.#jumps) this.white = white;
    this.#jumps = false;
  }

  get isSettled(): boolean {
    return this.white === this.#wanted;
  }

  step(seconds: number): void {
    const off = Math.log(this.#wanted / this.white);
    this.white = Math.abs(off) < 2e-3 ? this.#wanted : this.white * Math.exp(off * (1 - Math.exp(-seconds / SLOWNESS)));
  }
}
