// Adds up layers of light, each with its factor.

import type { Vec3 } from '../wire';
import { fromHalf, fromRgb9e5, isUnknown, toHalf, toRgb9e5 } from './codes';
import type { Layer } from './light-store';

/** Numbers of 32 bits a vertex: direct light, indirect light, standard error as a half. */
export const WORDS = 3;

export interface Mix {
  layers: readonly Layer[];
  errors: Uint16Array;
  factors: readonly number[];
}

/** Writes the light of vertices from `first` on, `count` of them, to `into` from vertex `at` on. */
export function mix({ layers, errors, factors }: Mix, first: number, count: number, into: Uint32Array, at: number): void {
  const used = layers.map((layer, i) => ({ layer, factor: factors[i] ?? 1 })).filter(({ factor }) => factor > 0);
  if (used.length === 1 && used[0]!.factor === 1) return copy(used[0]!.layer, errors, first, count, into, at);
  // The errors of layers are not known one by one: all of them scale as the most amplified one.
  const scale = Math.max(0, ...used.map(({ factor }) => factor));
  for (let i = 0; i < count; i++) {
    const vertex = first + i;
    const to = WORDS * (at + i);
    const code = errors[vertex]!;
    into[to + 2] = isUnknown(code) ? code : toHalf(scaled(fromHalf(code), scale));
    into[to] = sum(used, 'direct', vertex);
    into[to + 1] = sum(used, 'indirect', vertex);
  }
}

const scaled = (error: number, by: number): number => (by === 0 ? 0 : error * by);

function copy({ direct, indirect }: Layer, errors: Uint16Array, first: number, count: number, into: Uint32Array, at: number): void {
  for (let i = 0, to = WORDS * at; i < count; i++, to += WORDS) {
    into[to] = direct[first + i]!;
    into[to + 1] = indirect[first + i]!;
    into[to + 2] = errors[first + i]!;
  }
}

const part: Vec3 = [0, 0, 0];

function sum(used: { layer: Layer; factor: number }[], which: 'direct' | 'indirect', vertex: number): number {
  let [r, g, b] = [0, 0, 0];
  for (const { layer, factor } of used) {
    fromRgb9e5(layer[which][vertex]!, part);
    r += factor * part[0];
    g += factor * part[1];
    b += factor * part[2];
  }
  return toRgb9e5(r, g, b);
}
