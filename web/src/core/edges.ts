// Edges of elements, as thin lines.

import { BufferAttribute, BufferGeometry, GLSL3, LineSegments, RawShaderMaterial } from 'three';
import { LAYER, type Model } from './model';
import { PLACES } from './shader-common';

const VERTEX = /* glsl */ `
precision highp float;
precision highp int;
${PLACES}
void main() {
  int chunk = int(uFirstChunk + place.w);
  vec4 low = chunkTexel(2 * chunk), size = chunkTexel(2 * chunk + 1);
  vec4 eye = viewMatrix * vec4(low.xyz + size.xyz * vec3(place.xyz), 1.0);
  // Lines lie a little before their surfaces, and surfaces without elements have none.
  eye.xyz *= 0.9985;
  gl_Position = projectionMatrix * eye;
  if (size.w < 0.5) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
}
`;

const FRAGMENT = /* glsl */ `
precision highp float;
out vec4 colour;
void main() { colour = vec4(vec3(0.75), 0.35); }
`;

/** Adds lines to a model; they share its vertices. */
export class Edges {
  #lines: LineSegments[] = [];
  #model: Model | null = null;

  show(model: Model | null): void {
    if (model === this.#model) return;
    this.clear();
    this.#model = model;
    for (const { batch, geometry } of model?.parts ?? []) {
      if (batch.kind === 'glass') continue;
      const lines = new BufferGeometry();
      lines.setAttribute('place', geometry.getAttribute('place'));
      lines.setIndex(new BufferAttribute(edgesOf(model!, batch.chunks), 1));
      lines.boundingSphere = geometry.boundingSphere;
      const material = new RawShaderMaterial({
        glslVersion: GLSL3, vertexShader: VERTEX, fragmentShader: FRAGMENT, transparent: true, depthWrite: false,
        uniforms: { uChunks: model!.materials.world.uChunks, uFirstChunk: { value: batch.firstChunk } },
      });
      const object = new LineSegments(lines, material);
      object.layers.set(LAYER.marks);
      object.matrixAutoUpdate = false;
      object.renderOrder = 20;
      model!.group.add(object);
      this.#lines.push(object);
    }
  }

  clear(): void {
    for (const line of this.#lines) {
      line.removeFromParent();
      // The vertices belong to the surfaces: only the indices go.
      line.geometry.deleteAttribute('place');
      line.geometry.dispose();
      (line.material as RawShaderMaterial).dispose();
    }
    this.#lines = [];
    this.#model = null;
  }
}

/** Every edge of the triangles once, as pairs of vertices of the batch. */
function edgesOf({ data, slots }: Model, chunks: number[]): Uint16Array {
  const all: Uint16Array[] = chunks.map((i) => {
    const chunk = data.header.chunks[i]!;
    return chunk.lit ? chunkEdges(data.index.subarray(chunk.first_index, chunk.first_index + chunk.indices), slots[i]!.firstVertex) : new Uint16Array(0);
  });
  const joined = new Uint16Array(all.reduce((sum, { length }) => sum + length, 0));
  let at = 0;
  for (const part of all) {
    joined.set(part, at);
    at += part.length;
  }
  return joined;
}

function chunkEdges(index: Uint16Array | Uint32Array, first: number): Uint16Array {
  const codes = new Float64Array(index.length);
  for (let k = 0; k < index.length; k++) {
    const a = index[k]!;
    const b = index[k % 3 === 2 ? k - 2 : k + 1]!;
    codes[k] = Math.min(a, b) * 65_536 + Math.max(a, b);
  }
  codes.sort();
  const pairs = new Uint16Array(2 * codes.length);
  let count = 0;
  for (let k = 0; k < codes.length; k++) {
    if (k > 0 && codes[k] === codes[k - 1]) continue;
    pairs[count++] = first + Math.floor(codes[k]! / 65_536);
    pairs[count++] = first + (codes[k]! % 65_536);
  }
  return pairs.slice(0, count);
}
