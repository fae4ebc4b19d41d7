// What two maps say: readings and pins of both, their difference, and pictures that are saved.
import { readFile, writeFile } from 'node:fs/promises';
import { PNG } from 'pngjs';
import { complete, leave, set, until } from './browser.mjs';
import { atMost, require } from './cases.mjs';
import { meanDifference } from './pictures.mjs';

const DESK = { width: 1280, height: 800, bare: false };
const [LEFT, RIGHT] = ['map.glb', 'evening.glb'];
// The floor, left and right of the slider in the middle of the view.
const [HERE, THERE] = [[250, 560], [900, 700]];
// Where no pin lies over it.
const ASIDE = [700, 600];
// Exposures that far apart make quite another picture; the same one is the same but for rounding. Measured: 20.
const [OTHER_EV, LEAST_CHANGE, MOST_ALIKE] = [3, 5, 0.3];

export async function sideCases({ command, browser, at }, runAll) {
  const served = await command.serve('view', LEFT, RIGHT);
  const page = await browser.open(served.url, DESK);
  await complete(page);
  const run = { page, command, at };
  const failed = await runAll([
    ['pins are of the map that is seen where somebody clicks', () => pins(run)],
    ['a link keeps of which map pins are', () => link(browser, run)],
    ['a difference tells both values and theirs', () => difference(run)],
    ['dimmers leave the map on the right alone', () => dimmed(run)],
    ['a picture that is saved has the pins', () => picture(run)],
    ['a picture that is saved has the exposure that was asked for last', () => exposed(run)],
  ]);
  await leave(page);
  await served.stop();
  return failed;
}

const numbers = (text) => text.replace(/\u202f/g, '').replaceAll('−', '-').match(/-?\d+(\.\d+)?/g).map(Number);

/** What `probe` says of a map at the place of a reading. */
async function probed({ command, at }, map, { position, normal }) {
  await writeFile(at('side.pts'), `${[...position, ...normal].join(' ')}\n`);
  return JSON.parse(await command.run('probe', map, '--points', 'side.pts', '--json')).points[0];
}

async function pinAt(page, [x, y]) {
  const before = await page.locator('.pin-label').count();
  const box = await page.locator('#view').boundingBox();
  // Once the pointer is here, the page asks of no other place.
  await page.mouse.move(box.x + x, box.y + y);
  const answer = page.waitForResponse((response) => response.url().includes('api/read'));
  await page.mouse.click(box.x + x, box.y + y);
  const { readings } = await (await answer).json();
  await until(page, (many) => document.querySelectorAll('.pin-label').length > many, before);
  return { reading: readings[0], text: (await page.locator('.pin-label').last().innerText()).replace(/\s+/g, ' ') };
}

async function pins(run) {
  const told = [];
  for (const [place, map] of [[HERE, LEFT], [THERE, RIGHT]]) {
    const { reading, text } = await pinAt(run.page, place);
    const due = await probed(run, map, reading);
    require(reading.illuminance_lx === due.illuminance_lx, `${reading.illuminance_lx} lx, by probe ${due.illuminance_lx} lx of ${map}`);
    require(text.includes(map), `the pin says "${text}", and not ${map}`);
    told.push(text);
  }
  return told.join('; ');
}

async function link(browser, { page }) {
  await page.waitForFunction(() => location.hash.split('pin=').length === 3);
  const again = await browser.open(page.url(), DESK);
  await complete(again);
  const texts = await again.locator('.pin-label').allInnerTexts();
  await leave(again);
  const maps = texts.map((text) => text.split('\n').at(-1)).join();
  require(maps === `${LEFT},${RIGHT}`, `pins are of ${maps}`);
  return maps;
}

async function difference(run) {
  const { page } = run;
  await set(page, { mode: 'difference' });
  const both = await page.evaluate(([x, y]) => window.isoluxViewer.readBothAt(x, y, new AbortController().signal), ASIDE);
  const box = await page.locator('#view').boundingBox();
  await page.mouse.move(box.x + ASIDE[0], box.y + ASIDE[1]);
  const card = page.locator('.hover').filter({ hasText: 'as probe reads it' });
  await card.waitFor();
  const [large, error] = numbers(await card.locator('.value').innerText());
  const lines = await card.locator('dd').allInnerTexts();
  const [own, other] = [await probed(run, LEFT, both.own), await probed(run, RIGHT, both.other)];
  require(both.own.illuminance_lx === own.illuminance_lx, `${both.own.illuminance_lx} lx of ${LEFT}, by probe ${own.illuminance_lx}`);
  require(both.other.illuminance_lx === other.illuminance_lx, `${both.other.illuminance_lx} lx of ${RIGHT}, by probe ${other.illuminance_lx}`);
  const [due, wide] = [own.illuminance_lx - other.illuminance_lx, Math.hypot(own.standard_error_lx, other.standard_error_lx)];
  require(Math.abs(large - due) < 0.1 * wide && Math.abs(error - wide) < 0.1 * wide, `${large} ± ${error} lx, due is ${due} ± ${wide}`);
  const text = (await card.innerText()).replace(/\s+/g, ' ');
  require(lines.length === 2 && text.includes(LEFT) && text.includes(RIGHT), `the card says "${text}"`);
  await set(page, { mode: 'seen' });
  return text.slice(0, text.indexOf('as probe'));
}

