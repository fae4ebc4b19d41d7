// Judges an illumination map as three.js sees it: every surface with preview colours must carry lux,
// finite and consistent, under unlit materials.
// Usage: node three.mjs FILE.glb...
import assert from 'node:assert/strict';
import { readFile } from 'node:fs/promises';

// GLTFLoader decodes pictures by what browsers offer. Nothing is drawn here, so a picture without
// pixels will do.
globalThis.self ??= globalThis;
globalThis.createImageBitmap ??= async () => ({ width: 1, height: 1, close() {} });

const { GLTFLoader } = await import('three/addons/loaders/GLTFLoader.js');

// GLTFLoader writes the names of custom attributes in lower case.
const LIGHT = { _illuminance_lx: 3, _direct_lx: 3, _stderr_lx: 1 };
const NOT_KNOWN = -1;
const ERROR_NOT_KNOWN = -2;

async function load(file) {
  const bytes = await readFile(file);
  const buffer = bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength);
  const gltf = await new GLTFLoader().parseAsync(buffer, '');
  // As a viewer does before it draws: matrices of nodes become those of the world.
  gltf.scene.updateMatrixWorld(true);
  return gltf;
}

function checkGeometry(name, { attributes, index }) {
  const count = attributes.position.count;
  for (const [attribute, { array, count: found }] of Object.entries(attributes)) {
    assert.equal(found, count, `${name}: ${attribute} has ${found} of ${count} vertices`);
    assert.ok(array.every(Number.isFinite), `${name}: ${attribute} is finite`);
  }
  assert.ok(index.count > 0 && index.count % 3 === 0, `${name}: whole triangles`);
  assert.ok(index.array.every((vertex) => vertex < count), `${name}: indices are in range`);
}

function checkLight(name, { attributes }) {
  for (const [attribute, itemSize] of Object.entries(LIGHT)) {
    assert.equal(attributes[attribute]?.itemSize, itemSize, `${name}: ${attribute}`);
  }
  const { _illuminance_lx: illuminance, _direct_lx: direct, _stderr_lx: error } = attributes;
  for (let k = 0; k < error.count; k++) {
    const known = error.getX(k) !== NOT_KNOWN;
    assert.ok(!known || error.getX(k) >= 0 || error.getX(k) === ERROR_NOT_KNOWN, `${name}: error`);
    for (let channel = 0; channel < 3; channel++) {
      const [total, part] = [illuminance, direct].map((a) => a.getComponent(k, channel));
      assert.ok(part >= 0 && part <= total, `${name}: direct ${part} of ${total} lx`);
      assert.ok(known || total === 0, `${name}: unknown is marked by zero`);
    }
  }
}

async function check(file) {
  const gltf = await load(file);
  const { isolux } = gltf.userData;
  assert.equal(isolux?.quantity, 'illuminance', `${file}: the record of the map arrives`);
  const seen = { meshes: 0, lit: 0, vertices: 0, triangles: 0 };
  gltf.scene.traverse((object) => {
    if (!object.isMesh) return;
    const { name, geometry, material } = object;
    assert.equal(material.type, 'MeshBasicMaterial', `${name}: unlit`);
    checkGeometry(name, geometry);
    seen.meshes += 1;
    seen.vertices += geometry.attributes.position.count;
    seen.triangles += geometry.index.count / 3;
    if (geometry.attributes.color) {
      assert.ok(material.vertexColors, `${name}: shows its colours`);
      checkLight(name, geometry);
      seen.lit += 1;
    }
  });
  assert.ok(seen.lit > 0, `${file}: at least one surface carries light`);
  console.log(`${file}: ${JSON.stringify(seen)}`);
}

const files = process.argv.slice(2);
if (files.length === 0) {
  console.error('usage: node three.mjs FILE.glb...');
  process.exit(2);
}
for (const file of files) await check(file);
