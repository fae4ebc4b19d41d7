// Walking: by keys and by fingers, against walls, onto floors.
import { complete, leave, until } from './browser.mjs';
import { require } from './cases.mjs';

// The room of `room.mjs`, and a walker in it.
const ROOM = [4, 5, 2.8];
const [EYES, BODY] = [1.65, 0.25];
// Where nothing stands around, and the ways that keys go from there while looking along y.
const [MIDDLE, AHEAD] = [[1, 1, EYES], [1, 3, EYES]];
const WAYS = { w: [0, 1], s: [0, -1], a: [-1, 0], d: [1, 0] };
const LONG_MS = 700;
// Out of that corner all others are more than ten metres of running away.
const ACROSS_MS = 2500;
// Coordinates are 16-bit shares of a room, and steps end a tenth of a millimetre before walls.
const NEAR_M = 0.02;
const DESK = { width: 640, height: 400, bare: false };
const PHONE = { width: 390, height: 844, bare: false, phone: true };

export async function stepCases({ command, browser }, runAll) {
  const served = await command.serve('view', 'map.glb');
  const page = await browser.open(served.url, DESK);
  const phone = await browser.open(served.url, PHONE);
  for (const each of [page, phone]) {
    await complete(each);
    await each.getByRole('button', { name: 'Walk', exact: true }).click();
  }
  const failed = await runAll([
    ['keys walk ahead, back and aside', () => ways(page)],
    ['walls stop who runs into them', () => walls(page)],
    ['a table stops who runs into it', () => table(page)],
    ['who drops lands on the floor', () => drops(page)],
    ['nobody rises through the ceiling or sinks into the floor', () => rises(page)],
    ['a finger on the left half walks, one on the right half looks', () => fingers(phone)],
    ['walls stop fingers, too', () => fingersAtWall(phone)],
    ['a tap while walking keeps a reading', () => taps(phone)],
  ]);
  await Promise.all([page, phone].map(leave));
  await served.stop();
  return failed;
}

const place = (page) => page.evaluate(() => window.isoluxViewer.view().position);
const lookingAt = (page) => page.evaluate(() => {
  const { position, target } = window.isoluxViewer.view();
  return target.map((v, k) => (v - position[k]) / 2);
});
const metres = (at) => at.map((v) => v.toFixed(2)).join(' ');

/** Puts the walker somewhere, and waits until it stands still. */
async function stand(page, position = MIDDLE, target = AHEAD) {
  await page.evaluate(([position, target]) => window.isoluxViewer.goTo({ position, target, fovDeg: 55 }, false), [position, target]);
  return still(page);
}

async function still(page) {
  let before = await place(page);
  for (let same = 0; same < 3; ) {
    await page.waitForTimeout(60);
    const now = await place(page);
    same = now.every((v, k) => Math.abs(v - before[k]) < 1e-6) ? same + 1 : 0;
    before = now;
  }
  return before;
}

/** Holds keys for a while; all places on the way, and the last one. */
async function hold(page, keys, ms) {
  const seen = [];
  for (const key of keys) await page.keyboard.down(key);
  for (const end = Date.now() + ms; Date.now() < end; ) {
    seen.push(await place(page));
    await page.waitForTimeout(20);
  }
  for (const key of [...keys].reverse()) await page.keyboard.up(key);
  return [...seen, await still(page)];
}

async function ways(page) {
  const told = [];
  for (const [key, [x, y]] of Object.entries(WAYS)) {
    const from = await stand(page);
    const to = (await hold(page, [key], LONG_MS)).at(-1);
    const [along, aside] = [(to[0] - from[0]) * x + (to[1] - from[1]) * y, (to[0] - from[0]) * y - (to[1] - from[1]) * x];
    require(along > 0.2 && Math.abs(aside) < 0.01, `${key} goes ${along.toFixed(2)} m its way and ${aside.toFixed(2)} m aside`);
    told.push(`${key} ${along.toFixed(2)} m`);
  }
  return told.join(', ');
}

/** Out of the room by a side or through the floor or the ceiling. */
function requireInside(seen) {
  for (const at of seen) {
    const isIn = at.every((v, k) => v > (k < 2 ? BODY - NEAR_M : 0.1) && v < ROOM[k] - (k < 2 ? BODY - NEAR_M : 0.05));
    require(isIn, `at ${metres(at)} in a room of ${metres(ROOM)}`);
  }
}

