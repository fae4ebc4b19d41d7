// Judges loaders/three in headless Chromium: what its example reads, dims and shows, beside what the command says of the same map.
// Usage: node loader-three.mjs ISOLUX [PICTURES]; with a folder, pictures of the example are kept there
import { mkdtemp, readFile, rm, writeFile } from 'node:fs/promises';
import { createServer } from 'node:http';
import { tmpdir } from 'node:os';
import { extname, join, normalize, resolve } from 'node:path';
import { findBrowser, launch } from './walk/browser.mjs';
import { atMost, require, runAll } from './walk/cases.mjs';
import { commandIn } from './walk/command.mjs';
import { EVENING, makeRoom } from './walk/room.mjs';

const HERE = import.meta.dirname;
const KINDS = { '.html': 'text/html', '.js': 'text/javascript' };
const SIZE = { width: 640, height: 360 };
/** Pixels that are read, on a grid over the picture. */
const STRIDE = 40;
// Attributes are 32-bit floats: a place is off by 2^-24 of 5 m, 3e-7 m, and light doubles within 0.1 m at the edge of a shadow. Measured: 2e-6.
const SINGLE = 1e-5;
// Where an element has a vertex in a narrow gap, such as behind the mirror, the command leaves it out at each place, a file has the mean of the
// others there. Measured: 2 of 132 places.
const IN_THE_OPEN = 0.97;
// Codes are whole numbers, and the graphics card interpolates in 32 bits.
const CODES = 1.01;
// The scale has 256 colours, between which the card blends; one step of it is at most 4 codes. Measured: 2.
const SCALE_CODES = 4;

const [binary, pictures] = process.argv.slice(2);
if (!binary) {
  console.error('usage: node loader-three.mjs ISOLUX [PICTURES]');
  process.exit(2);
}
const chromium = findBrowser();
if (!chromium) {
  console.error('there is no Chromium; install it or name it in CHROMIUM');
  process.exit(3);
}

/** Serves the package as its users have it: three beside it in node_modules, and the maps of a folder. */
async function serve(folder) {
  const loader = join(HERE, '../loaders/three');
  const places = { node_modules: join(HERE, 'node_modules'), maps: folder, example: join(loader, 'example'), 'isolux.js': join(loader, 'isolux.js') };
  const server = createServer(async (request, response) => {
    const path = normalize(new URL(request.url, 'http://here').pathname).slice(1);
    const [first, ...inside] = path.split('/');
    const bytes = places[first] && (await readFile(join(places[first], ...inside)).catch(() => null));
    response.writeHead(bytes ? 200 : path === 'favicon.ico' ? 204 : 404, { 'Content-Type': KINDS[extname(path)] ?? 'application/octet-stream' });
    response.end(bytes);
  });
  await new Promise((ready) => server.listen(0, '127.0.0.1', ready));
  return { url: `http://127.0.0.1:${server.address().port}`, stop: () => server.close() };
}

