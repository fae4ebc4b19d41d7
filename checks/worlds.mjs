// Draws a walk-through (.wrl, .x3d) with X_ITE, or a map (.glb) with three.js from its first camera, in headless Chromium.
// Usage: node worlds.mjs WIDTHxHEIGHT FILE.wrl|FILE.x3d|FILE.glb OUTPUT.png [FILE OUTPUT.png]...
import { createServer } from 'node:http';
import { readFile, writeFile } from 'node:fs/promises';
import { existsSync } from 'node:fs';
import { basename, extname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { chromium } from 'playwright-core';

const HERE = fileURLToPath(new URL('.', import.meta.url));
const BROWSERS = ['/usr/bin/chromium', '/usr/bin/chromium-browser', '/usr/bin/google-chrome'];
const TYPES = { '.html': 'text/html', '.css': 'text/css', '.mjs': 'text/javascript', '.js': 'text/javascript', '.wrl': 'model/vrml', '.glb': 'model/gltf-binary', '.x3d': 'model/x3d+xml' };
// Until a world of this size is drawn; a machine without a graphics card draws in software.
const PATIENCE_MS = 120_000;

// Under these names pages find the packages.
const PACKAGES = { '/x_ite/': 'node_modules/x_ite/dist', '/three/': 'node_modules/three' };

const worldPage = (file, width, height) => `<!DOCTYPE html>
<script type="module" src="/x_ite/x_ite.mjs"></script>
<style>x3d-canvas { position: fixed; inset: 0; width: ${width}px; height: ${height}px; max-height: ${height}px }</style>
<x3d-canvas src="/world/${file}" contentScale="1" antialiased="false" splashScreen="false" notifications="false"></x3d-canvas>
<script type="module">
import X3D from '/x_ite/x_ite.mjs';
const canvas = document.querySelector('x3d-canvas');
canvas.addEventListener('error', () => { window.failed = true; });
canvas.addEventListener('load', async () => {
  const browser = X3D.getBrowser(canvas);
  // Gravity would pull a visitor who walks from the viewpoint.
  for (const node of browser.currentScene.rootNodes) {
    if (node.getNodeTypeName() !== 'NavigationInfo') continue;
    node.type = new X3D.MFString('NONE');
    node.transitionType = new X3D.MFString('TELEPORT');
  }
  browser.firstViewpoint();
  // Several frames, for the first may be before the viewpoint is bound.
  for (let frame = 0; frame < 3; frame++) await browser.nextFrame();
  window.picture = await canvas.toDataURL('image/png');
});
</script>`;

// Without tone mapping: the colours of vertices are finished, three.js encodes them as sRGB.
const mapPage = (file, width, height) => `<!DOCTYPE html>
<script type="importmap">{ "imports": { "three": "/three/build/three.module.js", "three/addons/": "/three/examples/jsm/" } }</script>
<script type="module">
import * as THREE from 'three';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
try {
  const gltf = await new GLTFLoader().loadAsync('/world/${file}');
  const renderer = new THREE.WebGLRenderer({ preserveDrawingBuffer: true });
  renderer.setSize(${width}, ${height});
  const [camera] = gltf.cameras;
  camera.aspect = ${width / height};
  camera.updateProjectionMatrix();
  renderer.render(gltf.scene, camera);
  window.picture = renderer.domElement.toDataURL('image/png');
} catch (error) {
  console.error(error);
  window.failed = true;
}
</script>`;

const page = (file, width, height) => (extname(file) === '.glb' ? mapPage : worldPage)(file, width, height);

function pathOf(url) {
  const [prefix, folder] = Object.entries(PACKAGES).find(([prefix]) => url.startsWith(prefix)) ?? ['/', 'nowhere'];
  return join(HERE, folder, decodeURIComponent(url.slice(prefix.length)));
}

function serve(world, width, height) {
  const server = createServer(async (request, response) => {
    const name = basename(decodeURIComponent(request.url.split('?')[0]));
    if (name === 'favicon.ico') return response.writeHead(204).end();
    const type = TYPES[extname(name)] ?? 'application/octet-stream';
    try {
      const isWorld = request.url.startsWith('/world/');
      const isPage = request.url === '/';
      const path = isWorld ? world : pathOf(request.url);
      const body = isPage ? page(basename(world), width, height) : await readFile(path);
      response.writeHead(200, { 'content-type': isPage ? TYPES['.html'] : type });
      response.end(body);
    } catch {
      response.writeHead(404);
      response.end();
    }
  });
  return new Promise((resolve) => server.listen(0, '127.0.0.1', () => resolve(server)));
}

async function draw(browser, world, output, width, height) {
  const server = await serve(world, width, height);
  const tab = await browser.newPage({ viewport: { width, height } });
  const said = [];
  tab.on('console', (message) => { if (message.type() === 'error') said.push(message.text()); });
  tab.on('pageerror', (error) => said.push(String(error)));
  try {
    await tab.goto(`http://127.0.0.1:${server.address().port}/`);
    await tab.waitForFunction(() => window.picture || window.failed, null, { timeout: PATIENCE_MS });
    const picture = await tab.evaluate(() => window.picture);
    if (!picture) throw new Error('it could not be read');
    // Warnings may be of the graphics; a file that is read in part makes an error.
    if (said.length > 0) throw new Error('the page complains');
    await writeFile(output, Buffer.from(picture.split(',')[1], 'base64'));
  } catch (error) {
    throw new Error(`${world}: ${error.message}\n${said.join('\n')}`);
  } finally {
    await tab.close();
    server.close();
  }
}

const [size, ...files] = process.argv.slice(2);
const [width, height] = (size ?? '').split('x').map(Number);
if (!width || !height || files.length === 0 || files.length % 2 !== 0) {
  console.error('usage: node worlds.mjs WIDTHxHEIGHT FILE OUTPUT.png...');
  process.exit(2);
}
const executablePath = process.env.CHROMIUM ?? BROWSERS.find(existsSync);
if (!executablePath) {
  console.error('there is no Chromium; install it or name it in CHROMIUM');
  process.exit(3);
}
// Software rendering is the same on every machine.
const args = ['--no-sandbox', '--use-angle=swiftshader', '--use-gl=angle', '--enable-unsafe-swiftshader', '--ignore-gpu-blocklist'];
const browser = await chromium.launch({ executablePath, args });
try {
  for (let k = 0; k < files.length; k += 2) await draw(browser, files[k], files[k + 1], width, height);
} finally {
  await browser.close();
}
