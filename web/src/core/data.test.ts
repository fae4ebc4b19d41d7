import { describe, expect, it } from 'vitest';
import { MAGIC, type Finish } from '../wire';
import { decodeMesh, packBatches } from './batches';
import { fromRgb9e5, toHalf, toRgb9e5 } from './codes';
import { decode } from './container';
import { openLight } from './light-store';
import { mix } from './mixing';
// @ts-expect-error The fixture is plain JavaScript.
import { makeWorld } from '../../fixture/make.mjs';

type World = { mesh: Uint8Array; scene: Uint8Array; light(how?: object): Uint8Array; blocks: number };
const world = makeWorld({ fineness: 0.2 }) as World;
const buffer = (bytes: Uint8Array): ArrayBuffer => Uint8Array.from(bytes).buffer;
const finishes = (decode(buffer(world.scene), 'scene').header as { finishes: Finish[] }).finishes;

describe('containers', () => {
  it('are refused where they are broken, with the reason', () => {
    const bytes = buffer(world.mesh);
    expect(() => decode(bytes.slice(0, 10), 'mesh')).toThrow('do not begin');
    expect(() => decode(bytes.slice(0, 100), 'mesh')).toThrow('end within');
    expect(() => decode(bytes, 'light')).toThrow('"mesh"');
    expect(() => decodeMesh(bytes.slice(0, bytes.byteLength - 64))).toThrow('outside');
    const text = new TextEncoder().encode(`${MAGIC}\u0004\0\0\0\0\0\0\0{,,}`);
    expect(() => decode(text.buffer as ArrayBuffer, 'mesh')).toThrow('not JSON');
  });
});

describe('batches', () => {
  it('hold every chunk once, and as much as they say', () => {
    const data = decodeMesh(buffer(world.mesh));
    const { batches, slots } = packBatches(data, finishes);
    expect(batches.flatMap((b) => b.chunks).sort((a, b) => a - b)).toEqual(data.header.chunks.map((_, i) => i));
    for (const [i, { batch, firstVertex }] of slots.entries()) {
      expect(firstVertex + data.header.chunks[i]!.vertices).toBeLessThanOrEqual(batches[batch]!.vertices);
    }
  });

  it('find the plane of the mirror, and none of the ball', () => {
    const { planes } = packBatches(decodeMesh(buffer(world.mesh)), finishes);
    expect(planes).toHaveLength(1);
    expect(planes[0]!.normal.toArray()).toEqual([0, -1, 0]);
  });
});

describe('light', () => {
  const vertices = decodeMesh(buffer(world.mesh)).header.lit_vertices;

  it('is patched by blocks', () => {
    const store = openLight(buffer(world.light()), vertices);
    const before = store.layers[0]!.indirect.slice();
    const ranges = store.patch(buffer(world.light({ blocks: [0], version: 5, noise: 0.3 })));
    expect(store.version).toBe(5);
    expect(ranges).toEqual([{ first: 0, end: Math.min(4096, vertices) }]);
    expect(store.layers[0]!.indirect.slice(0, 100)).not.toEqual(before.slice(0, 100));
    expect(store.layers[0]!.indirect.slice(4096)).toEqual(before.slice(4096));
  });

  it('adds up by factors; errors scale as the greatest', () => {
    const layer = (value: number) => ({ direct: Uint32Array.of(toRgb9e5(value, 0, 0)), indirect: Uint32Array.of(0) });
    const into = new Uint32Array(3);
    mix({ layers: [layer(100), layer(64)], errors: Uint16Array.of(toHalf(2)), factors: [0.5, 2] }, 0, 1, into, 0);
    expect(fromRgb9e5(into[0]!, [0, 0, 0])[0]).toBe(178);
    expect(into[2]).toBe(toHalf(4));
    mix({ layers: [layer(100)], errors: Uint16Array.of(0x7e00), factors: [0] }, 0, 1, into, 0);
    expect([...into]).toEqual([0, 0, 0x7e00]);
  });
});
