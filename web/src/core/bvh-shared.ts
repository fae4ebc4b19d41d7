// What both sides of building the tree share.

import { BufferAttribute, BufferGeometry } from 'three';
import type { MeshBVH } from 'three-mesh-bvh';

export interface Triangles {
  positions: Float32Array<ArrayBuffer>;
  index: Uint32Array<ArrayBuffer>;
}

export interface Built {
  positions: Float32Array<ArrayBuffer>;
  index: Uint32Array<ArrayBuffer>;
  serialized: ReturnType<typeof MeshBVH.serialize>;
}

export const OPTIONS = { indirect: true, targetLeafSize: 8 } as const;

export function geometryOf({ positions, index }: Triangles): BufferGeometry {
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(positions, 3));
  geometry.setIndex(new BufferAttribute(index, 1));
  return geometry;
}
