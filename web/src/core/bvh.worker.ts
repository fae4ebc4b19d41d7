// Builds the tree of triangles beside the page.

import { MeshBVH } from 'three-mesh-bvh';
import { geometryOf, OPTIONS, type Built, type Triangles } from './bvh-shared';

const scope = self as unknown as { onmessage: (event: MessageEvent<Triangles>) => void; postMessage(data: unknown, transfer: Transferable[]): void };

scope.onmessage = ({ data }) => {
  const bvh = new MeshBVH(geometryOf(data), OPTIONS);
  const serialized = MeshBVH.serialize(bvh, { cloneBuffers: false });
  const { index: _index, ...rest } = serialized as unknown as { index: unknown; roots: ArrayBuffer[]; indirectBuffer: Uint32Array | null };
  const built = { ...data, serialized: { ...rest, index: null } } as unknown as Built;
  const buffers = [...rest.roots, rest.indirectBuffer?.buffer].filter((b): b is ArrayBuffer => b instanceof ArrayBuffer);
  scope.postMessage(built, [data.positions.buffer, data.index.buffer, ...buffers]);
};
