// Plane surfaces that mirror, grouped by plane.

import { Vector3 } from 'three';
import type { Chunk, Finish, Vec3 } from '../wire';
import type { MeshData } from './batches';
import { fromOctahedral } from './codes';

/** Lobes narrower than this are drawn as sharp reflections. */
export const SMOOTH_ALPHA = 0.02;
const SAME_NORMAL = 1 - 1e-4;

export interface Plane {
  normal: Vector3;
  point: Vector3;
  chunks: number[];
  /** The greatest share of light that it mirrors, looked at straight on. */
  weight: number;
}

export const isShiny = ({ mirror, gloss, coat }: Finish): boolean => Math.max(...mirror) > 0 || gloss !== null || coat !== null;

/** How much a finish mirrors sharply, straight on. */
function sharpWeight({ mirror, gloss, coat }: Finish): number {
  const glossy = gloss && gloss.alpha < SMOOTH_ALPHA ? Math.max(...gloss.f0) : 0;
  const coated = coat && coat.alpha < SMOOTH_ALPHA ? 0.04 * coat.cover : 0;
  return Math.max(...mirror) + glossy + coated;
}

/** The planes of chunks that mirror sharply, and which one each chunk is on (-1: none). */
export function findPlanes(data: MeshData, finishes: Finish[]): { planes: Plane[]; planeOf: Int32Array } {
  const { chunks } = data.header;
  const planes: Plane[] = [];
  const planeOf = new Int32Array(chunks.length).fill(-1);
  chunks.forEach((chunk, i) => {
    const finish = finishes[chunk.finish];
    const weight = finish && !finish.glass ? sharpWeight(finish) : 0;
    const found = weight > 0 ? planeOfChunk(data, chunk) : null;
    if (!found) return;
    const known = planes.findIndex((p) => isSame(p, found));
    planeOf[i] = known >= 0 ? known : planes.push({ ...found, chunks: [], weight: 0 }) - 1;
    const plane = planes[planeOf[i]!]!;
    plane.chunks.push(i);
    plane.weight = Math.max(plane.weight, weight);
  });
  return { planes, planeOf };
}

function isSame(a: Plane, b: { normal: Vector3; point: Vector3 }): boolean {
  return a.normal.dot(b.normal) > SAME_NORMAL && Math.abs(a.normal.dot(b.point) - a.normal.dot(a.point)) < 2e-3;
}

/** The plane that all vertices of a chunk lie on with one normal, if there is one. */
function planeOfChunk(data: MeshData, chunk: Chunk): { normal: Vector3; point: Vector3 } | null {
  if (chunk.vertices === 0) return null;
  const normalAt = (i: number): Vector3 => new Vector3(...fromOctahedral(data.normals[2 * i]!, data.normals[2 * i + 1]!));
  const first = normalAt(chunk.first_vertex);
  const point = placeOf(data, chunk, chunk.first_vertex);
  const from = new Vector3(...point);
  const off = Math.max(5e-4, 2 * Math.hypot(...chunk.step));
  const to = new Vector3();
  for (let i = chunk.first_vertex; i < chunk.first_vertex + chunk.vertices; i++) {
    const distance = to.set(...placeOf(data, chunk, i)).sub(from).dot(first);
    if (Math.abs(distance) > off || normalAt(i).dot(first) < SAME_NORMAL) return null;
  }
  return { normal: first, point: from };
}

/** Where a vertex is. */
export function placeOf({ positions }: MeshData, { min, step }: Chunk, vertex: number): Vec3 {
  return [0, 1, 2].map((k) => min[k]! + step[k]! * positions[3 * vertex + k]!) as Vec3;
}
