// Walks through maps as people do, in headless Chromium: what the page shows and tells, beside what the command says.
// Usage: node walk.mjs ISOLUX [WORD]; with a word only the groups of cases with it in their name are run
import { mkdtemp, rm } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import { join, resolve } from 'node:path';
import { findBrowser, launch } from './walk/browser.mjs';
import { runAll } from './walk/cases.mjs';
import { commandIn } from './walk/command.mjs';
import { fileCases } from './walk/file.mjs';
import { graphicsCases } from './walk/graphics.mjs';
import { heardCases } from './walk/heard.mjs';
import { liveCases } from './walk/live.mjs';
import { readingCases } from './walk/readings.mjs';
import { makeRoom } from './walk/room.mjs';
import { screenCases } from './walk/screen.mjs';
import { seenCases } from './walk/seen.mjs';
import { sideCases } from './walk/sides.mjs';
import { stepCases } from './walk/steps.mjs';

const GROUPS = { seen: seenCases, readings: readingCases, screen: screenCases, sides: sideCases, steps: stepCases, graphics: graphicsCases, file: fileCases, live: liveCases };

const [binary, word = ''] = process.argv.slice(2);
if (!binary) {
  console.error('usage: node walk.mjs ISOLUX [WORD]');
  process.exit(2);
}
const chromium = findBrowser();
if (!chromium) {
  console.error('there is no Chromium; install it or name it in CHROMIUM');
  process.exit(3);
}

/** All cases about one room; the count of those that fail. */
async function walk(folder, command, browser) {
  await makeRoom(command, folder);
  const home = { folder, command, browser, at: (name) => join(folder, name) };
  let failed = 0;
  for (const [name, cases] of Object.entries(GROUPS)) {
    if (name.includes(word)) failed += await cases(home, runAll);
  }
  return failed + (await runAll(heardCases(browser.heard)));
}

const folder = await mkdtemp(join(tmpdir(), 'isolux-walk-'));
const command = commandIn(resolve(binary), folder);
const browser = await launch(chromium);
try {
  const failed = await walk(folder, command, browser);
  if (failed > 0) {
    console.error(`${failed} cases of the walk-through fail`);
    process.exitCode = 1;
  }
} finally {
  await browser.close();
  await command.end();
  await rm(folder, { recursive: true });
}
