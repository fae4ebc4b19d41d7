// Makes meshopt_v0.glb, meshopt_v1.glb and draco.glb: the same grid, compressed by the encoders of npm.
// npm install meshoptimizer@1.3.0 draco3dgltf@1.5.7 @gltf-transform/core@4.5.1 @gltf-transform/extensions@4.5.1 @gltf-transform/functions@4.5.1
// node make_compressed.mjs DIRECTORY
import { NodeIO } from '@gltf-transform/core';
import { KHRDracoMeshCompression } from '@gltf-transform/extensions';
import { draco } from '@gltf-transform/functions';
import draco3d from 'draco3dgltf';
import { MeshoptEncoder } from 'meshoptimizer';
import { writeFileSync } from 'node:fs';

await MeshoptEncoder.ready;
const directory = process.argv[2];
const SIDE = 20;

// All coordinates are multiples of 1/32: exact as floats.
const positions = [], normals = [], colours = [], corners = [];
for (let j = 0; j < SIDE; j++) {
  for (let i = 0; i < SIDE; i++) {
    positions.push(i / 8, ((i * i + 3 * j) % 8) / 32, j / 8);
    const normal = [i - 9.5, 12, j - 9.5];
    const length = Math.hypot(...normal);
    normals.push(...normal.map((c) => c / length), 0);
    colours.push(i / 19, 0.5, j / 19, 1);
  }
}
for (let j = 0; j + 1 < SIDE; j++) {
  for (let i = 0; i + 1 < SIDE; i++) {
    const [a, b, c, d] = [j * SIDE + i, j * SIDE + i + 1, (j + 1) * SIDE + i, (j + 1) * SIDE + i + 1];
    corners.push(a, c, b, b, c, d);
  }
}
const count = SIDE * SIDE;
const bytes = (array) => new Uint8Array(array.buffer, array.byteOffset, array.byteLength);

// Copies: shifted along x, turned about y, scaled.
const COPIES = 5;
const shifts = [], turns = [], scales = [];
for (let k = 0; k < COPIES; k++) {
  const half = (k * Math.PI) / 10;
  shifts.push(4 * k, 0.25, -1.5);
  turns.push(0, Math.sin(half), 0, Math.cos(half));
  scales.push(1 + k / 4, 1, 1);
}

function glb(json, binary) {
  const text = new TextEncoder().encode(JSON.stringify(json));
  const pad = (array, fill) => {
    const out = new Uint8Array(Math.ceil(array.length / 4) * 4).fill(fill);
    out.set(array);
    return out;
  };
  const chunks = [[0x4e4f534a, pad(text, 32)], [0x004e4942, pad(binary, 0)]];
  const length = 12 + chunks.reduce((sum, [, data]) => sum + 8 + data.length, 0);
  const out = new DataView(new ArrayBuffer(length));
  [0x46546c67, 2, length].forEach((word, k) => out.setUint32(4 * k, word, true));
  let at = 12;
  for (const [kind, data] of chunks) {
    out.setUint32(at, data.length, true);
    out.setUint32(at + 4, kind, true);
    new Uint8Array(out.buffer).set(data, at + 8);
    at += 8 + data.length;
  }
  return new Uint8Array(out.buffer);
}

