// Colours of textures at places, for readings.

import type { Vec3 } from '../wire';
import { fromSrgb } from './tone';

/** Pictures larger than this are read coarser. */
const LARGEST = 1024;

/** The pixels of a picture whose first row is at v = 0. */
export class Texels {
  #data: ImageData | null = null;

  constructor(readonly bitmap: ImageBitmap) {}

  /** The linear colour at a place of the texture, which repeats; null where it cannot be read. */
  at(u: number, v: number): Vec3 | null {
    const data = (this.#data ??= pixels(this.bitmap));
    if (!data) return null;
    const cell = (t: number, size: number): number => Math.min(size - 1, Math.floor((t - Math.floor(t)) * size));
    const from = 4 * (cell(v, data.height) * data.width + cell(u, data.width));
    return [0, 1, 2].map((k) => fromSrgb(data.data[from + k]! / 255)) as Vec3;
  }
}

function pixels(bitmap: ImageBitmap): ImageData | null {
  const scale = Math.min(1, LARGEST / Math.max(bitmap.width, bitmap.height));
  const canvas = document.createElement('canvas');
  canvas.width = Math.max(1, Math.round(bitmap.width * scale));
  canvas.height = Math.max(1, Math.round(bitmap.height * scale));
  const context = canvas.getContext('2d', { willReadFrequently: true });
  context?.drawImage(bitmap, 0, 0, canvas.width, canvas.height);
  return context?.getImageData(0, 0, canvas.width, canvas.height) ?? null;
}
