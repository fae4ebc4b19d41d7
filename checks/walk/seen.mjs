// What is seen, beside what `render` draws.
import { complete, leave, lit, set, until, vertices } from './browser.mjs';
import { atMost, require } from './cases.mjs';
import { EVENING } from './room.mjs';
import { cropped, meanDifference, read, settled, shareWithin } from './pictures.mjs';

const SIZE = '640x360';
const WIDTH = 640;
// A map with finer shadows differs from light that is read afresh; edges of things are not smooth where a machine without a graphics
// card draws. Measured: 0.5.
const MOST_CIE94 = 2;
// Those edges, and vertices of two meshes of one map. Measured: 0.1 to 0.4.
const MOST_ALIKE = 1;
// Colour maps change by three codes or less from a colour to the next; light is shown by 9 bits; edges are not smooth.
const NEAR_CODES = 4;
const NEAR_SHARE = 0.95;

export async function seenCases(home, runAll) {
  return (await bareCases(home, runAll)) + (await finerCases(home, runAll));
}

/** Of a map with groups, which is shown as it is. */
async function bareCases(home, runAll) {
  const served = await home.command.serve('view', 'map.glb');
  const page = await home.browser.open(served.url);
  const failed = await runAll([
    ['time to the first light', () => timeToReady(home.browser, served.url)],
    ['false colour', () => falseColour(home, page)],
    ['dimmed light is that of a mixed map', () => dimmed(home, page)],
    ...(await names(page)).map((tone) => [`tone operator ${tone}`, () => toned(home, page, tone)]),
  ]);
  home.bareVertices = await vertices(page);
  await leave(page);
  await served.stop();
  return failed;
}

/** Of one without, which gets finer shadows after a while. */
async function finerCases(home, runAll) {
  const served = await home.command.serve('view', 'alone/map.glb');
  const page = await home.browser.open(served.url);
  const failed = await runAll([
    ['finer shadows arrive', () => finer(page, home.bareVertices)],
    ['as seen', () => asSeen(home, page, 'door', 0)],
    ['as seen, with a mirror', () => asSeen(home, page, 'mirror', 1)],
  ]);
  await leave(page);
  await served.stop();
  return failed;
}

const names = (page) => page.evaluate(() => window.isoluxViewer.scene.tones.map(({ name }) => name));

async function timeToReady(browser, url) {
  const page = await browser.open(url);
  const ms = await lit(page);
  await complete(page);
  const all = await page.evaluate(() => performance.now());
  await leave(page);
  return `${(ms / 1000).toFixed(2)} s from navigation; ${(all / 1000).toFixed(2)} s with all shaders and sorted triangles`;
}

async function rendered({ command, at }, map, name, ...how) {
  await command.run('render', map, '-o', name, '--size', SIZE, ...how);
  return read(at(name));
}

async function asSeen(home, page, camera, index) {
  await set(page, { mode: 'seen', autoExposure: true, luminaires: 'off' });
  await page.evaluate((index) => window.isoluxViewer.goToCamera(index, false), index);
  const picture = await settled(page);
  const due = await rendered(home, 'map.glb', `${camera}.png`, '--camera', camera);
  return atMost('mean CIE94', meanDifference(due, picture), MOST_CIE94);
}

async function toned(home, page, tone) {
  const ev = await fixedExposure(page);
  await set(page, { mode: 'seen', luminaires: 'off', tone });
  const picture = await settled(page);
  const due = await rendered(home, 'map.glb', `${tone}.png`, '--camera', 'door', '--interpolated', '--exposure', `ev${ev}`, '--tone', tone);
  return `${atMost('mean CIE94', meanDifference(due, picture), MOST_ALIKE)} at EV ${ev}`;
}

/** Fixes the exposure at a round value near the one that is automatic. */
export async function fixedExposure(page) {
  await complete(page);
  const ev100 = await page.evaluate(() => Math.round(window.isoluxViewer.exposure().ev100));
  await set(page, { autoExposure: false, ev100 });
  return ev100;
}

async function falseColour(home, page) {
  await set(page, { mode: 'illuminance', luminaires: 'off' });
  await complete(page);
  const { low, high } = await page.evaluate(() => window.isoluxViewer.legend());
  await set(page, { limits: { low, high } });
  const picture = await settled(page);
  await set(page, { mode: 'seen', limits: null });
  const due = await rendered(home, 'map.glb', 'lux.png', '--camera', 'door', '--false-colour', '--interpolated', '--limits', `${low}:${high}`);
  const share = shareWithin(NEAR_CODES, cropped(due, WIDTH), picture);
  const text = `${(100 * share).toFixed(2)} % of the pixels within ${NEAR_CODES} codes`;
  require(share >= NEAR_SHARE, `${text}, less than ${100 * NEAR_SHARE} %`);
  return `${text}, from ${low} to ${high} lx`;
}

async function finer(page, few) {
  await until(page, (few) => window.isoluxViewer.stats().vertices > few, few);
  await complete(page);
  return `${await vertices(page)} vertices after ${few}`;
}

async function dimmed(home, page) {
  await set(page, { mode: 'seen', luminaires: 'off' });
  const ev100 = await fixedExposure(page);
  await set(page, { dimming: EVENING });
  const picture = await settled(page);
  await set(page, { dimming: [1, 1] });
  const served = await home.command.serve('view', 'evening.glb');
  const mixed = await home.browser.open(served.url);
  await set(mixed, { luminaires: 'off', autoExposure: false, ev100 });
  const due = await settled(mixed);
  await leave(mixed);
  await served.stop();
  return atMost('mean CIE94', meanDifference(due, picture), MOST_ALIKE);
}
