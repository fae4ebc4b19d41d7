// Numbers in few bits: three with a shared exponent (RGB9E5), halves, octahedral normals.

import type { Vec3 } from '../wire';

const MOST = 65408;
const POWERS = Float64Array.from({ length: 32 }, (_, e) => 2 ** (e - 24));

/** Reads three numbers of one code. */
export function fromRgb9e5(code: number, into: Vec3): Vec3 {
  const scale = POWERS[code >>> 27]!;
  into[0] = (code & 511) * scale;
  into[1] = ((code >>> 9) & 511) * scale;
  into[2] = ((code >>> 18) & 511) * scale;
  return into;
}

const wide = new Float32Array(1);
const bits = new Uint32Array(wide.buffer);

/** The code of three numbers (EXT_texture_shared_exponent). */
export function toRgb9e5(r: number, g: number, b: number): number {
  const [x, y, z] = [cut(r), cut(g), cut(b)];
  const top = Math.max(x, y, z);
  if (top < 2 ** -25) return 0;
  wide[0] = top;
  const floor = (bits[0]! >>> 23) - 127;
  let exponent = Math.max(-16, floor) + 16;
  if (Math.floor(top / POWERS[exponent]! + 0.5) === 512) exponent += 1;
  const scale = POWERS[exponent]!;
  const code = (c: number): number => Math.floor(c / scale + 0.5);
  return ((exponent << 27) | (code(z) << 18) | (code(y) << 9) | code(x)) >>> 0;
}

const cut = (c: number): number => (c > 0 ? Math.min(c, MOST) : 0);

/** Reads a half float. */
export function fromHalf(code: number): number {
  const sign = code & 0x8000 ? -1 : 1;
  const exponent = (code >>> 10) & 31;
  const fraction = code & 1023;
  if (exponent === 31) return fraction ? Number.NaN : sign * Infinity;
  return exponent === 0 ? sign * fraction * 2 ** -24 : sign * (1024 + fraction) * 2 ** (exponent - 25);
}

/** Whether the code is that of a place whose light is not known. */
export const isUnknown = (half: number): boolean => (half & 0x7fff) > 0x7c00;

/** A half float, rounded. */
export function toHalf(value: number): number {
  if (Number.isNaN(value)) return 0x7e00;
  if (value >= 65520) return 0x7c00;
  wide[0] = value;
  const exponent = (bits[0]! >>> 23) - 112;
  if (exponent <= 0) return Math.round(value * 2 ** 24);
  return (exponent << 10) + Math.round((bits[0]! & 0x7fffff) / 8192);
}

/** A unit vector of its two octahedral coordinates, -127 to 127. */
export function fromOctahedral(u: number, v: number): Vec3 {
  let [x, y] = [u / 127, v / 127];
  const z = 1 - Math.abs(x) - Math.abs(y);
  if (z < 0) [x, y] = [(1 - Math.abs(y)) * (x < 0 ? -1 : 1), (1 - Math.abs(x)) * (y < 0 ? -1 : 1)];
  const length = Math.hypot(x, y, z);
  return [x / length, y / length, z / length];
}

/** Luminance, or illuminance, of a linear Rec. 709 colour. */
export const luminance = (c: readonly number[]): number => 0.2126 * c[0]! + 0.7152 * c[1]! + 0.0722 * c[2]!;
