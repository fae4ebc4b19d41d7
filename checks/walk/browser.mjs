// Chromium, and pages in it that keep what they complain of and whom they ask.
import { existsSync } from 'node:fs';
import { chromium } from 'playwright-core';

const BROWSERS = ['/usr/bin/chromium', '/usr/bin/chromium-browser', '/usr/bin/google-chrome'];
// Software rendering is the same on every machine.
export const FLAGS = ['--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--ignore-gpu-blocklist', '--force-color-profile=srgb'];
// What Chromium says of its own graphics.
export const NOT_OURS = /GL Driver Message|software WebGL|GPU stall|extension not supported/;
/** Until something of a page has come about; a machine without a graphics card draws in software. */
export const PATIENCE_MS = 60_000;
const POLLING_MS = 50;

export function findBrowser() {
  return process.env.CHROMIUM ?? BROWSERS.find(existsSync);
}

/** A browser whose pages write into `heard`. */
export async function launch(executablePath) {
  const browser = await chromium.launch({ executablePath, args: FLAGS });
  const heard = { pages: 0, complaints: [], requests: [] };
  return { heard, open: (url, how) => open(browser, heard, url, how ?? {}), close: () => browser.close() };
}

/** Opens a page as large as said, with nothing but the canvas in it (`bare`), or as people see it; `before` is told of the page while it is empty, `isOpen` holds once it is there. */
async function open(browser, heard, url, { width = 640, height = 360, bare = true, phone = false, before = () => {}, isOpen = () => window.isoluxViewer }) {
  const touch = phone ? { isMobile: true, hasTouch: true } : {};
  const context = await browser.newContext({ viewport: { width, height }, deviceScaleFactor: 1, ...touch });
  context.setDefaultTimeout(PATIENCE_MS);
  const page = await context.newPage();
  listen(page, heard);
  before(page);
  await page.goto(url);
  await page.waitForFunction(isOpen);
  if (bare) await page.evaluate(strip);
  return page;
}

function listen(page, heard) {
  heard.pages += 1;
  page.on('console', (message) => {
    if (!['error', 'warning'].includes(message.type()) || NOT_OURS.test(message.text()) || page.isCutOff || isLate(message)) return;
    heard.complaints.push(`${message.text()} (${message.location().url})`);
  });
  page.on('pageerror', (error) => heard.complaints.push(String(error)));
  page.on('request', (request) => heard.requests.push(request.url()));
}

/** Chromium tells of an answer that pages await: the mesh has changed since they heard of it, and they ask again. */
function isLate(message) {
  return message.text().includes('status of 409') && /api\/(light|mesh)/.test(message.location().url);
}

/** Leaves the canvas alone in the window. */
function strip() {
  const put = (id, styles) => Object.entries(styles).forEach(([name, value]) => document.getElementById(id).style.setProperty(name, value, 'important'));
  put('ui', { display: 'none' });
  for (const id of ['view', 'overlay']) put(id, { inset: '0', width: '100%', height: '100%' });
}

/** Resolves once a page has drawn light; the time of that since it was asked for, ms. */
export async function lit(page) {
  await page.evaluate(() => void window.isoluxViewer.ready.then(() => (window.isLit ??= performance.now())));
  return (await until(page, () => window.isLit)).jsonValue();
}

/** Resolves once a page has drawn light, made its shaders and sorted its triangles. */
export async function complete(page) {
  await lit(page);
  await until(page, () => window.isoluxViewer.glanceAt(innerWidth / 2, innerHeight / 2));
}

/** Waits until something holds in a page, also in one that draws nothing. */
export const until = (page, holds, argument) => page.waitForFunction(holds, argument, { polling: POLLING_MS });

export const vertices = (page) => page.evaluate(() => window.isoluxViewer.stats().vertices);

/** Closes a page and all that it keeps. */
export const leave = (page) => page.context().close();

export const set = (page, change) => page.evaluate((change) => window.isoluxViewer.set(change), change);
