// Compares pictures of one map: that of the browsers of virtual worlds with each other, and with one of isolux.
// Usage: node pictures.mjs --exposure M2_CD --white CD_M2 --full CD_M2 [--light] RENDER.png PICTURE.png...
// RENDER is linear, its full code stands for the luminance `full`, black where nothing is; it is tone mapped as the
// colours of walk-throughs are (Reinhard et al. 2002, equation 4).
import { readFileSync } from 'node:fs';
import { parseArgs } from 'node:util';
import { PNG } from 'pngjs';

// Browsers interpolate colours alike but for rounding; a pixel of a contour may go to either side.
const SAME_CODES = 2;
const SAME_SHARE = 0.999;
// Codes of isolux's picture and of the vertices are rounded, 1 each; between vertices browsers interpolate codes, isolux lux,
// and isolux smooths contours. Measured on the Cornell box: 88 % of the pixels within 1, 97.1 % within 8.
const NEAR_SHARE = 0.95;
const NEAR_CODES = 8;
// With --light a viewer interpolates light as isolux does, after tone mapping where isolux does before. What is left is the rounding
// of isolux's linear picture, which exposure makes two codes of, and edges. Measured: 96.1 % within 2, 98.5 % within 8.
const NEAR_LIGHT_CODES = 2;

const options = { exposure: { type: 'string' }, white: { type: 'string' }, full: { type: 'string' }, light: { type: 'boolean' } };
const { values, positionals } = parseArgs({ options, allowPositionals: true });
const [exposure, white, full] = [values.exposure, values.white, values.full].map(Number);
const nearCodes = values.light ? NEAR_LIGHT_CODES : NEAR_CODES;
const [render, ...pictures] = positionals.map((file) => ({ file, ...PNG.sync.read(readFileSync(file)) }));
if (!(exposure > 0 && white > 0 && full > 0) || pictures.length === 0) {
  console.error('usage: node pictures.mjs --exposure X --white X --full X [--light] RENDER.png PICTURE.png...');
  process.exit(2);
}

const linear = (code) => (code <= 0.04045 * 255 ? code / 255 / 12.92 : ((code / 255 + 0.055) / 1.055) ** 2.4);
const srgb = (light) => 255 * (light <= 0.0031308 ? 12.92 * light : 1.055 * light ** (1 / 2.4) - 0.055);

function toned(codes) {
  const exposed = codes.map((code) => linear(code) * full * exposure);
  const x = 0.2126 * exposed[0] + 0.7152 * exposed[1] + 0.0722 * exposed[2];
  const factor = (1 + x / (white * exposure) ** 2) / (1 + x);
  return exposed.map((c) => srgb(Math.min(1, c * factor)));
}

const codesAt = ({ data }, pixel) => [0, 1, 2].map((channel) => data[4 * pixel + channel]);
// Where isolux sees the scene and its picture is not cut off.
const pixels = [...Array(render.width * render.height).keys()].filter((pixel) => {
  const codes = codesAt(render, pixel);
  return codes.some((code) => code > 0) && codes.every((code) => code < 255);
});

function share(within, a, b) {
  const isNear = (pixel) => [0, 1, 2].every((k) => Math.abs(a(pixel)[k] - b(pixel)[k]) <= within);
  return pixels.filter(isNear).length / pixels.length;
}

function expect(what, found, due) {
  console.log(`${what}: ${(100 * found).toFixed(2)} %`);
  if (found >= due) return;
  console.error(`${what}: less than ${100 * due} %`);
  process.exitCode = 1;
}

if (pixels.length < 0.1 * render.width * render.height) {
  console.error(`${render.file} shows ${pixels.length} pixels of a scene`);
  process.exit(1);
}
for (const picture of pictures) {
  if (picture.width !== render.width || picture.height !== render.height) {
    console.error(`${picture.file} has ${picture.width} x ${picture.height} pixels`);
    process.exit(1);
  }
  const at = (pixel) => codesAt(picture, pixel);
  const near = share(nearCodes, (pixel) => toned(codesAt(render, pixel)), at);
  expect(`pixels of ${picture.file} within ${nearCodes} codes of isolux`, near, NEAR_SHARE);
  if (picture === pictures[0]) continue;
  const same = share(SAME_CODES, (pixel) => codesAt(pictures[0], pixel), at);
  expect(`pixels of ${picture.file} within ${SAME_CODES} codes of ${pictures[0].file}`, same, SAME_SHARE);
}
