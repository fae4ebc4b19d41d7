// A graphics card that is lost, and comes back.
import { complete, leave, set, until } from './browser.mjs';
import { atMost, require } from './cases.mjs';
import { meanDifference, settled } from './pictures.mjs';

// The same picture of the same data.
const MOST_ALIKE = 0.05;
const DESK = { width: 640, height: 400, bare: false };

export async function graphicsCases({ command, browser }, runAll) {
  const served = await command.serve('view', 'map.glb');
  const page = await browser.open(served.url, DESK);
  await complete(page);
  await set(page, { luminaires: 'solids', mesh: true });
  const run = { page, before: await settled(page) };
  const failed = await runAll([
    ['a lost graphics card is told of', () => lost(run)],
    ['the picture comes back with it', () => back(run)],
    ['light is dimmed and read afterwards', () => after(run)],
    ['one that stays lost leaves a way to load the page again', () => again(run)],
  ]);
  await leave(page);
  await served.stop();
  return failed;
}

/** Takes the graphics card away from the page, or gives it back. */
const card = (page, what) => page.evaluate((what) => {
  window.lostCard ??= document.getElementById('view').getContext('webgl2').getExtension('WEBGL_lose_context');
  window.lostCard[what]();
}, what);

const note = (page) => page.getByRole('alert').filter({ hasText: 'graphics card has been lost' });

async function lost({ page }) {
  await card(page, 'loseContext');
  await note(page).waitFor();
  const failure = await page.evaluate(() => window.isoluxViewer.snapshot().then(() => 'a picture', (error) => error.message));
  require(failure.includes('lost'), `a picture taken meanwhile gives ${failure}`);
  // Nothing that is pressed meanwhile breaks the page.
  await set(page, { mode: 'illuminance' });
  await set(page, { mode: 'seen' });
  return (await note(page).innerText()).split('\n')[0];
}

async function back({ page, before }) {
  await card(page, 'restoreContext');
  await note(page).waitFor({ state: 'hidden' });
  return atMost('mean CIE94 from the picture before', meanDifference(before, await settled(page)), MOST_ALIKE);
}

async function after({ page, before }) {
  const glance = () => page.evaluate(() => window.isoluxViewer.glanceAt(300, 250)?.illuminance_lx);
  const full = await glance();
  await set(page, { dimming: [0.5, 0.5], autoExposure: false, ev100: await page.evaluate(() => window.isoluxViewer.exposure().ev100) });
  const change = meanDifference(before, await settled(page));
  const half = await glance();
  require(Math.abs(half / full - 0.5) < 0.02, `${half} lx in place of half of ${full}`);
  require(change > 2, `the picture of half the light differs by ${change.toFixed(2)} only`);
  await set(page, { dimming: [1, 1] });
  return `${full.toFixed(0)} lx, then ${half.toFixed(0)}; mean CIE94 ${change.toFixed(1)}`;
}

async function again({ page }) {
  await card(page, 'loseContext');
  await note(page).getByRole('button', { name: 'Load the page again' }).click();
  await until(page, () => !window.lostCard && window.isoluxViewer);
  await complete(page);
  return 'loaded again, with light';
}
