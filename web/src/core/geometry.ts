// Batches as geometries of the GPU.

import { Box3, BufferAttribute, BufferGeometry, DynamicDrawUsage, IntType, Sphere, Vector3 } from 'three';
import type { Chunk } from '../wire';
import type { Batch, MeshData, Slot } from './batches';
import { WORDS } from './mixing';

/** A geometry whose light can change; `light` is kept in memory for readings, the rest is given up once it is on the GPU. */
export function makeGeometry(data: MeshData, batch: Batch, slots: readonly Slot[]): BufferGeometry {
  const { chunks } = data.header;
  const place = new Uint16Array(4 * batch.vertices);
  const normal = new Int8Array(4 * batch.vertices);
  const uv = batch.texture >= 0 ? new Float32Array(2 * batch.vertices) : null;
  const index = new Uint16Array(batch.indices);
  const box = new Box3();
  let at = 0;
  for (const i of batch.chunks) {
    const chunk = chunks[i]!;
    const first = slots[i]!.firstVertex;
    fillVertices(data, chunk, i - batch.firstChunk, first, place, normal);
    if (uv && chunk.first_uv !== null) uv.set(data.uvs.subarray(2 * chunk.first_uv, 2 * (chunk.first_uv + chunk.vertices)), 2 * first);
    for (let k = 0; k < chunk.indices; k++) index[at + k] = first + data.index[chunk.first_index + k]!;
    at += chunk.indices;
    box.union(boxOf(chunk));
  }
  const geometry = new BufferGeometry();
  geometry.setAttribute('place', integers(place, 4));
  geometry.setAttribute('normal', once(new BufferAttribute(normal, 4)));
  if (uv) geometry.setAttribute('uv', once(new BufferAttribute(uv, 2)));
  geometry.setIndex(once(new BufferAttribute(index, 1)));
  setLight(geometry, 'light', lightAttribute(batch.vertices));
  geometry.setAttribute('light2', geometry.getAttribute('light'));
  geometry.boundingBox = box;
  geometry.boundingSphere = box.getBoundingSphere(new Sphere());
  return geometry;
}

export function setLight(geometry: BufferGeometry, name: 'light' | 'light2', attribute: BufferAttribute): void {
  geometry.setAttribute(name, attribute);
}

/** Light of so many vertices, none of which is known. */
export function lightAttribute(vertices: number): BufferAttribute {
  const light = new Uint32Array(WORDS * vertices);
  for (let i = 2; i < light.length; i += WORDS) light[i] = 0x7e00;
  const attribute = new BufferAttribute(light, WORDS);
  attribute.gpuType = IntType;
  attribute.setUsage(DynamicDrawUsage);
  return attribute;
}

function integers(array: Uint16Array, size: number): BufferAttribute {
  const attribute = new BufferAttribute(array, size);
  attribute.gpuType = IntType;
  return once(attribute);
}

/** Memory of what never changes is given up once it is on the GPU. */
function once(attribute: BufferAttribute): BufferAttribute {
  attribute.onUpload(() => {
    (attribute as { array: unknown }).array = new (attribute.array.constructor as new (n: number) => typeof attribute.array)(0);
  });
  return attribute;
}

export function boxOf({ min, step }: Chunk): Box3 {
  return new Box3(new Vector3(...min), new Vector3(...min.map((m, k) => m + 65_535 * step[k]!)));
}

function fillVertices({ positions, normals }: MeshData, chunk: Chunk, number: number, first: number, place: Uint16Array, normal: Int8Array): void {
  for (let k = 0; k < chunk.vertices; k++) {
    const [from, to] = [chunk.first_vertex + k, 4 * (first + k)];
    place[to] = positions[3 * from]!;
    place[to + 1] = positions[3 * from + 1]!;
    place[to + 2] = positions[3 * from + 2]!;
    place[to + 3] = number;
    normal[to] = normals[2 * from]!;
    normal[to + 1] = normals[2 * from + 1]!;
  }
}
