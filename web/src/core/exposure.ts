// Exposure: the small picture that it is read from, and how it follows.

import { Color, FloatType, HalfFloatType, PerspectiveCamera, RGBAFormat, WebGLRenderTarget, type Scene, type WebGLRenderer } from 'three';
import { luminance } from './codes';
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

/** A small picture: luminance in three channels, negative for luminaires, and illuminance (-1: none), rows from the bottom. */
export interface Sample {
  width: number;
  height: number;
  values: Float32Array;
}

export class Meter {
  readonly #target: WebGLRenderTarget;
  #isBusy = false;

  constructor(renderer: WebGLRenderer) {
    const isFloat = renderer.extensions.has('EXT_color_buffer_float');
    this.#target = new WebGLRenderTarget(WIDTH, 90, { type: isFloat ? FloatType : HalfFloatType, format: RGBAFormat });
  }

  get isBusy(): boolean {
    return this.#isBusy;
  }

  /** Draws the small picture and reads it when the GPU is done. */
  async read(renderer: WebGLRenderer, scene: Scene, camera: PerspectiveCamera, uniforms: Uniforms): Promise<Sample> {
    this.#isBusy = true;
    try {
      const [width, height] = [WIDTH, Math.max(1, Math.round(WIDTH / camera.aspect))];
      this.#target.setSize(width, height);
      this.#draw(renderer, scene, camera, uniforms);
      const values = await readLater(renderer, this.#target, width, height);
      return { width, height, values };
    } finally {
      this.#isBusy = false;
    }
  }

  #draw(renderer: WebGLRenderer, scene: Scene, camera: PerspectiveCamera, uniforms: Uniforms): void {
    const [clear, alpha, mask] = [renderer.getClearColor(new Color()), renderer.getClearAlpha(), camera.layers.mask];
    renderer.setRenderTarget(this.#target);
    renderer.setClearColor(0, -1);
    renderer.clear();
    camera.layers.disable(LAYER.marks);
    uniforms.uOutput.value = OUTPUT.meter;
    renderer.render(scene, camera);
    camera.layers.mask = mask;
    renderer.setClearColor(clear, alpha);
  }

  dispose(): void {
    this.#target.dispose();
  }
}

const POLL_MS = 4;

/** Reads a target into memory without waiting for the GPU. */
async function readLater(renderer: WebGLRenderer, target: WebGLRenderTarget, width: number, height: number): Promise<Float32Array> {
  const gl = renderer.getContext() as WebGL2RenderingContext;
  const buffer = gl.createBuffer();
  renderer.setRenderTarget(target);
  gl.bindBuffer(gl.PIXEL_PACK_BUFFER, buffer);
  gl.bufferData(gl.PIXEL_PACK_BUFFER, 16 * width * height, gl.STREAM_READ);
  gl.readPixels(0, 0, width, height, gl.RGBA, gl.FLOAT, 0);
  gl.bindBuffer(gl.PIXEL_PACK_BUFFER, null);
  renderer.setRenderTarget(null);
  const fence = gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0)!;
  gl.flush();
  try {
    while (gl.clientWaitSync(fence, 0, 0) === gl.TIMEOUT_EXPIRED) await new Promise((resolve) => setTimeout(resolve, POLL_MS));
    const values = new Float32Array(4 * width * height);
    gl.bindBuffer(gl.PIXEL_PACK_BUFFER, buffer);
    gl.getBufferSubData(gl.PIXEL_PACK_BUFFER, 0, values);
    gl.bindBuffer(gl.PIXEL_PACK_BUFFER, null);
    return values;
  } finally {
    gl.deleteSync(fence);
    gl.deleteBuffer(buffer);
  }
}

/** The log-average of lit surfaces, or of luminaires where nothing else is seen, or null where nothing is lit. */
export function logAverage({ values }: Sample): number | null {
  const [surfaces, luminaires] = [{ sum: 0, count: 0 }, { sum: 0, count: 0 }];
  for (let i = 0; i < values.length; i += 4) {
    const y = luminance([values[i]!, values[i + 1]!, values[i + 2]!]);
    if (y === 0 || !Number.isFinite(y)) continue;
    const kind = y > 0 ? surfaces : luminaires;
    kind.sum += Math.log(Math.abs(y));
    kind.count += 1;
  }
  const { sum, count } = surfaces.count > 0 ? surfaces : luminaires;
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

  /** What is wanted is there at once. */
  finish(): void {
    this.white = this.#wanted;
  }

  get isSettled(): boolean {
    return this.white === this.#wanted;
  }

  step(seconds: number): void {
    const off = Math.log(this.#wanted / this.white);
    this.white = Math.abs(off) < 2e-3 ? this.#wanted : this.white * Math.exp(off * (1 - Math.exp(-seconds / SLOWNESS)));
  }
}
