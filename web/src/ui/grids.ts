// Calculation grids: figures with intervals, and the table of points.

import type { GridTable } from '../wire';
import { words } from './actions';
import { fileName, gridCsv } from './csv';
import { h, replace } from './dom';
import { intervalText, significant, valueAndError } from './format';
import { icon } from './icons';
import { download } from './notices';
import { gridNormal, lookAt } from './project';
import { undimmedNote, type Ui } from './ui';

/** Rows of a table that are put on the page at once. */
const MOST_ROWS = 2000;

export interface Grids {
  root: HTMLElement;
  /** Asks for the grids, if that has not been done since the light changed. */
  load(): void;
}

export function grids(ui: Ui): Grids {
  const body = h('div', { class: 'results' });
  let fresh = false;
  const load = async (): Promise<void> => {
    if (fresh) return;
    fresh = true;
    replace(body, h('p', { class: 'faint', role: 'status' }, 'Reading the grids …'));
    try {
      const tables = await ui.viewer.grids();
      const note = undimmedNote(ui);
      replace(body, note && h('p', { class: 'faint' }, note), ...(tables.length > 0 ? tables.map((t, i) => table(ui, t, i === 0)) : [nothing()]));
    } catch (error) {
      fresh = false;
      replace(body, h('p', { class: 'problem' }, `The grids could not be read: ${words(error)}`),
        h('button', { type: 'button', onclick: () => void load() }, 'Try again'));
    }
  };
  ui.viewer.on('light', () => {
    fresh = false;
    if (ui.panel.current() === 'grids') void load();
  });
  return { root: h('section', { class: 'block' }, body), load: () => void load() };
}

function nothing(): HTMLElement {
  return h('div', { class: 'empty' }, icon('grid'), h('p', {}, 'This scene has no calculation grids.'),
    h('p', { class: 'faint' }, 'A [[grid]] in scene.toml, or isolux grid --height 0.75, makes them.'));
}

function table(ui: Ui, grid: GridTable, open: boolean): HTMLElement {
  const points = h('div', { class: 'grid-points' });
  const list = h('details', { ontoggle: () => {
    if (list.open && points.childElementCount === 0) points.append(pointsOf(ui, grid));
  } }, h('summary', {}, `${grid.points.length} points`), points);
  return h('details', { class: 'grid-table', open },
    h('summary', {}, h('b', {}, grid.name), h('span', { class: 'faint' }, `${grid.columns} × ${grid.rows}`)),
    figures(grid), maintained(grid), list,
    h('div', { class: 'row' },
      h('button', { type: 'button', onclick: () => go(ui, grid, centre(grid)) }, icon('frame'), 'Go there'),
      h('button', { type: 'button', onclick: () => download(fileName([ui.viewer.scene.name, grid.name], 'csv'), gridCsv(grid)) }, icon('download'), 'CSV')));
}

function maintained({ maintenance_factor: factor }: GridTable): HTMLElement | null {
  return factor === 1 ? null : h('p', { class: 'faint' }, `Maintained values: ${significant(factor, 3)} of the initial ones, which the picture shows.`);
}

function figures(grid: GridTable): HTMLElement {
  if (grid.figures.length === 0) return h('p', { class: 'faint' }, 'Nothing is known at its points yet.');
  const head = h('thead', { class: 'faint' }, h('tr', {}, h('th'), h('td', {}, 'value'), h('td', {}, '95 % interval')));
  return h('table', { class: 'figures' }, head, h('tbody', {}, ...grid.figures.map((f) => h('tr', {},
    h('th', { scope: 'row' }, f.name), h('td', { class: 'figure' }, significant(f.value, f.unit ? 3 : 2) + (f.unit ? ` ${f.unit}` : '')),
    h('td', { class: 'faint' }, intervalText(f.low, f.high))))));
}

function pointsOf(ui: Ui, grid: GridTable): HTMLElement {
  const head = ['x, m', 'y, m', 'z, m', 'E, lx', '±'].map((text) => h('th', { scope: 'col' }, text));
  const rows = grid.points.slice(0, MOST_ROWS).map((at, i) => {
    const { value, error } = valueAndError(grid.illuminance_lx[i], grid.standard_error_lx[i]);
    const cells = [...at.map((v) => v.toFixed(2)), value ?? 'not known', error ?? '?'];
    const row = h('tr', { tabindex: i === 0 ? 0 : -1, onclick: () => go(ui, grid, at) }, ...cells.map((text) => h('td', {}, text)));
    return row;
  });
  const made = h('table', { class: 'points', 'aria-label': `Points of ${grid.name}; Enter goes there` }, h('thead', {}, h('tr', {}, ...head)), h('tbody', {}, ...rows));
  made.addEventListener('keydown', (event) => rowKey(event, (i) => go(ui, grid, grid.points[i]!), rows));
  const cut = grid.points.length > MOST_ROWS ? h('p', { class: 'faint' }, `The first ${MOST_ROWS}; the file has all.`) : null;
  return h('div', {}, h('div', { class: 'scroll' }, made), cut);
}

/** Arrow keys go from row to row, Enter to the place. */
function rowKey(event: KeyboardEvent, act: (row: number) => void, rows: HTMLElement[]): void {
  const at = rows.indexOf(event.target as HTMLElement);
  if (at < 0) return;
  const to = { ArrowDown: at + 1, ArrowUp: at - 1, Home: 0, End: rows.length - 1, PageDown: at + 10, PageUp: at - 10 }[event.key];
  if (event.key === 'Enter') act(at);
  else if (to === undefined) return;
  event.preventDefault();
  event.stopPropagation();
  if (to === undefined) return;
  rows[at]!.tabIndex = -1;
  const next = rows[Math.max(0, Math.min(rows.length - 1, to))]!;
  next.tabIndex = 0;
  next.focus();
}

function centre(grid: GridTable): GridTable['corner'] {
  return grid.corner.map((v, i) => v + (grid.u[i]! + grid.v[i]!) / 2) as GridTable['corner'];
}

function go({ viewer }: Ui, grid: GridTable, at: GridTable['corner']): void {
  const { bounds, origin } = viewer.scene;
  const whole = { min: plus(bounds.min, origin), max: plus(bounds.max, origin) };
  if (!viewer.settings.grids) viewer.set({ grids: true });
  viewer.goTo(lookAt(at, gridNormal(grid.u, grid.v), viewer.view(), whole), true);
}

function plus(a: GridTable['corner'], b: GridTable['corner']): GridTable['corner'] {
  return [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
}
