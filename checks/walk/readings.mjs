// What is read under the pointer, beside what `probe` says.
import { writeFile } from 'node:fs/promises';
import { complete, leave, set } from './browser.mjs';
import { require } from './cases.mjs';
import { EVENING } from './room.mjs';

const POINTS = [[60, 300], [150, 120], [300, 230], [420, 320], [600, 60]];
const FIGURES = ['illuminance_lx', 'standard_error_lx', 'direct_lx', 'indirect_lx', 'rgb_lx'];

export async function readingCases(home, runAll) {
  const served = await home.command.serve('view', 'map.glb');
  const page = await home.browser.open(served.url);
  await complete(page);
  const failed = await runAll([
    ['readings are those of probe', () => alike(home, page, 'map.glb')],
    ['dimmed readings are those of mix and probe', async () => {
      await set(page, { dimming: EVENING });
      return alike(home, page, 'evening.glb');
    }],
  ]);
  await leave(page);
  await served.stop();
  return failed;
}

/** All digits of readings of a page, and of `probe` at the places and normals that they tell. */
async function alike({ command, at }, page, map) {
  const readings = await page.evaluate(readAll, POINTS);
  const lines = readings.map(({ position, normal }) => [...position, ...normal].join(' '));
  await writeFile(at('picked.pts'), `${lines.join('\n')}\n`);
  const { points } = JSON.parse(await command.run('probe', map, '--points', 'picked.pts', '--json'));
  require(points.length === POINTS.length, `probe tells of ${points.length} points`);
  readings.forEach((reading, k) => requireAlike(reading, points[k], lines[k]));
  const known = readings.filter(({ illuminance_lx: lux }) => lux !== null);
  require(known.length === POINTS.length, `only ${known.length} of ${POINTS.length} readings have a value`);
  return `${known.map(({ illuminance_lx: lux }) => lux.toFixed(1)).join(', ')} lx, to all digits`;
}

function readAll(points) {
  const { signal } = new AbortController();
  return points.reduce(async (before, [x, y]) => [...(await before), await window.isoluxViewer.readAt(x, y, signal)], Promise.resolve([]));
}

function requireAlike(reading, due, place) {
  require(reading.found === 'probe', `the reading at ${place} says that it is of ${reading.found}`);
  for (const name of FIGURES) {
    const [told, probed] = [reading[name], due[name]].map((value) => JSON.stringify(value));
    require(told === probed, `${name} at ${place} is ${told}, by probe ${probed}`);
  }
}