function meshopt(version) {
  const name = version === 0 ? 'EXT_meshopt_compression' : 'KHR_meshopt_compression';
  const json = {
    asset: { version: '2.0' }, scene: 0, scenes: [{ nodes: [0, 1] }],
    extensionsUsed: [name, 'KHR_mesh_quantization', 'EXT_mesh_gpu_instancing'],
    extensionsRequired: [name, 'KHR_mesh_quantization', 'EXT_mesh_gpu_instancing'],
    materials: [{ pbrMetallicRoughness: { metallicFactor: 0 } }],
    buffers: [{ byteLength: 0 }, { byteLength: 0, extensions: { [name]: { fallback: true } } }],
    bufferViews: [], accessors: [],
  };
  let binary = new Uint8Array(0);
  const add = (plain, elements, stride, mode, filter, accessor) => {
    const packed = MeshoptEncoder.encodeGltfBuffer(plain, elements, stride, mode, version);
    const byteOffset = Math.ceil(binary.length / 4) * 4;
    const grown = new Uint8Array(byteOffset + packed.length);
    grown.set(binary);
    grown.set(packed, byteOffset);
    binary = grown;
    const extension = { buffer: 0, byteOffset, byteLength: packed.length, byteStride: stride, mode, count: elements };
    if (filter) extension.filter = filter;
    const view = { buffer: 1, byteOffset: json.buffers[1].byteLength, byteLength: elements * stride,
      extensions: { [name]: extension } };
    if (mode === 'ATTRIBUTES') view.byteStride = stride;
    json.bufferViews.push(view);
    json.buffers[1].byteLength += elements * stride;
    json.accessors.push({ bufferView: json.bufferViews.length - 1, count: elements, ...accessor });
    return json.accessors.length - 1;
  };
  const POSITION = add(bytes(new Float32Array(positions)), count, 12, 'ATTRIBUTES', null,
    { componentType: 5126, type: 'VEC3', min: [0, 0, 0], max: [2.375, 0.21875, 2.375] });
  const exponential = add(bytes(MeshoptEncoder.encodeFilterExp(new Float32Array(positions), count, 12, 15)), count, 12,
    'ATTRIBUTES', 'EXPONENTIAL', { componentType: 5126, type: 'VEC3', min: [0, 0, 0], max: [2.375, 0.21875, 2.375] });
  const NORMAL = add(bytes(MeshoptEncoder.encodeFilterOct(new Float32Array(normals), count, 4, 8)), count, 4,
    'ATTRIBUTES', 'OCTAHEDRAL', { componentType: 5120, normalized: true, type: 'VEC3' });
  const fine = add(bytes(MeshoptEncoder.encodeFilterOct(new Float32Array(normals), count, 8, 12)), count, 8,
    'ATTRIBUTES', 'OCTAHEDRAL', { componentType: 5122, normalized: true, type: 'VEC3' });
  const triangles = add(bytes(new Uint16Array(corners)), corners.length, 2, 'TRIANGLES', null,
    { componentType: 5123, type: 'SCALAR' });
  const indices = add(bytes(new Uint32Array(corners)), corners.length, 4, 'INDICES', null,
    { componentType: 5125, type: 'SCALAR' });
  const first = { attributes: { POSITION, NORMAL }, indices: triangles, material: 0 };
  const second = { attributes: { POSITION: exponential, NORMAL: fine }, indices, material: 0 };
  if (version === 1) {
    first.attributes.COLOR_0 = add(bytes(MeshoptEncoder.encodeFilterColor(new Float32Array(colours), count, 4, 8)), count, 4,
      'ATTRIBUTES', 'COLOR', { componentType: 5121, normalized: true, type: 'VEC4' });
  }
  const attributes = {
    TRANSLATION: add(bytes(MeshoptEncoder.encodeFilterExp(new Float32Array(shifts), COPIES, 12, 15)), COPIES, 12,
      'ATTRIBUTES', 'EXPONENTIAL', { componentType: 5126, type: 'VEC3' }),
    ROTATION: add(bytes(MeshoptEncoder.encodeFilterQuat(new Float32Array(turns), COPIES, 8, 16)), COPIES, 8,
      'ATTRIBUTES', 'QUATERNION', { componentType: 5122, normalized: true, type: 'VEC4' }),
    SCALE: add(bytes(new Float32Array(scales)), COPIES, 12, 'ATTRIBUTES', null, { componentType: 5126, type: 'VEC3' }),
  };
  json.meshes = [{ name: 'first', primitives: [first] }, { name: 'second', primitives: [second] }];
  json.nodes = [{ mesh: 0 }, { mesh: 1, extensions: { EXT_mesh_gpu_instancing: { attributes } } }];
  json.buffers[0].byteLength = binary.length;
  writeFileSync(`${directory}/meshopt_v${version}.glb`, glb(json, binary));
  return { json, binary };
}

meshopt(0);
meshopt(1);

const plain = new Uint8Array([...bytes(new Float32Array(positions)), ...bytes(new Uint16Array(corners))]);
const json = {
  asset: { version: '2.0' }, scene: 0, scenes: [{ nodes: [0] }], nodes: [{ mesh: 0 }],
  materials: [{ pbrMetallicRoughness: { metallicFactor: 0 } }],
  meshes: [{ name: 'grid', primitives: [{ attributes: { POSITION: 0 }, indices: 1, material: 0 }] }],
  buffers: [{ byteLength: plain.length }],
  bufferViews: [{ buffer: 0, byteLength: 12 * count }, { buffer: 0, byteOffset: 12 * count, byteLength: 2 * corners.length }],
  accessors: [
    { bufferView: 0, componentType: 5126, type: 'VEC3', count, min: [0, 0, 0], max: [2.375, 0.21875, 2.375] },
    { bufferView: 1, componentType: 5123, type: 'SCALAR', count: corners.length },
  ],
};
const io = new NodeIO().registerExtensions([KHRDracoMeshCompression]).registerDependencies({
  'draco3d.encoder': await draco3d.createEncoderModule(), 'draco3d.decoder': await draco3d.createDecoderModule(),
});
for (const method of ['edgebreaker', 'sequential']) {
  const document = await io.readBinary(glb(json, plain));
  await document.transform(draco({ method, quantizePosition: 14 }));
  writeFileSync(`${directory}/draco_${method}.glb`, await io.writeBinary(document));
}
