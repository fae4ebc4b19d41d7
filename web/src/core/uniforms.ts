// What all shaders of a viewer know in common.

import { DataTexture, FloatType, Matrix3, NearestFilter, RedFormat, RGBAFormat, Vector2, Vector3, type IUniform, type Texture } from 'three';
import type { Mode } from '../contract';

export const MODES: readonly Mode[] = ['seen', 'illuminance', 'luminance', 'direct', 'indirect', 'error', 'relative', 'difference'];

/** What surfaces are drawn as. `meter` is luminance, less than nothing where a luminaire is seen. */
export const OUTPUT = { display: 0, luminance: 1, falseColour: 2, meter: 3 } as const;

export type Uniforms = ReturnType<typeof makeUniforms>;

const holds = <T>(value: T): IUniform<T> => ({ value });

export function makeUniforms() {
  return {
    uMode: holds(0), uOutput: holds<number>(OUTPUT.display), uSide: holds(0),
    uToneRow: holds<Texture>(floats(new Float32Array(2), 2)), uToneAt: holds(new Vector3(0, 1, 2)), uWhite: holds(1), uBalance: holds(new Matrix3()), uToneOnChannels: holds(false),
    uColours: holds<Texture>(bytes(new Uint8Array(4 * 256))), uLimits: holds(new Vector2(0, 1)), uLogarithmic: holds(false),
    uTickCount: holds(0), uTicks: holds(new Array<number>(24).fill(0)), uPixels: holds(1),
    uSurroundings: holds<Texture | null>(null), uCubeSize: holds(0), uCentre: holds(new Vector3()),
    uRoomLow: holds(new Vector3()), uRoomHigh: holds(new Vector3()), uAmbient: holds(new Vector3()),
  };
}

/** A row of numbers. */
export function floats(values: Float32Array<ArrayBuffer>, width: number): DataTexture {
  return ready(new DataTexture(values, width, 1, RedFormat, FloatType));
}

/** A row of colours. */
export function bytes(values: Uint8Array<ArrayBuffer>): DataTexture {
  return ready(new DataTexture(values, values.length / 4, 1, RGBAFormat));
}

const TABLE_WIDTH = 1024;

/** Texels of four numbers, row after row of 1024. */
export function table(texels: number[][]): DataTexture {
  const height = Math.max(1, Math.ceil(texels.length / TABLE_WIDTH));
  const values = new Float32Array(4 * TABLE_WIDTH * height);
  texels.forEach((texel, i) => values.set(texel, 4 * i));
  return ready(new DataTexture(values, TABLE_WIDTH, height, RGBAFormat, FloatType));
}

function ready(texture: DataTexture): DataTexture {
  texture.minFilter = texture.magFilter = NearestFilter;
  texture.generateMipmaps = false;
  texture.needsUpdate = true;
  return texture;
}
