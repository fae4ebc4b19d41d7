// Facts of the map and of the picture.

import { h, replace } from './dom';
import { bytes, count } from './format';
import type { Ui } from './ui';

const EVERY_MS = 1000;

export interface About {
  root: HTMLElement;
  shown(is: boolean): void;
}

export function about(ui: Ui): About {
  const { viewer, source } = ui;
  const { scene } = viewer;
  const picture = h('dl', { class: 'facts wide-facts' });
  const refresh = (): void => {
    const s = viewer.stats();
    replace(picture, ...facts([
      ['Triangles', count(s.triangles)], ['Vertices', count(s.vertices)], ['Memory', bytes(s.bytes)], ['Pictures a second', s.fps.toFixed(0)],
    ]));
  };
  let timer: number | undefined;
  const root = h('div', {},
    h('section', { class: 'block' }, h('h3', {}, 'Map'),
      h('dl', { class: 'facts wide-facts' }, ...facts([['Scene', scene.name], ['File', scene.file], ...scene.about]))),
    viewer.otherScene ? h('section', { class: 'block' }, h('h3', {}, 'Compared with'),
      h('dl', { class: 'facts wide-facts' }, ...facts([['File', viewer.otherScene.file], ...viewer.otherScene.about]))) : null,
    h('section', { class: 'block' }, h('h3', {}, 'Picture'), picture, quality(ui)),
    h('section', { class: 'block prose' }, h('h3', {}, 'Readings'), ...readings(source.hello.readings === 'probe').map((text) => h('p', {}, text))),
    h('p', { class: 'faint' }, `isolux ${source.hello.version}`));
  return {
    root, shown: (is) => {
      window.clearInterval(timer);
      if (!is) return;
      refresh();
      timer = window.setInterval(refresh, EVERY_MS);
    },
  };
}

function facts(rows: [string, string][]): HTMLElement[] {
  return rows.filter(([, text]) => text !== '').flatMap(([name, text]) => [h('dt', {}, name), h('dd', {}, text)]);
}

function readings(isProbe: boolean): string[] {
  return [
    'Every value has a standard error. The true value is within two standard errors of it in 95 of 100 cases.',
    'While the pointer moves, values are interpolated between vertices of the map, as the picture is.',
    isProbe
      ? 'Once it rests, the value is what isolux probe says: direct light is evaluated afresh at the place, indirect light is read from the map.'
      : 'There is no program behind this page, so all values are interpolated. To have direct light afresh, open the map with isolux view.',
    'The line of a reading says which of the two it is.',
  ];
}

function quality({ viewer }: Ui): HTMLElement {
  const list = h('select', { 'aria-label': 'Quality', onchange: () => {
    const chosen = (['auto', 'low', 'high'] as const).find((q) => q === list.value);
    if (chosen) viewer.set({ quality: chosen });
  } }, ...([['auto', 'Automatic'], ['low', 'Fast'], ['high', 'Fine']] as const)
    .map(([value, text]) => h('option', { value, selected: viewer.settings.quality === value }, text)));
  return h('label', { class: 'row spread' }, h('span', {}, 'Quality'), list);
}
