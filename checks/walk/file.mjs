// The walk-through in one file, from a disk.
import { pathToFileURL } from 'node:url';
import { complete, leave, set, until, vertices } from './browser.mjs';
import { atMost, require } from './cases.mjs';
import { meanDifference, settled } from './pictures.mjs';
import { fixedExposure } from './seen.mjs';

// Both show the same map with shadows about as fine.
const MOST_ALIKE = 1;
const FINER = '2s';

export async function fileCases({ command, browser, at }, runAll) {
  await command.run('export', 'alone/map.glb', '-o', 'room.html', '--finer', FINER);
  const url = pathToFileURL(at('room.html')).href;
  return runAll([
    ['a file asks nobody', () => alone(browser, url)],
    ['a file tells what its readings are', () => interpolated(browser, url)],
    ['a file looks as what is served', () => alike(command, browser, url)],
  ]);
}

async function alone(browser, url) {
  const before = browser.heard.requests.length;
  const page = await browser.open(url);
  await complete(page);
  await leave(page);
  const asked = browser.heard.requests.slice(before).filter((request) => request !== url && !/^(data|blob):/.test(request));
  require(asked.length === 0, `${asked.length} requests, the first: ${asked[0]}`);
  return 'no request but for the file itself';
}

async function interpolated(browser, url) {
  const page = await browser.open(url, { width: 1280, height: 800, bare: false });
  await complete(page);
  const reading = await page.evaluate(() => window.isoluxViewer.readAt(300, 300, new AbortController().signal));
  require(reading?.found === 'vertices' && reading.illuminance_lx > 0, `the reading is ${JSON.stringify(reading)}`);
  await page.locator('#view').hover({ position: { x: 300, y: 300 } });
  const card = page.getByRole('status').filter({ hasText: 'interpolated between vertices' });
  await card.waitFor();
  await leave(page);
  return `${reading.illuminance_lx.toFixed(1)} lx, "interpolated between vertices"`;
}

async function alike(command, browser, url) {
  const [bare, served] = await Promise.all(['map.glb', 'alone/map.glb'].map((map) => command.serve('view', map)));
  const pages = [];
  for (const address of [url, bare.url, served.url]) pages.push(await browser.open(address));
  const [file, grouped, page] = pages;
  const ev100 = await fixedExposure(file);
  for (const each of pages) await set(each, { luminaires: 'off', autoExposure: false, ev100 });
  const [picture, first] = [await settled(file), await settled(grouped)];
  await until(page, (few) => window.isoluxViewer.stats().vertices > few, await vertices(grouped));
  const difference = meanDifference(await settled(page), picture);
  await Promise.all(pages.map(leave));
  await Promise.all([bare, served].map(({ stop }) => stop()));
  return `${atMost('mean CIE94', difference, MOST_ALIKE)}, from the interpolated map ${meanDifference(first, picture).toFixed(3)}`;
}
