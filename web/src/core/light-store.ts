// The light of a mesh as it was sent, patched with what is new.

import type { LightHeader, LightLayer, Section } from '../wire';
import { decode } from './container';

export interface Layer {
  direct: Uint32Array;
  indirect: Uint32Array;
}

/** Vertices from `first` up to `end`. */
export interface Range {
  first: number;
  end: number;
}

export class LightStore {
  readonly layers: Layer[];
  readonly errors: Uint16Array;
  readonly other: Layer | null;
  readonly otherErrors: Uint16Array | null;
  version = 0;

  constructor(readonly vertices: number, header: LightHeader) {
    const layer = (): Layer => ({ direct: new Uint32Array(vertices), indirect: new Uint32Array(vertices) });
    this.layers = header.layers.map(layer);
    this.errors = new Uint16Array(vertices).fill(0x7e00);
    this.other = header.other ? layer() : null;
    this.otherErrors = header.other ? new Uint16Array(vertices).fill(0x7e00) : null;
  }

  /** Takes the values of a container; says which vertices have new ones. */
  patch(buffer: ArrayBuffer): Range[] {
    const { header, numbers } = decode(buffer, 'light');
    const ranges = rangesOf(header, this.vertices);
    const count = ranges.reduce((sum, { first, end }) => sum + end - first, 0);
    const put = (section: Section, into: Uint32Array | Uint16Array): void => {
      const values = numbers<Uint32Array | Uint16Array>(section);
      if (values.length !== count) throw new Error(`The light has ${values.length} values where its blocks have ${count} vertices.`);
      let at = 0;
      for (const { first, end } of ranges) {
        into.set(values.subarray(at, at + end - first), first);
        at += end - first;
      }
    };
    const putLayer = (from: LightLayer, into: Layer): void => {
      put(from.direct, into.direct);
      put(from.indirect, into.indirect);
    };
    if (header.layers.length !== this.layers.length) throw new Error('The light has another number of layers than before.');
    header.layers.forEach((from, i) => putLayer(from, this.layers[i]!));
    put(header.standard_error, this.errors);
    if (header.other && this.other) putLayer(header.other, this.other);
    if (header.other_standard_error && this.otherErrors) put(header.other_standard_error, this.otherErrors);
    this.version = header.version;
    return ranges;
  }
}

/** The vertices of the blocks, as they come; neighbours are not joined. */
function rangesOf({ blocks, block_size }: LightHeader, vertices: number): Range[] {
  return blocks.map((block) => {
    const first = block * block_size;
    if (!(first >= 0 && first < vertices)) throw new Error(`Block ${block} of the light lies outside of the mesh.`);
    return { first, end: Math.min(first + block_size, vertices) };
  });
}

export function openLight(buffer: ArrayBuffer, vertices: number): LightStore {
  const store = new LightStore(vertices, decode(buffer, 'light').header);
  store.patch(buffer);
  return store;
}
