// Triangles in a tree, for rays and collisions. It is built beside the page where that is possible.

import { MeshBVH } from 'three-mesh-bvh';
import type { MeshData } from './batches';
import { geometryOf, OPTIONS, type Built, type Triangles } from './bvh-shared';
import BvhWorker from './bvh.worker?worker&inline';

/** With more triangles than this, the server finds what a ray hits, if there is one. */
export const MOST_FOR_SERVER = 6_000_000;

/** Positions in metres, and indices that count from the first vertex of all. */
export function trianglesOf(data: MeshData): Triangles {
  const positions = new Float32Array(data.positions.length);
  const index = new Uint32Array(data.index.length);
  for (const { min, step, first_vertex, vertices, first_index, indices } of data.header.chunks) {
    for (let i = 3 * first_vertex, end = i + 3 * vertices; i < end; i += 3) {
      positions[i] = min[0] + step[0] * data.positions[i]!;
      positions[i + 1] = min[1] + step[1] * data.positions[i + 1]!;
      positions[i + 2] = min[2] + step[2] * data.positions[i + 2]!;
    }
    for (let k = first_index; k < first_index + indices; k++) index[k] = first_vertex + data.index[k]!;
  }
  return { positions, index };
}

/** Builds the tree; `signal` gives it up. */
export async function buildBvh(data: MeshData, signal: AbortSignal): Promise<MeshBVH | null> {
  if (data.index.length === 0) return null;
  try {
    return await buildBeside(trianglesOf(data), signal);
  } catch {
    if (signal.aborted) return null;
    return new MeshBVH(geometryOf(trianglesOf(data)), OPTIONS);
  }
}

function buildBeside(triangles: Triangles, signal: AbortSignal): Promise<MeshBVH> {
  return new Promise((resolve, reject) => {
    const worker = new BvhWorker();
    const end = (call: () => void): void => {
      worker.terminate();
      call();
    };
    worker.onmessage = ({ data }: MessageEvent<Built>) => end(() => resolve(MeshBVH.deserialize(data.serialized, geometryOf(data), { setIndex: false })));
    worker.onerror = (event) => end(() => reject(new Error(event.message)));
    signal.addEventListener('abort', () => end(() => reject(new Error('given up'))));
    worker.postMessage(triangles, [triangles.positions.buffer, triangles.index.buffer]);
  });
}
