// The section tool: two clicks, then illuminance along the line between.

import type { Vec3 } from '../wire';
import { words } from './actions';
import { figuresOf, type Figure, type Figures, type Sample } from './figures';
import { fileName, sectionCsv } from './csv';
import { h, replace } from './dom';
import { intervalText, significant } from './format';
import { icon } from './icons';
import { download } from './notices';
import { project } from './project';
import { sectionChart, type Chart } from './section-chart';
import { whoseName, type Ui } from './ui';

export interface SectionTool {
  root: HTMLElement;
  /** Marks the first point over the view. */
  mark: HTMLElement;
  click(x: number, y: number): void;
  /** Back to the first click. */
  reset(): void;
}

export function sectionTool(ui: Ui): SectionTool {
  // Where it begins, in the scene: the view may move before the second click.
  let from: Vec3 | null = null;
  let asked: AbortController | null = null;
  let chart: Chart | null = null;
  const body = h('div', { class: 'results' });
  const mark = h('div', { class: 'section-mark', hidden: true, 'aria-hidden': 'true' });
  const steps = h('p', { class: 'empty', role: 'status' });
  const start = h('button', { type: 'button', class: 'primary', onclick: () => ui.setTool('section') }, icon('ruler'), 'Draw a section');
  const tell = (): void => {
    const drawing = ui.tool === 'section';
    start.hidden = drawing;
    steps.textContent = !drawing ? 'Illuminance along a straight line over what is seen.'
      : from ? 'Click where it ends.' : 'Click where the section begins.';
    place();
  };
  const onCanvas = (at: Vec3): [number, number] | null =>
    project(at, ui.viewer.view(), ui.viewer.scene.up, ui.canvas.clientWidth, ui.canvas.clientHeight);
  const place = (): void => {
    const at = from && onCanvas(from);
    mark.hidden = !at;
    if (at) mark.style.transform = `translate(${at[0]}px, ${at[1]}px)`;
  };
  ui.viewer.on('view', place);
  let dimming = ui.viewer.settings.dimming.join();
  ui.viewer.on('settings', () => {
    const now = ui.viewer.settings.dimming.join();
    if (now !== dimming && chart) {
      clear();
      replace(body, h('p', { class: 'faint', role: 'status' }, 'The light has changed: draw the section again.'));
    }
    dimming = now;
  });
  const clear = (): void => {
    asked?.abort();
    chart?.close();
    chart = null;
    replace(body);
    ui.viewer.clearSection();
  };
  const measure = async (a: [number, number], b: [number, number]): Promise<void> => {
    clear();
    const mine = new AbortController();
    asked = mine;
    replace(body, h('p', { class: 'faint', role: 'status' }, 'Measuring …'));
    try {
      const samples = await ui.viewer.section(a, b, mine.signal);
      if (mine.signal.aborted) return;
      chart = present(ui, body, samples, clear);
    } catch (error) {
      if (!mine.signal.aborted) replace(body, h('p', { class: 'problem' }, `The section could not be measured: ${words(error)}`));
    }
  };
  /** Of large maps the server alone knows where a section begins. */
  const begin = (at: Vec3 | null): void => {
    if (ui.tool !== 'section') return;
    from = at;
    if (!from) ui.say('There is no surface here. Begin the section on one.');
    tell();
  };
  ui.onTool(() => {
    from = null;
    if (ui.tool === 'section') ui.panel.open('section');
    tell();
  });
  tell();
  return {
    root: h('section', { class: 'block' }, steps, start, body), mark,
    reset: () => {
      from = null;
      tell();
    },
    click: (x, y) => {
      const first = from && onCanvas(from);
      if (first) {
        void measure(first, [x, y]);
        ui.setTool('pin');
        return;
      }
      const glance = ui.viewer.glanceAt(x, y, 'own');
      if (glance?.position) begin(glance.position);
      else void ui.viewer.readAt(x, y, new AbortController().signal).then((read) => begin(read?.position ?? null), () => begin(null));
    },
  };
}

/** Chart and figures; null where nothing was hit. */
function present(ui: Ui, body: HTMLElement, samples: Sample[], clear: () => void): Chart | null {
  const figures = figuresOf(samples);
  if (!figures) {
    replace(body, h('p', { class: 'problem' }, 'There is no light known along this line. Begin and end it on surfaces of the map.'));
    return null;
  }
  const plot = h('div', { class: 'chart' });
  const name = fileName([ui.viewer.scene.name, 'section'], 'csv');
  replace(body, plot, table(figures),
    figures.unknown > 0 ? h('p', { class: 'faint' }, `${figures.unknown} of ${samples.length} places have no value.`) : null,
    h('p', { class: 'faint' }, `Band and intervals: ± 2 standard errors.${ui.viewer.settings.compare === 'off' ? '' : ` Of ${whoseName(ui.viewer, 'own')}.`}`),
    h('div', { class: 'row' },
      h('button', { type: 'button', onclick: () => download(name, sectionCsv(samples)) }, icon('download'), 'CSV'),
      h('button', { type: 'button', onclick: clear, class: 'end' }, 'Remove')));
  return sectionChart(plot, samples);
}

function table(f: Figures): HTMLElement {
  const row = (name: string, of: Figure, unit: string, digits: number): HTMLElement =>
    h('tr', {}, h('th', { scope: 'row' }, name), h('td', { class: 'figure' }, `${significant(of.value, digits)}${unit}`),
      h('td', { class: 'faint' }, intervalText(of.low, of.high)));
  return h('table', { class: 'figures' }, h('tbody', {},
    h('tr', {}, h('th', { scope: 'row' }, 'Length'), h('td', { class: 'figure' }, `${f.length.toFixed(2)} m`), h('td')),
    row('Em', f.mean, ' lx', 3), row('Emin', f.least, ' lx', 3), row('Emax', f.greatest, ' lx', 3), row('U0', f.uniformity, '', 2)));
}