/** They are those of the first map, in its picture as in its readings. */
async function dimmed({ page }) {
  const read = () => page.evaluate(([[x, y], [u, v]]) => [window.isoluxViewer.glanceAt(x, y), window.isoluxViewer.glanceAt(u, v)].map((r) => r.illuminance_lx), [HERE, THERE]);
  const before = await read();
  const both = await numbersOfPicture(page, { dimming: [1, 1], autoExposure: false });
  const dark = await numbersOfPicture(page, { dimming: [0.1, 0.1] });
  const after = await read();
  await set(page, { dimming: [1, 1], autoExposure: true });
  require(after[0] < 0.11 * before[0] && after[1] === before[1], `${before} lx become ${after}`);
  const half = (of, k) => part(of, k * Math.round(of.width / 2));
  const [left, right] = [0, 1].map((k) => meanDifference(half(both, k), half(dark, k)));
  require(left > LEAST_CHANGE, `the picture on the left changes by ${left.toFixed(2)} only`);
  return `${before.map((lx) => lx.toFixed(1)).join(' and ')} lx become ${after.map((lx) => lx.toFixed(1)).join(' and ')}; ${atMost('mean CIE94 on the right', right, MOST_ALIKE)}`;
}

async function numbersOfPicture(page, change) {
  await set(page, change);
  return snapshot(page);
}

/** Half of a picture, without the slider in the middle. */
function part(picture, from) {
  const width = Math.floor(picture.width / 2) - 30;
  const half = new PNG({ width, height: picture.height });
  PNG.bitblt(picture, half, from === 0 ? 0 : from + 30, 0, width, picture.height, 0, 0);
  return half;
}

async function snapshot(page) {
  const base64 = await page.evaluate(async () => {
    const bytes = new Uint8Array(await (await window.isoluxViewer.snapshot()).arrayBuffer());
    return btoa(Array.from(bytes, (byte) => String.fromCharCode(byte)).join(''));
  });
  return PNG.sync.read(Buffer.from(base64, 'base64'));
}

/** The picture that the page saves. */
async function saved(page) {
  const [download] = await Promise.all([page.waitForEvent('download'), page.getByRole('button', { name: 'Save a picture (PNG)' }).click()]);
  return PNG.sync.read(await readFile(await download.path()));
}

/** Pins are amber discs, where the page has them. */
async function picture({ page }) {
  // New labels are placed with the next picture.
  await until(page, () => [...document.querySelectorAll('.pin-label')].every((label) => label.style.transform));
  const file = await saved(page);
  const places = await page.evaluate(() => {
    const view = document.getElementById('view').getBoundingClientRect();
    return [...document.querySelectorAll('.pin-label .pin-number')].map((e) => e.getBoundingClientRect()).map((b) => [b.left + 4 - view.left, b.top + b.height / 2 - view.top]);
  });
  require(places.length === 2, `${places.length} pins on the page`);
  const colours = places.map(([x, y]) => [0, 1, 2].map((k) => file.data[4 * (Math.round(y) * file.width + Math.round(x)) + k]));
  for (const [r, g, b] of colours) require(r > 200 && g > 130 && g < 200 && b < 90, `at a pin the picture has the colour ${[r, g, b]}`);
  return `${colours.length} pins in ${file.width} x ${file.height} pixels`;
}

async function exposed({ page }) {
  const automatic = await snapshot(page);
  const take = (change) => page.evaluate(async (change) => {
    window.isoluxViewer.set(change);
    const bytes = new Uint8Array(await (await window.isoluxViewer.snapshot()).arrayBuffer());
    return btoa(Array.from(bytes, (byte) => String.fromCharCode(byte)).join(''));
  }, change).then((base64) => PNG.sync.read(Buffer.from(base64, 'base64')));
  const bright = await take({ autoExposure: false, ev100: OTHER_EV });
  const back = await take({ autoExposure: true });
  const change = meanDifference(automatic, bright);
  require(change > LEAST_CHANGE, `the picture at EV ${OTHER_EV} differs by ${change.toFixed(2)} only`);
  return `mean CIE94 ${change.toFixed(1)} at EV ${OTHER_EV}; ${atMost('and back', meanDifference(automatic, back), MOST_ALIKE)}`;
}
