// What settings mean for the shaders: tone, colours, limits, lines.

import type { Settings, Legend } from '../contract';
import type { SceneHeader, Vec3 } from '../wire';
import type { Container } from './container';
import type { Model } from './model';
import { automaticScale, divergingCodes, givenScale, legendOf, type Scale } from './scale';
import { toneRow } from './tone';
import { bytes, floats, MODES, type Uniforms } from './uniforms';
import { whiteBalance } from './white';

const MOST_LINES = 24;

export class Shown {
  readonly #codes = new Map<string, Uint8Array>();
  readonly #diverging = divergingCodes();
  #tone = '';
  #colours: Uint8Array | null = null;
  #scale: Scale = givenScale({ low: 0, high: 1 }, false);
  #lines: number[] = [];

  constructor(readonly container: Container<SceneHeader>, readonly uniforms: Uniforms) {
    for (const { name, codes } of container.header.colour_maps) this.#codes.set(name, container.numbers<Uint8Array>(codes));
  }

  /** The scale of false colour now. */
  get scale(): Scale {
    return this.#scale;
  }

  /** Illuminances of isolux lines, lx. */
  get lines(): readonly number[] {
    return this.#lines;
  }

  codes({ mode, colourMap }: Readonly<Settings>): Uint8Array {
    return mode === 'difference' ? this.#diverging : this.#codes.get(colourMap) ?? this.#codes.values().next().value ?? this.#diverging;
  }

  legend(settings: Readonly<Settings>): Legend | null {
    return settings.mode === 'seen' ? null : legendOf(this.#scale, settings.mode, this.codes(settings));
  }

  /** Colours of grid points: by the scale where it shows illuminance. */
  illuminanceScale(model: Model | null, settings: Readonly<Settings>): Scale {
    return settings.mode === 'illuminance' || !model ? this.#scale : automaticScale(model, 'illuminance', settings.logarithmic);
  }

  /** Takes over settings, and new light. */
  update(settings: Readonly<Settings>, model: Model | null, white: number): void {
    const { uniforms } = this;
    this.#scale = scaleOf(settings, model);
    uniforms.uMode.value = MODES.indexOf(settings.mode);
    uniforms.uLimits.value.set(this.#scale.low, this.#scale.high);
    uniforms.uLogarithmic.value = this.#scale.logarithmic;
    this.#setColours(this.codes(settings));
    this.#lines = settings.contours ? this.illuminanceScale(model, settings).ticks.filter((t) => t > 0).slice(0, MOST_LINES) : [];
    uniforms.uTickCount.value = this.#lines.length;
    this.#lines.forEach((tick, i) => (uniforms.uTicks.value[i] = tick));
    this.#balance(settings);
    this.setWhite(settings, white);
  }

  /** White in the light as it is dimmed; of two dimmings side by side, in that of the first. */
  #balance({ dimming }: Readonly<Settings>): void {
    const light: Vec3 = [0, 0, 0];
    this.container.header.light_lm.forEach((of, i) => of.forEach((channel, k) => (light[k]! += channel * (dimming[i] ?? 1))));
    const [r, g, b] = whiteBalance(light);
    this.uniforms.uBalance.value.set(...r, ...g, ...b);
  }

  /** The row of the tone table for a luminance of white. */
  setWhite({ tone }: Readonly<Settings>, white: number): void {
    const { uniforms, container } = this;
    const table = container.header.tones.find(({ name }) => name === tone) ?? container.header.tones[0];
    uniforms.uWhite.value = white;
    uniforms.uAmbient.value.setScalar(0.18 * white);
    if (!table) return;
    const { exposed, whites } = table;
    const key = whites.count > 1 ? `${table.name} ${white}` : table.name;
    if (key === this.#tone) return;
    this.#tone = key;
    uniforms.uToneRow.value.dispose();
    uniforms.uToneRow.value = floats(toneRow(table, container.numbers<Float32Array>(table.values), white, new Float32Array(exposed.count)) as Float32Array<ArrayBuffer>, exposed.count);
    uniforms.uToneAt.value.set(exposed.first, 1 / exposed.step, exposed.count);
    uniforms.uToneOnChannels.value = table.on === 'channels';
  }

  /** Takes tables off the graphics card; they come to it again when they are drawn with. */
  dispose(): void {
    this.uniforms.uToneRow.value.dispose();
    this.uniforms.uColours.value.dispose();
  }

  #setColours(codes: Uint8Array): void {
    if (codes === this.#colours) return;
    this.#colours = codes;
    const texels = new Uint8Array(4 * 256);
    for (let i = 0; i < 256; i++) texels.set([codes[3 * i]!, codes[3 * i + 1]!, codes[3 * i + 2]!, 255], 4 * i);
    this.uniforms.uColours.value.dispose();
    this.uniforms.uColours.value = bytes(texels);
  }
}

function scaleOf({ mode, limits, logarithmic }: Readonly<Settings>, model: Model | null): Scale {
  const isLog = logarithmic && mode !== 'difference';
  if (limits && limits.low < limits.high && (!isLog || limits.low > 0)) return givenScale(limits, isLog);
  return model && mode !== 'seen' ? automaticScale(model, mode, isLog) : givenScale(isLog ? { low: 1, high: 10 } : { low: 0, high: 1 }, isLog);
}
