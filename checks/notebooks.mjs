// The walk-throughs in pages that nbconvert has made of notebooks, in headless Chromium: they draw, read, and ask nobody for anything.
// Usage: node notebooks.mjs PAGE.html...
import { mkdir } from 'node:fs/promises';
import { basename, dirname, join, resolve } from 'node:path';
import { pathToFileURL } from 'node:url';
import { chromium } from 'playwright-core';
import { FLAGS, NOT_OURS, PATIENCE_MS, findBrowser } from './walk/browser.mjs';
import { require, runAll } from './walk/cases.mjs';

const pages = process.argv.slice(2);
const executablePath = findBrowser();
if (!pages.length || !executablePath) {
  console.error(pages.length ? 'there is no Chromium; install it or name it in CHROMIUM' : 'usage: node notebooks.mjs PAGE.html...');
  process.exit(pages.length ? 3 : 2);
}
const browser = await chromium.launch({ executablePath, args: FLAGS });

/** Looks at one page; keeps a picture of it beside it. */
async function look(file) {
  const page = await browser.newPage({ viewport: { width: 1000, height: 800 } });
  page.setDefaultTimeout(PATIENCE_MS);
  const complaints = [];
  page.on('pageerror', (error) => complaints.push(String(error)));
  page.on('console', (message) => {
    const own = message.location().url.startsWith('about:srcdoc');
    if (own && message.type() === 'error' && !NOT_OURS.test(message.text())) complaints.push(message.text());
  });
  // What the pages of nbconvert load from elsewhere is no part of this.
  await page.route(/^https?:/, (route) => route.abort());
  await page.goto(pathToFileURL(resolve(file)).href, { waitUntil: 'domcontentloaded' });
  const frames = page.frames().filter((frame) => frame !== page.mainFrame());
  for (const frame of frames) {
    await (await frame.frameElement()).scrollIntoViewIfNeeded();
    await frame.waitForFunction(() => window.isoluxViewer?.glanceAt(innerWidth / 2, innerHeight / 2), undefined, { polling: 100 });
  }
  const failed = await page.locator('[data-mime-type="application/vnd.jupyter.stderr"]').allTextContents();
  const folder = join(dirname(file), 'pictures');
  await mkdir(folder, { recursive: true });
  await page.screenshot({ path: join(folder, `${basename(file, '.html')}.png`), fullPage: true });
  await page.close();
  require(!complaints.length, complaints.join('; '));
  require(!failed.length, `a warning or an error stands in it: ${failed.join('; ').slice(0, 200)}`);
  return `${frames.length} walk-through${frames.length === 1 ? '' : 's'}`;
}

const failed = await runAll(pages.map((file) => [basename(file), () => look(file)]));
await browser.close();
process.exit(failed ? 1 : 0);
