// Inside the browser: draws the mesh `card` of a file lit by its lightmap, as embedded and from the KTX2 beside it, and
// tells the luminance in its middle; the same of a file with colours of vertices, of which it says what white is, and of
// somebody's file that a lightmap was written onto.
import * as THREE from 'three';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
import { KTX2Loader } from 'three/addons/loaders/KTX2Loader.js';

// MOZ_lightmap: what a page that shows such files has to bring along.
class Lightmaps {
  constructor(parser) {
    this.parser = parser;
    this.name = 'MOZ_lightmap';
  }

  async extendMaterialParams(index, params) {
    const lightmap = this.parser.json.materials[index].extensions?.[this.name];
    if (!lightmap) return;
    params.lightMap = await this.parser.getDependency('texture', lightmap.index);
    params.lightMap.colorSpace = THREE.SRGBColorSpace;
    params.lightMap.channel = lightmap.texCoord ?? 1;
    params.lightMapIntensity = lightmap.intensity ?? 1;
  }
}

const renderer = new THREE.WebGLRenderer();

function cardOf(gltf) {
  const card = gltf.scene.getObjectByName('card');
  return card.isMesh ? card : card.getObjectByProperty('isMesh', true);
}

// Linear pixels in the middle of the card, seen from above.
function luminanceOf(gltf) {
  const target = new THREE.WebGLRenderTarget(9, 9, { type: THREE.FloatType });
  const scene = new THREE.Scene();
  const mesh = cardOf(gltf);
  mesh.updateWorldMatrix(true, false);
  const box = new THREE.Box3().setFromObject(mesh);
  const [middle, size] = [box.getCenter(new THREE.Vector3()), box.getSize(new THREE.Vector3())];
  const half = 0.2 * size.x;
  const camera = new THREE.OrthographicCamera(-half, half, half, -half, 0.01, 10);
  camera.position.copy(middle).add(new THREE.Vector3(0, 1, 0));
  camera.up.set(0, 0, -1);
  camera.lookAt(middle);
  scene.add(gltf.scene);
  renderer.setRenderTarget(target);
  renderer.render(scene, camera);
  const pixels = new Float32Array(4 * 81);
  renderer.readRenderTargetPixels(target, 0, 0, 9, 9, pixels);
  return [0, 1, 2].map((channel) => pixels[4 * 40 + channel]);
}

async function luminanceOfVertices(name) {
  const gltf = await new GLTFLoader().loadAsync(`/files/${name}.glb`);
  const white = gltf.userData.isolux_vertices.white_cd_m2;
  return luminanceOf(gltf).map((colour) => colour * white);
}

async function run() {
  const asked = new URLSearchParams(location.search);
  const name = asked.get('file');
  const load = (file) => new GLTFLoader().register((parser) => new Lightmaps(parser)).loadAsync(`/files/${file}.glb`);
  const gltf = await load(name);
  const { material } = cardOf(gltf);
  const embedded = luminanceOf(gltf);
  const texture = await new KTX2Loader().detectSupport(renderer).loadAsync(`/files/${name}.ktx2`);
  texture.channel = 1;
  texture.magFilter = texture.minFilter = THREE.LinearFilter;
  material.lightMap = texture;
  material.lightMapIntensity = 1;
  material.needsUpdate = true;
  const ktx2 = luminanceOf(gltf);
  const vertices = await luminanceOfVertices(asked.get('vertices'));
  const onto = luminanceOf(await load(asked.get('onto')));
  return { embedded, ktx2, vertices, onto, material: material.type, three: THREE.REVISION };
}

const tell = (result) => fetch('/result', { method: 'POST', body: JSON.stringify(result) });
run().then(tell, (error) => tell({ error: String(error?.stack ?? error) }));
