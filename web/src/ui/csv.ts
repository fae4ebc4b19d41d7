// Lines for files and spreadsheets: full precision, plain numbers, empty where nothing is known.

import type { GridTable, Reading, Vec3 } from '../wire';
import { isKnown } from './format';

export const PIN_COLUMNS = 'x,y,z,nx,ny,nz,illuminance_lx,standard_error_lx';
export const SECTION_COLUMNS = `at_m,${PIN_COLUMNS}`;
export const GRID_COLUMNS = 'column,row,x,y,z,illuminance_lx,standard_error_lx';

function cell(value: number | null | undefined, digits: number): string {
  return isKnown(value) ? String(Number(value.toPrecision(digits))) : '';
}

/** Metres to a tenth of a millimetre. */
function metres(at: Vec3 | null): string[] {
  return at ? at.map((v) => String(Number(v.toFixed(4)))) : ['', '', ''];
}

function normal(of: Vec3 | null): string[] {
  return of ? of.map((v) => String(Number(v.toFixed(5)))) : ['', '', ''];
}

/** One reading as CSV. */
export function pinLine(r: Reading): string {
  return [...metres(r.position), ...normal(r.normal), cell(r.illuminance_lx, 6), cell(r.standard_error_lx, 3)].join(',');
}

/** One reading as a line of a file of points: place and normal. */
export function ptsLine(r: Reading): string {
  return `${metres(r.position).join(' ')}  ${normal(r.normal).join(' ')}`;
}

/** All readings, and of what they are where that is to be said. */
export function pinsCsv(readings: Reading[], of: (string | null)[] = []): string {
  if (of.every((name) => name === null)) return [PIN_COLUMNS, ...readings.map(pinLine), ''].join('\n');
  return [`${PIN_COLUMNS},of`, ...readings.map((r, i) => `${pinLine(r)},"${(of[i] ?? '').replaceAll('"', '""')}"`), ''].join('\n');
}

export function sectionCsv(samples: { at: number; reading: Reading }[]): string {
  return [SECTION_COLUMNS, ...samples.map((s) => `${cell(s.at, 6)},${pinLine(s.reading)}`), ''].join('\n');
}

export function gridCsv(grid: GridTable): string {
  const lines = grid.points.map((at, i) => [
    i % grid.columns, Math.floor(i / grid.columns), ...metres(at),
    cell(grid.illuminance_lx[i], 6), cell(grid.standard_error_lx[i], 3),
  ].join(','));
  return [GRID_COLUMNS, ...lines, ''].join('\n');
}

/** A name of a file made of names of things. */
export function fileName(parts: string[], ending: string): string {
  const name = parts.map((p) => p.trim().toLowerCase().replace(/[^\p{L}\p{N}]+/gu, '-').replace(/^-|-$/g, ''));
  return `${name.filter(Boolean).join('-') || 'isolux'}.${ending}`;
}
