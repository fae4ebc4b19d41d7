// Puts chunks together into few draws, each with at most 65,536 vertices.

import type { Chunk, Finish, MeshHeader } from '../wire';
import { decode, type Container } from './container';
import { findPlanes, isShiny, type Plane } from './planes';

/** How a batch is drawn. */
export type Kind = 'plain' | 'shiny' | 'glass';

export interface Batch {
  kind: Kind;
  /** Index of its texture and of its plane of reflection, or -1. */
  texture: number;
  plane: number;
  /** The chunk that `place` counts from. */
  firstChunk: number;
  chunks: number[];
  vertices: number;
  indices: number;
}

/** Where a chunk is in the batches. */
export interface Slot {
  batch: number;
  firstVertex: number;
}

export interface MeshData {
  header: MeshHeader;
  positions: Uint16Array;
  normals: Int8Array;
  index: Uint16Array | Uint32Array;
  uvs: Float32Array;
  bytes: number;
}

export const MOST_VERTICES = 65_536;
/** Chunks that 16 bits can tell apart. */
const MOST_CHUNKS = 65_536;

export function decodeMesh(buffer: ArrayBuffer): MeshData {
  const mesh: Container<MeshHeader> = decode(buffer, 'mesh');
  const { header } = mesh;
  const data = {
    header, positions: mesh.numbers<Uint16Array>(header.positions), normals: mesh.numbers<Int8Array>(header.normals),
    index: mesh.numbers<Uint16Array | Uint32Array>(header.indices), uvs: mesh.numbers<Float32Array>(header.uvs), bytes: mesh.bytes,
  };
  header.chunks.forEach((chunk, i) => check(data, chunk, i));
  return data;
}

function check({ positions, normals, index, uvs }: MeshData, c: Chunk, i: number): void {
  const isInside = 3 * (c.first_vertex + c.vertices) <= positions.length && 2 * (c.first_vertex + c.vertices) <= normals.length
    && c.first_index + c.indices <= index.length && c.vertices <= MOST_VERTICES
    && (c.first_uv === null || 2 * (c.first_uv + c.vertices) <= uvs.length);
  if (!isInside) throw new Error(`Chunk ${i} of the mesh lies outside of the data.`);
}

/** Sorts chunks by how they are drawn and by place, and fills batches with them. */
export function packBatches(data: MeshData, finishes: Finish[]): { batches: Batch[]; slots: Slot[]; planes: Plane[] } {
  const { chunks } = data.header;
  const { planes, planeOf } = findPlanes(data, finishes);
  const few = chunks.length <= MOST_CHUNKS;
  const codes = few ? mortonCodes(chunks) : null;
  const looks = chunks.map((chunk, i) => lookOf(chunk, finishes, planeOf[i]!));
  const order = chunks.map((_, i) => i).sort((a, b) => compare(looks[a]!.key, looks[b]!.key) || (codes ? codes[a]! - codes[b]! : 0) || a - b);
  const batches: Batch[] = [];
  const slots: Slot[] = new Array<Slot>(chunks.length);
  let key = '';
  for (const i of order) {
    const chunk = chunks[i]!;
    const last = batches.at(-1);
    const isNew = !last || looks[i]!.key !== key || last.vertices + chunk.vertices > MOST_VERTICES || i - last.firstChunk >= MOST_CHUNKS;
    key = looks[i]!.key;
    const batch = isNew ? { ...looks[i]!, firstChunk: few ? 0 : i, chunks: [], vertices: 0, indices: 0 } : last;
    if (isNew) batches.push(batch);
    slots[i] = { batch: batches.length - 1, firstVertex: batch.vertices };
    batch.chunks.push(i);
    batch.vertices += chunk.vertices;
    batch.indices += chunk.indices;
  }
  return { batches, slots, planes };
}

const compare = (a: string, b: string): number => (a < b ? -1 : a > b ? 1 : 0);

function lookOf(chunk: Chunk, finishes: Finish[], plane: number): { key: string; kind: Kind; texture: number; plane: number } {
  const finish = finishes[chunk.finish];
  if (!finish) throw new Error(`A chunk of the mesh has a finish that the scene lacks (${chunk.finish}).`);
  const kind: Kind = finish.glass ? 'glass' : isShiny(finish) ? 'shiny' : 'plain';
  const texture = chunk.first_uv === null ? -1 : finish.texture ?? -1;
  return { key: `${kind} ${texture} ${plane}`, kind, texture, plane };
}

/** Numbers that are near for chunks that are near. */
function mortonCodes(chunks: Chunk[]): Uint32Array {
  const centres = chunks.map(({ min, step }) => min.map((m, k) => m + 32_768 * step[k]!));
  const bounds = [0, 1, 2].map((k) => centres.reduce(([low, high], c) => [Math.min(low!, c[k]!), Math.max(high!, c[k]!)], [Infinity, -Infinity]));
  const cell = (c: number[], k: number): number => Math.floor((1023 * (c[k]! - bounds[k]![0]!)) / Math.max(1e-9, bounds[k]![1]! - bounds[k]![0]!));
  return Uint32Array.from(centres, (c) => spread(cell(c, 0)) | (spread(cell(c, 1)) << 1) | (spread(cell(c, 2)) << 2));
}

/** Ten bits, two free ones after each. */
function spread(n: number): number {
  let x = n & 1023;
  x = (x | (x << 16)) & 0x30000ff;
  x = (x | (x << 8)) & 0x300f00f;
  x = (x | (x << 4)) & 0x30c30c3;
  return (x | (x << 2)) & 0x9249249;
}
