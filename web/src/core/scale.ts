// The scale of false colour in force: limits, ticks, colours.

import type { Legend, Mode, Settings } from '../contract';
import type { Finish } from '../wire';
import { roundLimits, stepOf, ticksOf, type Limits } from './axis';
import { fromHalf, fromRgb9e5, isUnknown, luminance } from './codes';
import type { Model } from './model';

export interface Scale extends Limits {
  logarithmic: boolean;
  ticks: number[];
}

/** A share of the mean illuminance of the vertices from which on a place is not dark. */
const SOME_LIGHT = 0.05;
/** Values of at most so many vertices decide on automatic limits. */
const MOST_SAMPLES = 100_000;

/** What false colour shows of a mode, without `limits` of people: round numbers about the values of all vertices. */
export function automaticScale(model: Model, mode: Mode, logarithmic: boolean): Scale {
  if (mode === 'difference') return symmetric(model);
  const limits = roundLimits(mode === 'relative' ? relative(model) : sample(model, mode), logarithmic);
  return { ...limits, logarithmic, ticks: ticksOf(limits, logarithmic) };
}

/** Relative errors where there is some light: without any they have no limit. */
function relative(model: Model): Float64Array {
  const errors = sample(model, 'error');
  const totals = sample(model, 'illuminance');
  const mean = totals.reduce((sum, e) => sum + e, 0) / Math.max(1, totals.length);
  // Standard errors that are not known leave the two of different length.
  if (errors.length !== totals.length) return sample(model, 'relative');
  return errors.map((error, k) => (100 * error) / totals[k]!).filter((_, k) => totals[k]! > SOME_LIGHT * mean);
}

export function givenScale(limits: Limits, logarithmic: boolean): Scale {
  return { ...limits, logarithmic, ticks: ticksOf(limits, logarithmic) };
}

function symmetric(model: Model): Scale {
  const high = roundLimits(sample(model, 'difference').map(Math.abs), false).high;
  return { low: -high, high, logarithmic: false, ticks: ticksOf({ low: -high, high }, false) };
}

function sample(model: Model, mode: Mode): Float64Array {
  const { chunks, lit_vertices: all } = model.data.header;
  const stride = Math.max(1, Math.ceil(all / MOST_SAMPLES));
  const values: number[] = [];
  chunks.forEach((chunk, i) => {
    if (!chunk.lit) return;
    const { words, at } = model.wordsOf(i, chunk.first_vertex);
    const other = model.wordsOf(i, chunk.first_vertex, 'light2').words;
    const begin = (stride - (chunk.first_vertex % stride)) % stride;
    for (let k = begin; k < chunk.vertices; k += stride) {
      const value = valueOf(mode, words, other, at + 3 * k, model.finishes[chunk.finish]!);
      if (Number.isFinite(value)) values.push(value);
    }
  });
  return Float64Array.from(values);
}

const [a, b] = [[0, 0, 0], [0, 0, 0]] as [[number, number, number], [number, number, number]];

function totalOf(words: Uint32Array, at: number): number {
  return luminance(fromRgb9e5(words[at]!, a)) + luminance(fromRgb9e5(words[at + 1]!, b));
}

function valueOf(mode: Mode, words: Uint32Array, other: Uint32Array, at: number, finish: Finish): number {
  const error = words[at + 2]!;
  if (isUnknown(error)) return Number.NaN;
  if (mode === 'direct') return luminance(fromRgb9e5(words[at]!, a));
  if (mode === 'indirect') return luminance(fromRgb9e5(words[at + 1]!, a));
  if (mode === 'error') return fromHalf(error);
  if (mode === 'relative') return (100 * fromHalf(error)) / totalOf(words, at);
  if (mode === 'luminance') return luminance(finish.diffuse.map((d, k) => (d * (fromRgb9e5(words[at]!, a)[k]! + fromRgb9e5(words[at + 1]!, b)[k]!)) / Math.PI + finish.luminance_cd_m2[k]!));
  if (mode === 'difference') return isUnknown(other[at + 2]!) ? Number.NaN : totalOf(words, at) - totalOf(other, at);
  return totalOf(words, at);
}

const UNITS: Partial<Record<Mode, Legend['unit']>> = { luminance: 'cd/m²', relative: '%' };

/** The legend of what is shown. `codes` are 256 x 3 codes of sRGB. */
export function legendOf(scale: Scale, mode: Settings['mode'], codes: Uint8Array): Legend {
  const colours = Array.from({ length: 32 }, (_, i) => {
    const at = 3 * Math.round((i * 255) / 31);
    return `rgb(${codes[at]}, ${codes[at + 1]}, ${codes[at + 2]})`;
  });
  const { low, high, ticks, logarithmic } = scale;
  return { low, high, ticks, unit: UNITS[mode] ?? 'lx', logarithmic, colours };
}

/** Blue, white, red: for what is less and more than another. */
export function divergingCodes(): Uint8Array {
  const anchors = [[33, 70, 160], [120, 165, 220], [247, 247, 247], [235, 140, 115], [160, 20, 40]];
  const codes = new Uint8Array(768);
  for (let i = 0; i < 256; i++) {
    const at = (i / 255) * 4;
    const k = Math.min(3, Math.floor(at));
    for (let c = 0; c < 3; c++) codes[3 * i + c] = Math.round(anchors[k]![c]! + (at - k) * (anchors[k + 1]![c]! - anchors[k]![c]!));
  }
  return codes;
}

/** CSS colour of a value. */
export function colourOf(value: number, scale: Scale, codes: Uint8Array): string {
  const at = 3 * stepOf(value, scale, scale.logarithmic);
  return `rgb(${codes[at]}, ${codes[at + 1]}, ${codes[at + 2]})`;
}
