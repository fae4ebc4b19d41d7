// Reads containers of numbers.

import { MAGIC, type LightHeader, type MeshHeader, type SceneHeader, type Section } from '../wire';

type Header = SceneHeader | MeshHeader | LightHeader;
export type Numbers = Uint8Array | Int8Array | Uint16Array | Uint32Array | Float32Array;

const KINDS = { u8: Uint8Array, i8: Int8Array, u16: Uint16Array, u32: Uint32Array, f32: Float32Array };
const START = 16;

export interface Container<H> {
  header: H;
  /** The numbers of a section: a view, nothing is copied. */
  numbers<T extends Numbers>(section: Section): T;
  bytes: number;
}

/** Reads a container of this kind; says what is wrong where it is none. */
export function decode<K extends Header['kind']>(buffer: ArrayBuffer, kind: K): Container<Extract<Header, { kind: K }>> {
  const { header, start } = readHeader(buffer);
  if (header.kind !== kind) throw new Error(`The data are of the kind "${header.kind}" where "${kind}" is needed.`);
  return {
    header: header as Extract<Header, { kind: K }>,
    numbers: <T extends Numbers>(section: Section) => numbersOf(buffer, start, section) as T,
    bytes: buffer.byteLength,
  };
}

function readHeader(buffer: ArrayBuffer): { header: Header; start: number } {
  const view = new DataView(buffer);
  if (buffer.byteLength < START || text(buffer, 0, 8) !== MAGIC) throw new Error('The data do not begin as a container does.');
  const length = view.getUint32(8, true);
  if (START + length > buffer.byteLength) throw new Error('The data end within their header.');
  try {
    const header = JSON.parse(text(buffer, START, length)) as Header;
    return { header, start: Math.ceil((START + length) / 8) * 8 };
  } catch (error) {
    throw new Error(`The header of the data is not JSON: ${String(error)}`);
  }
}

const text = (buffer: ArrayBuffer, at: number, length: number): string => new TextDecoder().decode(new Uint8Array(buffer, at, length));

function numbersOf(buffer: ArrayBuffer, start: number, { offset, count, type }: Section): Numbers {
  const Kind = KINDS[type];
  const at = start + offset;
  const isInside = Number.isInteger(at) && Number.isInteger(count) && offset >= 0 && count >= 0 && at + count * Kind.BYTES_PER_ELEMENT <= buffer.byteLength;
  if (!isInside || at % Kind.BYTES_PER_ELEMENT !== 0) throw new Error('A section of the data lies outside of them.');
  return new Kind(buffer, at, count);
}
