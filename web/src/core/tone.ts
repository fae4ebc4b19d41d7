// Tone operators: rows of their tables.

import type { ToneTable } from '../wire';

/** The row of a table at this luminance of white, between its rows. */
export function toneRow({ whites, exposed }: ToneTable, values: Float32Array, white: number, into: Float32Array): Float32Array {
  const columns = exposed.count;
  const at = whites.count > 1 ? Math.min(Math.max((Math.log2(white) - whites.first) / whites.step, 0), whites.count - 1) : 0;
  const row = Math.min(Math.floor(at), Math.max(0, whites.count - 2));
  const part = at - row;
  const next = Math.min(row + 1, whites.count - 1);
  for (let k = 0; k < columns; k++) {
    into[k] = values[row * columns + k]! * (1 - part) + values[next * columns + k]! * part;
  }
  return into;
}

/** What a row shows of an exposed luminance, 0 to 1: straight between columns and beyond, in logarithms. The shader does the same. */
export function shownBy(row: Float32Array, { exposed }: ToneTable, value: number): number {
  if (!(value > 0)) return 0;
  const at = (Math.log2(value) - exposed.first) / exposed.step;
  const k = Math.min(Math.max(Math.floor(at), 0), exposed.count - 2);
  return Math.min(1, 2 ** (row[k]! + (at - k) * (row[k + 1]! - row[k]!)));
}

/** The code of a linear channel, 0 to 1. */
export const toSrgb = (c: number): number => (c <= 0.0031308 ? 12.92 * c : 1.055 * c ** (1 / 2.4) - 0.055);

export const fromSrgb = (c: number): number => (c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4);
