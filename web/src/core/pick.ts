// What a ray hits, and the light there between vertices.

import { FrontSide, Ray, Vector3 } from 'three';
import type { MeshBVH } from 'three-mesh-bvh';
import type { Reading, SceneHeader, Vec3 } from '../wire';
import { fromHalf, fromOctahedral, fromRgb9e5, isUnknown, luminance } from './codes';
import type { Model } from './model';
import { placeOf } from './planes';

export interface Hit {
  point: Vector3;
  distance: number;
  chunk: number;
  /** Vertices of the triangle and their shares. */
  vertices: Vec3;
  weights: Vec3;
}

/** Panes that a ray goes through at most. */
const MOST_PANES = 16;
const NOTHING: Reading = {
  position: null, normal: null, shape: '', material: '', diffuse_reflectance: null, illuminance_lx: null, standard_error_lx: null, direct_lx: null,
  indirect_lx: null, rgb_lx: null, luminance_cd_m2: null, found: 'vertices',
};

/** The first surface that a ray sees; panes are looked through, and so are backs. */
export function castRay(bvh: MeshBVH, model: Model, origin: Vector3, direction: Vector3): Hit | null {
  const ray = new Ray(origin.clone(), direction.clone().normalize());
  for (let i = 0; i < MOST_PANES; i++) {
    const found = bvh.raycastFirst(ray, FrontSide);
    if (!found || found.faceIndex == null) return null;
    const chunk = chunkOf(model, 3 * found.faceIndex);
    if (!model.finishes[model.data.header.chunks[chunk]!.finish]!.glass) return hitAt(model, chunk, found.faceIndex, found.point, origin);
    ray.origin.copy(found.point).addScaledVector(ray.direction, 1e-4);
  }
  return null;
}

/** The chunk that an index belongs to: chunks are in the order of their indices. */
function chunkOf({ data }: Model, index: number): number {
  const { chunks } = data.header;
  let [low, high] = [0, chunks.length - 1];
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (chunks[middle]!.first_index <= index) low = middle;
    else high = middle - 1;
  }
  return low;
}

function hitAt(model: Model, chunk: number, face: number, point: Vector3, from: Vector3): Hit {
  const { data } = model;
  const c = data.header.chunks[chunk]!;
  const vertices = [0, 1, 2].map((k) => c.first_vertex + data.index[3 * face + k]!) as Vec3;
  const [p, q, r] = vertices.map((v) => new Vector3(...placeOf(data, c, v))) as [Vector3, Vector3, Vector3];
  return { point: point.clone(), distance: point.distanceTo(from), chunk, vertices, weights: shares(point, p, q, r) };
}

/** Barycentric shares, kept within the triangle. */
function shares(at: Vector3, p: Vector3, q: Vector3, r: Vector3): Vec3 {
  const area = (a: Vector3, b: Vector3, c: Vector3): number => b.clone().sub(a).cross(c.clone().sub(a)).length();
  const parts = [area(at, q, r), area(at, r, p), area(at, p, q)];
  const all = parts[0]! + parts[1]! + parts[2]!;
  return (all > 0 ? parts.map((a) => a / all) : [1, 0, 0]) as Vec3;
}

/** The reading at a hit: means of the vertices whose light is known. Positions are as the scene has them, `origin` added. */
export function readingOf(model: Model, scene: SceneHeader, hit: Hit, which: 'light' | 'light2' = 'light'): Reading {
  const chunk = model.data.header.chunks[hit.chunk]!;
  const finish = model.finishes[chunk.finish]!;
  const place = {
    ...NOTHING,
    position: hit.point.toArray().map((c, k) => c + scene.origin[k]!) as Vec3, normal: normalOf(model, hit),
    shape: scene.shapes[chunk.shape] ?? '', material: finish.material,
  };
  if (!chunk.lit) return { ...place, luminance_cd_m2: Math.max(...finish.luminance_cd_m2) > 0 ? luminance(finish.luminance_cd_m2) : null };
  const light = lightOf(model, hit, which);
  if (!light) return place;
  const rgb = light.direct.map((d, k) => d + light.indirect[k]!) as Vec3;
  const lux = luminance(rgb);
  const colour = diffuseAt(model, hit);
  return {
    ...place, illuminance_lx: lux, standard_error_lx: Number.isFinite(light.error) ? light.error : null, rgb_lx: rgb,
    direct_lx: luminance(light.direct), indirect_lx: luminance(light.indirect),
    diffuse_reflectance: colour && (lux > 0 ? luminance(rgb.map((e, k) => e * colour[k]!)) / lux : luminance(colour)),
    luminance_cd_m2: colour && luminance(rgb.map((e, k) => (colour[k]! * e) / Math.PI + finish.luminance_cd_m2[k]!)),
  };
}

/** Diffuse reflectance in three channels; null where the texture is not there yet. */
function diffuseAt({ data, finishes, textures }: Model, { chunk, vertices, weights }: Hit): Vec3 | null {
  const { finish, first_uv, first_vertex } = data.header.chunks[chunk]!;
  const { diffuse, texture } = finishes[finish]!;
  if (texture === null || first_uv === null) return diffuse;
  const uv = [0, 1].map((k) => vertices.reduce((sum, v, i) => sum + weights[i]! * data.uvs[2 * (first_uv + v - first_vertex) + k]!, 0));
  const colour = textures[texture]?.texels?.at(uv[0]!, uv[1]!);
  return colour ? (colour.map((c, k) => c * diffuse[k]!) as Vec3) : null;
}

function normalOf({ data }: Model, { vertices, weights }: Hit): Vec3 {
  const sum = new Vector3();
  vertices.forEach((v, k) => sum.addScaledVector(new Vector3(...fromOctahedral(data.normals[2 * v]!, data.normals[2 * v + 1]!)), weights[k]!));
  return sum.normalize().toArray() as Vec3;
}

function lightOf(model: Model, { chunk, vertices, weights }: Hit, which: 'light' | 'light2'): { direct: Vec3; indirect: Vec3; error: number } | null {
  const [direct, indirect, part]: Vec3[] = [[0, 0, 0], [0, 0, 0], [0, 0, 0]];
  let [known, square] = [0, 0];
  vertices.forEach((vertex, k) => {
    const { words, at } = model.wordsOf(chunk, vertex, which);
    const [weight, code] = [weights[k]!, words[at + 2]!];
    if (isUnknown(code)) return;
    known += weight;
    if (weight > 0) square += (weight * fromHalf(code)) ** 2;
    fromRgb9e5(words[at]!, part!).forEach((c, i) => (direct![i]! += weight * c));
    fromRgb9e5(words[at + 1]!, part!).forEach((c, i) => (indirect![i]! += weight * c));
  });
  if (known < 1e-6) return null;
  const mean = (sum: Vec3): Vec3 => sum.map((c) => c / known) as Vec3;
  return { direct: mean(direct!), indirect: mean(indirect!), error: Math.sqrt(square) / known };
}

export const nothingHit = (): Reading => ({ ...NOTHING });
