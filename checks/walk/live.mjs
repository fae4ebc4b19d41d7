// A run that is watched, paused and aimed anew.
import { readFile } from 'node:fs/promises';
import { PNG } from 'pngjs';
import { leave, lit, PATIENCE_MS, set, until, vertices } from './browser.mjs';
import { atMost, require } from './cases.mjs';
import { gateBefore } from './gate.mjs';
import { meanDifference } from './pictures.mjs';

// Particles take some seconds for this in many small increments: long enough to join late, to lose a connection and to pause.
const SOLVE = ['solve', 'scene.toml', '--method', 'forward'];
const ACCURACY = '1.4%';
// Nobody waits for this one.
const FAR_ACCURACY = '0.5%';
const DESK = { width: 1280, height: 800, bare: false };
const EV = 6;
// Light that is spread evenly, as it is at first, looks quite different from that of lamps. Measured: 24.
const LEAST_CHANGE = 5;
// Two pages draw the same light alike.
const MOST_ALIKE = 0.1;

export async function liveCases(home, runAll) {
  await home.command.run(...SOLVE, '-o', 'plain.glb', '--accuracy', ACCURACY, '--progress', 'none');
  return (await watched(home, runAll)) + (await steered(home, runAll));
}

async function watched(home, runAll) {
  const { browser, command } = home;
  const served = await command.serve(...SOLVE, '-o', 'watched.glb', '--accuracy', ACCURACY, '--live');
  await control(served.url, { action: 'pause' });
  const first = await visit(browser, served.url);
  const start = await picture(first);
  const run = { home, browser, served, first, start, late: null, gate: null };
  const failed = await runAll([
    ['light comes while it is computed', () => comes(run)],
    ['a connection that is cut comes back', () => comesBack(run)],
    ['all pages show the newest light', () => newest(run)],
    ['a run that is watched has the bytes of one that is not', () => ends(run, 'watched.glb')],
  ]);
  await run.gate?.cut();
  await served.stop();
  return failed;
}

async function steered(home, runAll) {
  const { browser, command } = home;
  const served = await command.serve(...SOLVE, '-o', 'steered.glb', '--accuracy', FAR_ACCURACY, '--live');
  const run = { home, served, first: await visit(browser, served.url), late: null };
  const failed = await runAll([
    ['a run is paused and goes on', () => pauses(run)],
    ['a run is aimed anew', () => aims(run)],
    ['a run that is aimed anew has the bytes of one that was so at once', () => ends(run, 'steered.glb')],
  ]);
  await served.stop();
  return failed;
}

/** A page of a run that keeps what light it has got, with its exposure fixed. */
async function visit(browser, url) {
  const got = { mesh: 0, version: 0 };
  const page = await browser.open(url, { ...DESK, before: (page) => page.on('response', (response) => keep(response, got)) });
  page.got = got;
  await lit(page);
  await set(page, { autoExposure: false, ev100: EV, luminaires: 'off' });
  await until(page, (ev) => Math.abs(window.isoluxViewer.exposure().ev100 - ev) < 1e-9, EV);
  return page;
}

async function keep(response, got) {
  if (!response.url().includes('api/light') || !response.ok()) return;
  const bytes = await response.body().catch(() => null);
  if (!bytes) return;
  const { mesh, version } = JSON.parse(bytes.subarray(16, 16 + bytes.readUInt32LE(8)).toString());
  Object.assign(got, { mesh, version });
}

async function picture(page) {
  const base64 = await page.evaluate(async () => {
    const bytes = new Uint8Array(await (await window.isoluxViewer.snapshot()).arrayBuffer());
    return btoa(Array.from(bytes, (byte) => String.fromCharCode(byte)).join(''));
  });
  return PNG.sync.read(Buffer.from(base64, 'base64'));
}

/** A wish, as the page sends it: before there is a page. */
async function control(url, what) {
  const { status } = await fetch(new URL('api/control', url), { method: 'POST', headers: { 'content-type': 'application/json' }, body: JSON.stringify(what) });
  require(status === 204, `the server answers ${status} to ${JSON.stringify(what)}`);
}

const phase = (page) => page.locator('.phase');
const isDone = (page) => phase(page).filter({ hasText: /^Done$/ }).waitFor();

/** Until now the run was held before its first light. */
async function comes({ first, start }) {
  await button(first, 'Go on').click();
  let change = 0;
  const changes = async () => (change = meanDifference(start, await picture(first))) >= LEAST_CHANGE;
  await soon(changes, `the picture changes by a mean CIE94 of ${change.toFixed(2)} only`);
  return `mean CIE94 ${change.toFixed(2)} from the first light, "${await phase(first).innerText()}"`;
}

