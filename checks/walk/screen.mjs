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
    ['picture, scale, reading and sheet lie side by side on a phone', () => apart(pages.phone)],
    ['Tab comes to the bar', () => tabs(pages.desk)],
    ['digits change what is shown', () => digits(pages.desk)],
    ['a click keeps a reading', () => pins(pages.desk)],
    ['the box of a dimmer refuses what is none', () => refuses(pages.desk)],
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

/** Boxes of parts that are on the page. */
const boxes = (page, parts) => page.evaluate((parts) => Object.fromEntries(Object.entries(parts).map(([name, selector]) => {
  const { left, top, right, bottom } = document.querySelector(selector).getBoundingClientRect();
  return [name, { left, top, right, bottom }];
})), parts);

/** With a section in its sheet: the view above the sheet, and in it a scale and a reading that leave most of it free. */
async function apart(page) {
  await set(page, { mode: 'illuminance' });
  await named(page, 'Section').tap();
  await named(page, 'Draw a section').tap();
  await page.touchscreen.tap(60, 280);
  await page.touchscreen.tap(330, 300);
  await page.locator('.panel .u-over').waitFor();
  const free = [];
  for (const y of [120, 340]) {
    await page.touchscreen.tap(200, y);
    await page.locator('.hover').filter({ hasText: 'lx' }).waitFor();
    const all = await boxes(page, { view: '#view', sheet: '.panel', scale: '.legend', reading: '.hover', bar: '.tabs' });
    requireApart(all);
    const { view, scale, reading } = all;
    free.push(1 - (scale.bottom - scale.top + reading.bottom - reading.top) / (view.bottom - view.top));
    require(reading.bottom < y + 48 || reading.top > y, `the reading from ${reading.top} to ${reading.bottom} hides its place at ${y}`);
  }
  const least = Math.min(...free);
  require(least > 0.5, `only ${(100 * least).toFixed(0)} % of the view are free`);
  await page.getByRole('button', { name: 'Close the panel' }).tap();
  await set(page, { mode: 'seen' });
  return `${(100 * least).toFixed(0)} % of the view are free beside scale and reading`;
}

function requireApart({ view, sheet, scale, reading, bar }) {
  const text = (box) => `${box.top.toFixed(0)} to ${box.bottom.toFixed(0)}`;
  const order = (name, upper, other, lower) => require(upper.bottom <= lower.top + 0.5, `${name} ${text(upper)} lies over ${other} ${text(lower)}`);
  order('the view', view, 'the sheet', sheet);
  order('the sheet', sheet, 'the tabs', bar);
  order('the reading', reading, 'the scale', scale);
  for (const [name, part] of [['the scale', scale], ['the reading', reading]]) {
    require(part.top >= view.top && part.bottom <= view.bottom, `${name} ${text(part)} leaves the view ${text(view)}`);
  }
}

/** What is no percentage is told to be none, and the light stays as it is. */
async function refuses(page) {
  await named(page, 'Light').click();
  const box = page.getByRole('textbox', { name: 'spots, per cent' });
  const write = async (text) => {
    await box.fill(text);
    await box.press('Enter');
  };
  const factor = () => page.evaluate(() => window.isoluxViewer.settings.dimming[0]);
  await write('60');
  await page.waitForFunction(() => window.isoluxViewer.settings.dimming[0] === 0.6);
  for (const text of ['abc', '-5', '200']) {
    await write(text);
    const told = page.getByRole('alert').filter({ hasText: 'It stays at 60 %.' });
    await told.waitFor();
    require((await box.getAttribute('aria-invalid')) === 'true', `"${text}" is not marked as wrong`);
    require((await factor()) === 0.6, `"${text}" dims to ${await factor()}`);
    await box.press('Escape');
    require((await box.inputValue()) === '60 %' && (await told.count()) === 0, 'Escape does not bring the value back');
  }
  await write('off');
  await page.waitForFunction(() => window.isoluxViewer.settings.dimming[0] === 0);
  await set(page, { dimming: [1, 1] });
  return '60 % stays where abc, -5 and 200 are written';
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
