// Pictures of pages and files, and how much they differ.
import { readFileSync } from 'node:fs';
import { PNG } from 'pngjs';
import { complete, PATIENCE_MS } from './browser.mjs';

// So many pictures in a row are the same once a page rests; a page that reads its exposure shows some of the old one before.
const SAME = 5;

/** The picture of a page once nothing in it changes any more. */
export async function settled(page) {
  await complete(page);
  const until = Date.now() + PATIENCE_MS;
  const shoot = () => page.screenshot();
  let [last, same] = [await shoot(), 1];
  while (same < SAME) {
    if (Date.now() > until) throw new Error('the picture does not come to rest');
    const next = await shoot();
    same = next.equals(last) ? same + 1 : 1;
    last = next;
  }
  return PNG.sync.read(last);
}

export const read = (file) => PNG.sync.read(readFileSync(file));

/** The left part of a picture, without the legend beside it. */
export function cropped(picture, width) {
  const part = new PNG({ width, height: picture.height });
  PNG.bitblt(picture, part, 0, 0, width, picture.height, 0, 0);
  return part;
}

function requireSameSize(a, b) {
  if (a.width !== b.width || a.height !== b.height) throw new Error(`pictures of ${a.width} x ${a.height} and ${b.width} x ${b.height} pixels`);
}

const LINEAR = Array.from({ length: 256 }, (_, code) => (code <= 0.04045 * 255 ? code / 255 / 12.92 : ((code / 255 + 0.055) / 1.055) ** 2.4));
// The kink of CIE 1976 lightness, and its slope below.
const [DARK, SLOPE] = [216 / 24389, 24389 / 27];
const root = (t) => (t > DARK ? Math.cbrt(t) : (SLOPE * t + 16) / 116);

/** CIE 1976 L*a*b* of codes of sRGB (IEC 61966-2-1), white D65. */
function lab(data, at) {
  const [r, g, b] = [LINEAR[data[at]], LINEAR[data[at + 1]], LINEAR[data[at + 2]]];
  const x = root((0.4124 * r + 0.3576 * g + 0.1805 * b) / 0.9505);
  const y = root(0.2126 * r + 0.7152 * g + 0.0722 * b);
  const z = root((0.0193 * r + 0.1192 * g + 0.9505 * b) / 1.089);
  return [116 * y - 16, 500 * (x - y), 200 * (y - z)];
}

/** CIE94 difference of graphic arts (k_L = 1, K1 = 0.045, K2 = 0.015) of a colour from a reference. */
export function cie94([l1, a1, b1], [l2, a2, b2]) {
  const [c1, c2] = [Math.hypot(a1, b1), Math.hypot(a2, b2)];
  const [dl, da, db, dc] = [l1 - l2, a1 - a2, b1 - b2, c1 - c2];
  const dh2 = Math.max(0, da * da + db * db - dc * dc);
  return Math.sqrt(dl * dl + (dc / (1 + 0.045 * c1)) ** 2 + dh2 / (1 + 0.015 * c1) ** 2);
}

/** Mean CIE94 difference of a picture from a reference. */
export function meanDifference(reference, picture) {
  requireSameSize(reference, picture);
  const pixels = reference.width * reference.height;
  let sum = 0;
  for (let at = 0; at < 4 * pixels; at += 4) sum += cie94(lab(reference.data, at), lab(picture.data, at));
  return sum / pixels;
}

/** Share of pixels of which every channel is so near. */
export function shareWithin(codes, a, b) {
  requireSameSize(a, b);
  const pixels = a.width * a.height;
  let near = 0;
  for (let at = 0; at < 4 * pixels; at += 4) near += [0, 1, 2].every((k) => Math.abs(a.data[at + k] - b.data[at + k]) <= codes);
  return near / pixels;
}