/** A second page joins, loses its connection for the rest of the run, and finds it again. The run is held until that is lost. */
async function comesBack(run) {
  const { browser, served, first } = run;
  await pauseUnlessDone(first);
  run.gate = await gateBefore(served.url);
  run.late = await visit(browser, run.gate.url);
  const joined = { ...run.late.got };
  const lost = run.late.getByText('Connection lost, trying again.');
  run.late.isCutOff = true;
  await run.gate.cut();
  await lost.waitFor();
  const was = await phase(first).innerText();
  if (was.startsWith('Paused')) await button(first, 'Go on').click();
  await isDone(first);
  await run.gate.open();
  await isDone(run.late);
  await lost.waitFor({ state: 'hidden' });
  run.late.isCutOff = false;
  return `joined at light ${joined.mesh}.${joined.version}, cut while "${was}", done at ${run.late.got.mesh}.${run.late.got.version}`;
}

/** On a fast machine the run may be over. */
async function pauseUnlessDone(page) {
  const isOver = isDone(page);
  await Promise.race([button(page, 'Pause').click().catch(() => isOver), isOver]);
  await phase(page).filter({ hasText: /^(Paused|Done)/ }).waitFor();
  isOver.catch(() => {});
}

/** Finer shadows may still come once a run is done, so that pictures count which were taken of one light. */
async function newest({ served, first, late, start }) {
  const taken = { light: '', pictures: [] };
  const ofOneLight = async () => {
    taken.light = await lightOf(served.url, [first, late]);
    taken.pictures = [await picture(first), await picture(late)];
    return taken.light !== null && taken.light === (await lightOf(served.url, [first, late]));
  };
  await soon(ofOneLight, 'the newest light does not come');
  const [one, other] = taken.pictures;
  const change = meanDifference(start, one);
  require(change >= LEAST_CHANGE, `the picture changed by a mean CIE94 of ${change.toFixed(2)} only`);
  return `${atMost('mean CIE94 between two pages', meanDifference(one, other), MOST_ALIKE)} of light ${taken.light}, ${change.toFixed(2)} from the first light`;
}

/** The light that pages have if it is that of the server, and all have drawn it; else null. */
async function lightOf(url, pages) {
  const { mesh, light } = await stateOf(url);
  const have = pages.every(({ got }) => got.mesh === mesh && got.version === light);
  const counts = await Promise.all(pages.map(vertices));
  return have && counts.every((count) => count === counts[0]) ? `${mesh}.${light}` : null;
}

/** The newest state of a run, as the server tells whoever joins. */
async function stateOf(url) {
  const leaving = new AbortController();
  const { body } = await fetch(new URL('api/events', url), { signal: leaving.signal });
  let text = '';
  for await (const part of body.pipeThrough(new TextDecoderStream())) {
    text += part;
    const state = /event: ?state\ndata: ?(.*)\n/.exec(text) ?? /data: ?(\{.*\})\n\n/.exec(text);
    if (!state) continue;
    leaving.abort();
    return JSON.parse(state[1]);
  }
  throw new Error('the server tells no state');
}

async function soon(holds, otherwise) {
  const end = Date.now() + PATIENCE_MS;
  while (!(await holds())) {
    if (Date.now() > end) throw new Error(otherwise);
    await new Promise((resolve) => setTimeout(resolve, 50));
  }
}

/** The run ends once nobody looks any more. */
async function ends({ home, served, first, late }, file) {
  await Promise.all([first, late].filter(Boolean).map(leave));
  const code = await served.ended;
  require(code === 0, `exit code ${code}`);
  const [plain, other] = await Promise.all(['plain.glb', file].map((name) => readFile(home.at(name))));
  require(plain.equals(other), `${file} differs from the map of a run without viewers`);
  return `${other.length} bytes the same, exit code 0`;
}

const button = (page, name) => page.getByRole('button', { name, exact: true });

async function increments(page) {
  const text = await page.locator('dt', { hasText: /^Increments$/ }).locator('xpath=following-sibling::dd[1]').innerText();
  return Number(text);
}

async function pauses({ first }) {
  await button(first, 'Pause').click();
  await phase(first).filter({ hasText: /^Paused/ }).waitFor();
  const held = await increments(first);
  await button(first, 'Go on').click();
  await phase(first).filter({ hasText: /^(?!Paused)/ }).waitFor();
  await soon(async () => (await increments(first)) > held, 'no further increment comes');
  return `paused after ${held} increments, then ${await increments(first)}`;
}

async function aims({ first }) {
  const text = `of ${ACCURACY}`.replace('%', '');
  await first.getByRole('textbox', { name: 'Error to reach' }).fill(ACCURACY);
  await button(first, 'Set target').click();
  const sure = first.getByRole('group', { name: 'Begin the run anew?' });
  const question = await sure.innerText();
  require(/is lost/.test(question), `before a run is begun anew it says "${question}"`);
  await button(first, 'Keep this run').click();
  await sure.waitFor({ state: 'hidden' });
  const before = await increments(first);
  await soon(async () => (await increments(first)) > before, 'the run does not go on');
  await button(first, 'Set target').click();
  await button(first, 'Begin anew').click();
  await isDone(first);
  const error = (await first.locator('.error-now').innerText()).replace(/\s+/g, ' ');
  require(error.includes(text), `the panel tells ${error}`);
  return `"${question.split('\n')[0]}", done, "${error}"`;
}