async function walls(page) {
  let many = 0;
  for (const to of [[1, 9, EYES], [-9, 1, EYES], [1, -9, EYES], [9, 1, EYES], [-4, -4, EYES], [-4, 9, EYES]]) {
    await stand(page, MIDDLE, to);
    const seen = await hold(page, ['Shift', 'w'], ACROSS_MS);
    requireInside(seen);
    const end = seen.at(-1);
    const off = Math.min(end[0], ROOM[0] - end[0], end[1], ROOM[1] - end[1]);
    require(off < BODY + NEAR_M, `running to ${metres(to)} ends at ${metres(end)}, ${off.toFixed(2)} m before a wall`);
    many += seen.length;
  }
  return `${many} places seen, none beyond a wall`;
}

/** A sheet at 0.74 m from 1.4 to 2.6 and from 1.8 to 3.4 m is too high to be stepped on. */
async function table(page) {
  await stand(page, [2, 0.6, EYES], [2, 3, EYES]);
  const seen = await hold(page, ['w'], ACROSS_MS);
  requireInside(seen);
  const far = Math.max(...seen.map(([, y]) => y));
  require(far < 1.8 && far > 1.3, `the walker comes to y = ${far.toFixed(2)} m before the table at 1.8 m`);
  return `stops ${(1.8 - far).toFixed(2)} m before it`;
}

async function drops(page) {
  const end = await stand(page, [1, 1, 2.7], [1, 3, 2.7]);
  require(Math.abs(end[2] - EYES) < NEAR_M, `eyes at ${end[2].toFixed(3)} m in place of ${EYES}`);
  return `from 2.70 m to ${end[2].toFixed(3)} m`;
}

async function rises(page) {
  await stand(page);
  const up = await hold(page, ['e'], ACROSS_MS);
  const down = await hold(page, ['q'], ACROSS_MS);
  requireInside([...up, ...down]);
  const [top, low] = [Math.max(...up.map(([, , z]) => z)), Math.min(...down.map(([, , z]) => z))];
  require(top > 2.3, `E comes to ${top.toFixed(2)} m only`);
  require(low < 0.5, `Q comes to ${low.toFixed(2)} m only`);
  return `${low.toFixed(2)} to ${top.toFixed(2)} m below a ceiling at ${ROOM[2]} m`;
}

/** Draws a finger over the canvas, and lets it rest there for a while before it is lifted. */
async function draw(page, from, to, ms) {
  const session = await page.context().newCDPSession(page);
  const touch = (type, points) => session.send('Input.dispatchTouchEvent', { type, touchPoints: points.map(([x, y]) => ({ x, y, id: 1 })) });
  await touch('touchStart', [from]);
  for (let i = 1; i <= 5; i++) await touch('touchMove', [from.map((v, k) => v + ((to[k] - v) * i) / 5)]);
  const seen = [];
  for (const end = Date.now() + ms; Date.now() < end; ) {
    seen.push(await place(page));
    await page.waitForTimeout(20);
  }
  await touch('touchEnd', []);
  await session.detach();
  return [...seen, await still(page)];
}

async function fingers(page) {
  const from = await stand(page);
  const to = (await draw(page, [90, 500], [90, 440], LONG_MS)).at(-1);
  require(to[1] - from[1] > 0.2, `a finger that goes up walks ${(to[1] - from[1]).toFixed(2)} m ahead`);
  const rest = await still(page);
  require(rest.every((v, k) => Math.abs(v - to[k]) < 1e-6), 'the walker goes on without a finger');
  const before = await lookingAt(page);
  const after = await draw(page, [300, 500], [240, 460], 50).then(() => lookingAt(page));
  const turned = (Math.acos(Math.min(1, before.reduce((sum, v, k) => sum + v * after[k], 0))) * 180) / Math.PI;
  const stayed = await place(page);
  require(turned > 5, `a finger on the right half turns by ${turned.toFixed(1)} degrees`);
  require(stayed.every((v, k) => Math.abs(v - rest[k]) < 1e-3), 'a finger on the right half walks');
  return `${(to[1] - from[1]).toFixed(2)} m ahead, ${turned.toFixed(0)} degrees round`;
}

async function fingersAtWall(page) {
  await stand(page, MIDDLE, [-9, 1, EYES]);
  const seen = await draw(page, [90, 500], [90, 420], ACROSS_MS);
  requireInside(seen);
  require(seen.at(-1)[0] < BODY + NEAR_M, `ends at ${metres(seen.at(-1))}`);
  return `ends ${seen.at(-1)[0].toFixed(2)} m before the wall`;
}

async function taps(page) {
  await stand(page);
  await page.touchscreen.tap(200, 400);
  await page.locator('.pin-label').waitFor();
  await until(page, () => !document.querySelector('.hover').hidden);
  return page.locator('.pin-label').innerText().then((text) => text.replace(/\s+/g, ' '));
}
