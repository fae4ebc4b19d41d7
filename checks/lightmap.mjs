// Judges light as three.js shows it, in a browser without a window: a card of known reflectance under a known
// illuminance must have the luminance rho E / pi, from the lightmap in the .glb, from the .ktx2 beside it, and from colours
// of vertices and a lightmap written onto somebody's file in other .glb of the same folder.
// Usage: node lightmap.mjs CARD.glb VERTICES.glb ONTO.glb REFLECTANCE ILLUMINANCE_LX
// The browser is CHROMIUM, or `chromium` of the path; exit code 77 says that there is none.
import assert from 'node:assert/strict';
import { spawn } from 'node:child_process';
import { mkdtemp, readFile, rm } from 'node:fs/promises';
import { createServer } from 'node:http';
import { tmpdir } from 'node:os';
import { basename, dirname, extname, join, normalize } from 'node:path';

const HERE = import.meta.dirname;
const KINDS = { '.html': 'text/html', '.js': 'text/javascript', '.mjs': 'text/javascript', '.wasm': 'application/wasm' };
const NO_BROWSER = 77;
const PATIENCE_MS = 60_000;
// Half a code of eight bits of sRGB near white is 0.5 %, half a step of nine bits 0.2 %; the card is read in the middle of
// its texels, whose own errors are below. Colours of vertices are 32-bit floats on all their way: ten roundings.
const TOLERANCE = { embedded: 0.01, ktx2: 0.005, vertices: 1e-6, onto: 0.01 };

const [file, vertices, onto, reflectance, illuminance] = process.argv.slice(2);
if (!illuminance) {
  console.error('usage: node lightmap.mjs CARD.glb VERTICES.glb ONTO.glb REFLECTANCE ILLUMINANCE_LX');
  process.exit(2);
}

function folderOf(path) {
  if (path.startsWith('/three/')) return [join(HERE, 'node_modules'), path];
  if (path.startsWith('/files/')) return [dirname(file), path.slice('/files'.length)];
  return [HERE, path];
}

let tell;
const told = new Promise((resolve) => (tell = resolve));

const server = createServer(async (request, response) => {
  const path = normalize(new URL(request.url, 'http://here').pathname);
  if (path === '/result') {
    let text = '';
    for await (const part of request) text += part;
    response.end();
    tell(JSON.parse(text));
    return;
  }
  const [folder, inside] = folderOf(path);
  try {
    const bytes = await readFile(join(folder, inside));
    response.setHeader('Content-Type', KINDS[extname(inside)] ?? 'application/octet-stream');
    response.end(bytes);
  } catch {
    response.statusCode = 404;
    response.end();
  }
});
await new Promise((ready) => server.listen(0, '127.0.0.1', ready));
const [name, ofVertices, written] = [file, vertices, onto].map((path) => basename(path, '.glb'));
const url = `http://127.0.0.1:${server.address().port}/lightmap.html?file=${name}&vertices=${ofVertices}&onto=${written}`;
const profile = await mkdtemp(join(tmpdir(), 'lightmap-'));
const flags = ['--headless', '--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', `--user-data-dir=${profile}`];
const browser = spawn(process.env.CHROMIUM ?? 'chromium', [...flags, url], { stdio: 'ignore' });
const gone = new Promise((resolve) => browser.on('exit', resolve));
browser.on('error', (error) => tell(error.code === 'ENOENT' ? null : { error: String(error) }));
const patience = setTimeout(() => tell({ error: 'the page came to no result' }), PATIENCE_MS);
const result = await told;
clearTimeout(patience);
server.close();
server.closeAllConnections();
if (browser.pid) {
  browser.kill();
  await gone;
}
await rm(profile, { recursive: true, force: true, maxRetries: 5 });
if (result === null) {
  console.log('no browser');
  process.exit(NO_BROWSER);
}
assert.equal(result.error, undefined);
const expected = (reflectance * illuminance) / Math.PI;
for (const [way, tolerance] of Object.entries(TOLERANCE)) {
  for (const found of result[way]) {
    const off = found / expected - 1;
    assert.ok(Math.abs(off) < tolerance, `${way}: ${found} cd/m2 in place of ${expected}: off by ${off}`);
  }
}
console.log(`${file}: ${expected.toFixed(2)} cd/m2 expected, three.js ${result.three} (${result.material}) shows ${JSON.stringify(result)}`);