/** Readings of the page on a grid of pixels, and the codes that it shows there. */
function readAll({ stride, width, height }) {
  const { draw, readAt } = window.isoluxExample;
  draw();
  const gl = document.querySelector('canvas').getContext('webgl2');
  const found = [];
  for (let x = stride / 2; x < width; x += stride) {
    for (let y = stride / 2; y < height; y += stride) {
      const pixel = new Uint8Array(4);
      gl.readPixels(x, height - 1 - y, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
      const reading = readAt(x + 0.5, y + 0.5);
      if (reading) found.push({ ...reading, codes: [...pixel].slice(0, 3) });
    }
  }
  return found;
}

/** Readings of all vertices that are known. */
function readVertices() {
  const { map } = window.isoluxExample;
  const found = [];
  map.scene.traverse((mesh) => {
    for (let k = 0; k < (mesh.geometry?.attributes.position.count ?? 0); k++) found.push(map.readVertex(mesh, k));
  });
  return found.filter(Boolean);
}

/** A vertex by its place, to a tenth of a millimetre, and its side. */
const keyOf = (position, normal) => [...position.map((v) => Math.round(1e4 * v)), ...normal.map((v) => Math.round(10 * v))].map((v) => v + 0).join();

const srgb = (light) => 255 * (light <= 0.0031308 ? 12.92 * light : 1.055 * light ** (1 / 2.4) - 0.055);

async function cases(home) {
  const { page, command, folder } = home;
  const read = () => page.evaluate(readAll, { stride: STRIDE, ...SIZE });
  const probe = async (readings, map, ...flags) => {
    await writeFile(join(folder, 'read.pts'), readings.map(({ position, normal }) => [...position, ...normal].join(' ')).join('\n'));
    return JSON.parse(await command.run('probe', map, '--points', 'read.pts', '--json', ...flags)).points;
  };
  /** How many readings are those of the command; all but those beside narrow gaps must be. */
  const alike = (readings, points, figure) => {
    require(readings.length > 100 && points.length === readings.length, `only ${readings.length} readings`);
    require(points.every((point) => point[figure] !== null), `probe knows no ${figure} somewhere`);
    const same = readings.filter((reading, k) => Math.abs(reading[figure] - points[k][figure]) <= SINGLE * points[k][figure]);
    require(same.length >= IN_THE_OPEN * readings.length, `${figure} is the same at ${same.length} of ${readings.length} places`);
    return `${figure} at ${same.length}`;
  };
  /** Standard errors of all vertices, beside those of the table of a map: `probe` adds the interpolation error. */
  const errors = async (map) => {
    await command.run('export', map, '-o', 'table.csv', '--digits', '17');
    const [header, ...rows] = (await readFile(join(folder, 'table.csv'), 'utf8')).trim().split('\n').map((row) => row.split(','));
    const table = rows.map((row) => Object.fromEntries(header.map((name, k) => [name, row[k]])));
    const due = new Map();
    for (const row of table) {
      const key = keyOf([row.x, row.y, row.z], [row.nx, row.ny, row.nz]);
      due.set(key, [...(due.get(key) ?? []), row]);
    }
    const vertices = await page.evaluate(readVertices);
    const isNear = (value, told) => Math.abs(value - told) <= SINGLE * told;
    // Some share their place, and those in narrow gaps have the mean of others, which may be dark as they are.
    const own = vertices.flatMap((vertex) => {
      const rows = due.get(keyOf(vertex.position, vertex.normal)) ?? [];
      return rows.length === 1 && rows[0].illuminance_lx > 0 && isNear(vertex.illuminance_lx, rows[0].illuminance_lx) ? [[vertex, rows[0]]] : [];
    });
    const off = own.filter(([{ standard_error_lx: error }, row]) => !isNear(error, row.standard_error_lx));
    require(own.length > 0.5 * vertices.length, `${map} tells the lux of ${own.length} of ${vertices.length} vertices`);
    require(off.length === 0, `${off.length} of ${own.length} standard errors are not those of ${map}`);
    return `standard errors of ${own.length} of ${vertices.length} vertices`;
  };
  const change = (change) => page.evaluate((change) => Object.assign(window.isoluxExample.map, change), change);
  const dim = (levels) => page.evaluate((levels) => window.isoluxExample.map.setLevels(levels), levels);
  const picture = async (name) => {
    if (!pictures) return;
    await page.evaluate(() => new Promise((drawn) => requestAnimationFrame(() => drawn(window.isoluxExample.draw()))));
    await page.screenshot({ path: join(resolve(pictures), name) });
  };
  const refused = async (act, words) => {
    const said = await page.evaluate((act) => new Function('map', act)(window.isoluxExample.map) ?? '', act).catch(({ message }) => message);
    require(said.includes(words), `${act} says "${said}", not "${words}"`);
  };
  return [
    ['readings are those of probe --interpolated', async () => {
      const readings = await read();
      const points = await probe(readings, 'map.glb', '--interpolated');
      const figures = ['illuminance_lx', 'direct_lx'].map((figure) => alike(readings, points, figure));
      return `of ${readings.length} places, ${figures.join(', ')}, ${await errors('map.glb')}`;
    }],
    ['they are as far from probe as the map says of its interpolation', async () => {
      const readings = await read();
      const points = await probe(readings, 'map.glb');
      const { interpolated } = JSON.parse(await command.run('info', 'map.glb', '--json')).provenance.accuracy;
      const mean = points.reduce((sum, point) => sum + point.illuminance_lx, 0) / points.length;
      const squares = readings.map(({ illuminance_lx }, k) => (illuminance_lx - points[k].illuminance_lx) ** 2);
      // What the map says is a root mean square over all surfaces; the picture sees a part of them, where shadows are.
      return atMost('root mean square', Math.sqrt(squares.reduce((a, b) => a + b) / squares.length) / mean, 2 * interpolated);
    }],
    ['the map itself is read as well', async () => {
      const other = await page.evaluate(async () => {
        const { loadIlluminationMap } = await import('isolux-three');
        const map = await loadIlluminationMap('/maps/map.glb');
        const bytes = await fetch('/maps/map.glb').then((answer) => answer.arrayBuffer());
        const again = await loadIlluminationMap(bytes);
        const readings = [map, again].map((map) => {
          let first = null;
          map.scene.traverse((mesh) => (first ??= mesh.isMesh ? map.readVertex(mesh, 0) : null));
          return first;
        });
        const said = (act) => {
          try {
            act();
          } catch ({ message }) {
            return message;
          }
        };
        return { readings, said: [() => (map.exposure = 1), () => map.setLevel('spots', 1)].map(said) };
      });
      for (const said of other.said) require(said?.includes('--lux'), `exposure or level of a map without lux of groups: ${said}`);
      const [[own], [due]] = [other.readings, await probe([other.readings[0]], 'map.glb', '--interpolated')];
      require(JSON.stringify(other.readings[0]) === JSON.stringify(other.readings[1]), 'bytes are read otherwise than an address');
      return atMost('a vertex off by', Math.abs(own.illuminance_lx / due.illuminance_lx - 1), SINGLE);
    }],
    ['colours are the exposed luminance', async () => {
      const exposure = await page.evaluate(() => (window.isoluxExample.map.exposure *= 0.5));
      await picture('three-seen.png');
      const walls = (await read()).filter(({ shape }) => /room\/[xy]_m|z_max/.test(shape));
      require(walls.length > 30, `only ${walls.length} readings of walls`);
      const off = walls.map(({ rgb_lx, codes }) => Math.max(...codes.map((code, k) => Math.abs(code - Math.min(255, srgb((exposure * 0.7 * rgb_lx[k]) / Math.PI))))));
      // A pixel may lie on an edge, where it is smoothed.
      off.sort((a, b) => a - b);
      return atMost(`of ${walls.length} places, 19 of 20 within codes`, off[Math.floor(0.95 * off.length)], CODES);
    }],
    ['dimmed readings are those of mix and probe', async () => {
      await dim({ spots: EVENING[0], lamps: EVENING[1] });
      await picture('three-dimmed.png');
      const readings = await read();
      require(readings.every(({ direct_lx }) => direct_lx === null), 'direct light of groups is not in the file');
      const points = await probe(readings, 'evening.glb', '--interpolated');
      return `of ${readings.length} places, ${alike(readings, points, 'illuminance_lx')}, ${await errors('evening.glb')}`;
    }],
    ['a group that is off gives no light, and all groups back on give all', async () => {
      const before = await read();
      await dim({ spots: 0, lamps: 0 });
      require((await read()).every(({ illuminance_lx: lux }) => lux === 0), 'there is light with all groups off');
      await dim({ spots: EVENING[0], lamps: EVENING[1] });
      require(JSON.stringify(await read()) === JSON.stringify(before), 'the light is not what it was');
      return `${before.length} places`;
    }],
    ['false colours are those of the lux', async () => {
      await change({ mode: 'illuminance', limits: { low: 0, high: 100 } });
      await picture('three-false.png');
      const readings = await read();
      const due = await page.evaluate(async (shares) => {
        const { falseColour } = await import('isolux-three');
        return shares.map((share) => falseColour(Math.min(1, share)).convertLinearToSRGB().toArray());
      }, readings.map(({ illuminance_lx: lux }) => lux / 100));
      const off = readings.map(({ codes }, k) => Math.max(...codes.map((code, channel) => Math.abs(code - 255 * due[k][channel]))));
      off.sort((a, b) => a - b);
      return atMost(`of ${readings.length} places, 19 of 20 within codes`, off[Math.floor(0.95 * off.length)], SCALE_CODES);
    }],
    ['mistakes are told with their remedy', async () => {
      await refused('map.setLevel("attic", 1)', 'there are spots, lamps');
      await refused('map.setLevel("spots", -1)', 'a level is 0 or more');
      await refused('map.mode = "nice"', 'there are seen, illuminance, error');
      await refused('map.exposure = 0', 'above 0');
      await refused('map.limits = { low: 1, high: 1 }', 'from a smaller to a larger');
      const said = await page.evaluate(async () => {
        const { loadIlluminationMap } = await import('isolux-three');
        return loadIlluminationMap('/maps/colours.glb').then(() => 'nothing', ({ message }) => message);
      });
      require(said.includes('/maps/colours.glb') && said.includes('--lux'), said);
      return 'each';
    }],
    ['nothing is complained of', async () => {
      require(home.browser.heard.complaints.length === 0, home.browser.heard.complaints.join('; '));
      return `${home.browser.heard.requests.length} requests`;
    }],
  ];
}

const folder = await mkdtemp(join(tmpdir(), 'isolux-loader-'));
const command = commandIn(resolve(binary), folder);
const browser = await launch(chromium);
const server = await serve(folder);
try {
  await makeRoom(command, folder);
  await command.run('export', 'map.glb', '-o', 'light.glb', '--lux');
  await command.run('export', 'map.glb', '-o', 'colours.glb');
  const isOpen = () => window.isoluxExample;
  const page = await browser.open(`${server.url}/example/index.html?map=/maps/light.glb`, { ...SIZE, bare: false, isOpen });
  const failed = await runAll(await cases({ page, command, folder, browser }));
  if (failed > 0) {
    console.error(`${failed} cases of loaders/three fail`);
    process.exitCode = 1;
  }
} finally {
  await browser.close();
  server.stop();
  await rm(folder, { recursive: true });
}
