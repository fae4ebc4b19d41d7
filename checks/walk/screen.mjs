// What people press, on a phone and by keys, and links.
import { complete, leave, set } from './browser.mjs';
import { atMost, require } from './cases.mjs';
import { meanDifference, settled } from './pictures.mjs';

const DESK = { width: 1280, height: 800, bare: false };
const PHONE = { width: 390, height: 844, bare: false, phone: true };
const BAR = [/^Shown/, 'Cameras', 'Orbit', 'Walk', 'More'];
const TABS = ['Readings', 'Light', 'Section', 'Grids', 'Map'];
const MODES = ['seen', 'illuminance', 'luminance', 'direct', 'indirect', 'error', 'relative'];
// From the top of the page; the canvas takes the focus, too.
const MOST_TABS = 4;
// Places of a link are rounded to a millimetre.
const LINK_ROUNDING_M = 0.0006;
// That moves edges by less than a pixel.
const MOST_ALIKE = 0.5;

export async function screenCases({ command, browser }, runAll) {
  const served = await command.serve('view', 'map.glb');
  const pages = { phone: await browser.open(served.url, PHONE), desk: await browser.open(served.url, DESK) };
  for (const page of Object.values(pages)) await complete(page);
  const failed = await runAll([
    ['a phone has room for all', () => phone(pages.phone)],
    ['panels open on a phone', () => panels(pages.phone)],
    ['Tab comes to the bar', () => tabs(pages.desk)],
    ['digits change what is shown', () => digits(pages.desk)],
    ['a click keeps a reading', () => pins(pages.desk)],
    ['a link shows the same again', () => link(browser, served.url)],
  ]);
  await Promise.all(Object.values(pages).map(leave));
  await served.stop();
  return failed;
}

async function requireNoOverflow(page, where) {
  const { scroll, width, wide } = await page.evaluate(overflow);
  require(scroll <= width, `${where} is ${scroll} pixels wide in a window of ${width}`);
  require(wide.length === 0, `${where}, out of the window of ${width}: ${wide[0]}`);
}

/** How far the page reaches, and what is pressed beyond the sides of the window. */
function overflow() {
  const width = window.innerWidth;
  const boxes = [...document.querySelectorAll('button, input, select, a')].filter((e) => e.checkVisibility()).map((e) => [e, e.getBoundingClientRect()]);
  const out = boxes.filter(([, box]) => box.width > 0 && (box.left < -1 || box.right > width + 1));
  const wide = out.map(([e, box]) => `${e.getAttribute('aria-label') ?? e.textContent.trim()} from ${box.left.toFixed(0)} to ${box.right.toFixed(0)}`);
  return { scroll: document.documentElement.scrollWidth, width: document.documentElement.clientWidth, wide };
}

/** A finger at the middle of a button meets it. */
async function requireReachable(button, name) {
  const meets = await button.evaluate((e) => {
    const box = e.getBoundingClientRect();
    const met = document.elementFromPoint(box.left + box.width / 2, box.top + box.height / 2);
    return e.contains(met);
  });
  require(meets, `${name} cannot be reached`);
}

const named = (page, name) => page.getByRole('button', { name, exact: typeof name === 'string' });

async function phone(page) {
  await requireNoOverflow(page, 'the page');
  for (const name of [...BAR, ...TABS]) await requireReachable(named(page, name), `the button ${name}`);
  await named(page, 'More').tap();
  await requireNoOverflow(page, 'the menu');
  const items = await page.getByRole('menu', { name: 'More' }).getByRole('menuitem').count();
  require(items > 0, 'the menu has nothing in it');
  await page.keyboard.press('Escape');
  return `${BAR.length + TABS.length} buttons reachable at 390 x 844`;
}

async function panels(page) {
  const sheet = page.locator('.panel');
  for (const name of TABS) {
    await named(page, name).tap();
    await sheet.getByRole('heading', { name, exact: true, level: 2 }).waitFor();
    await requireNoOverflow(page, `the panel ${name}`);
  }
  await page.getByRole('button', { name: 'Close the panel' }).tap();
  await sheet.waitFor({ state: 'hidden' });
  return `${TABS.length} panels open and close`;
}

async function tabs(page) {
  const isInBar = () => page.evaluate(() => document.activeElement?.closest('.top-bar') !== null);
  let pressed = 0;
  while (!(await isInBar())) {
    require(pressed < MOST_TABS, `not reached by ${MOST_TABS} presses of Tab`);
    await page.keyboard.press('Tab');
    pressed += 1;
  }
  const name = await page.evaluate(() => document.activeElement.getAttribute('aria-label'));
  await page.keyboard.press('Enter');
  await page.getByRole('menu', { name: 'Shown' }).waitFor();
  await page.keyboard.press('Escape');
  return `${pressed} presses to "${name}", which opens by Enter`;
}

async function digits(page) {
  for (const [k, mode] of [...MODES.entries()].reverse()) {
    await page.keyboard.press(String(k + 1));
    await page.waitForFunction((mode) => window.isoluxViewer.settings.mode === mode, mode);
  }
  return `${MODES.length} modes`;
}

/** The panel of readings tells what was read where somebody clicked. */
async function pins(page) {
  await named(page, 'Readings').click();
  const box = await page.locator('#view').boundingBox();
  const answer = page.waitForResponse((response) => response.url().includes('api/read'));
  await page.mouse.click(box.x + Math.round(box.width / 2), box.y + Math.round(0.6 * box.height));
  const { readings } = await (await answer).json();
  const told = readings[0].illuminance_lx;
  const text = await page.locator('.pin-list .pin-value').innerText();
  const [kept, error] = text.replace(/\u202f/g, '').match(/[\d.]+/g).map(Number);
  require(Math.abs(kept - told) <= error, `"${text}" in the panel, ${told} lx by the server`);
  return `"${text}", ${told.toFixed(2)} lx by the server`;
}

async function link(browser, url) {
  const page = await browser.open(url);
  await complete(page);
  await page.evaluate(() => {
    const { position, target, fovDeg } = window.isoluxViewer.view();
    window.isoluxViewer.goTo({ position: [position[0] + 0.7, position[1] + 0.4, position[2]], target, fovDeg }, false);
  });
  await set(page, { mode: 'illuminance', logarithmic: true, luminaires: 'off', limits: { low: 1, high: 300 }, dimming: [0.5, 1] });
  const picture = await settled(page);
  await page.waitForFunction(() => location.hash.includes('mode=illuminance') && location.hash.includes('lim=1,300'));
  const [address, before] = [page.url(), await shown(page)];
  const again = await browser.open(address);
  const difference = meanDifference(picture, await settled(again));
  const after = await shown(again);
  await Promise.all([page, again].map(leave));
  require(JSON.stringify(after.settings) === JSON.stringify(before.settings), `settings ${JSON.stringify(after.settings)} after ${JSON.stringify(before.settings)}`);
  const off = Math.max(...before.numbers.map((n, k) => Math.abs(n - after.numbers[k])));
  require(off <= LINK_ROUNDING_M, `the view is ${off} m off`);
  atMost('mean CIE94', difference, MOST_ALIKE);
  return `view within ${(1000 * off).toFixed(2)} mm, settings the same, mean CIE94 ${difference.toFixed(3)}`;
}

const shown = (page) => page.evaluate(() => {
  const { position, target, fovDeg } = window.isoluxViewer.view();
  const { mode, logarithmic, luminaires, limits, dimming, autoExposure, tone } = window.isoluxViewer.settings;
  return { numbers: [...position, ...target, fovDeg], settings: { mode, logarithmic, luminaires, limits, dimming, autoExposure, tone } };
});
