import { writeFileSync } from 'node:fs';
import { PNG } from 'pngjs';
import { launch, set, complete } from './walk/browser.mjs';
import { commandIn } from './walk/command.mjs';
import { settled, meanDifference, read } from './walk/pictures.mjs';
const command = commandIn('/work/main/target/release/isolux', '/tmp/t');
const b = await launch('/usr/bin/chromium');
const s = await command.serve('view', 'alone/map.glb');
await command.run('render', 'map.glb', '--camera', 'mirror', '--size', '640x360', '-o', 'mirror.png');
await command.run('render', 'map.glb', '--camera', 'mirror', '--size', '640x360', '-o', 'mirror-i.png', '--interpolated');
const p = await b.open(s.url);
await complete(p);
for (const quality of ['auto', 'high']) {
  await set(p, { luminaires: 'off', quality });
  await p.evaluate(() => window.isoluxViewer.goToCamera(1, false));
  const pic = await settled(p);
  writeFileSync(`/tmp/t/page-mirror-${quality}.png`, PNG.sync.write(pic));
  console.log(quality, meanDifference(read('/tmp/t/mirror.png'), pic), meanDifference(read('/tmp/t/mirror-i.png'), pic), JSON.stringify(await p.evaluate(() => [window.isoluxViewer.exposure(), window.isoluxViewer.stats()])));
}
console.log(b.heard.complaints);
await b.close(); await command.end();
