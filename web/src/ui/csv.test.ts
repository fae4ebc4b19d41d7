import { describe, expect, it } from 'vitest';
import type { Reading } from '../wire';
import { fileName, gridCsv, pinLine, pinsCsv, ptsLine, sectionCsv } from './csv';
import { figuresOf } from './figures';

const reading = (lx: number | null, error: number | null): Reading => ({
  position: [1.23456, 2, -0.5], normal: [0, 0, 1], shape: 'desk', material: 'wood', diffuse_reflectance: 0.5, illuminance_lx: lx,
  standard_error_lx: error, direct_lx: null, indirect_lx: null, rgb_lx: null, luminance_cd_m2: null, found: 'probe',
});

describe('lines of files', () => {
  it('have a fixed order and empty cells', () => {
    expect(pinLine(reading(512.345678, 6.2111))).toBe('1.2346,2,-0.5,0,0,1,512.346,6.21');
    expect(pinLine(reading(null, Infinity))).toBe('1.2346,2,-0.5,0,0,1,,');
    expect(ptsLine(reading(1, 1))).toBe('1.2346 2 -0.5  0 0 1');
    expect(pinsCsv([reading(1, 2)])).toBe('x,y,z,nx,ny,nz,illuminance_lx,standard_error_lx\n1.2346,2,-0.5,0,0,1,1,2\n');
    expect(pinsCsv([reading(1, 2)], [null])).toBe(pinsCsv([reading(1, 2)]));
    expect(pinsCsv([reading(1, 2)], ['B: "spots", off'])).toContain(',1,2,"B: ""spots"", off"\n');
    expect(sectionCsv([{ at: 0.25, reading: reading(1, 2) }]).split('\n')[1]).toBe('0.25,1.2346,2,-0.5,0,0,1,1,2');
  });
  it('go through grids row after row', () => {
    const lines = gridCsv({
      name: 'desk', corner: [0, 0, 0], u: [2, 0, 0], v: [0, 2, 0], maintenance_factor: 1, columns: 2, rows: 2,
      points: [[0.5, 0.5, 0], [1.5, 0.5, 0], [0.5, 1.5, 0], [1.5, 1.5, 0]],
      illuminance_lx: [1, 2, null, 4], standard_error_lx: [0.1, 0.1, null, 0.1], figures: [],
    }).split('\n');
    expect(lines[3]).toBe('0,1,0.5,1.5,0,,');
    expect(lines).toHaveLength(6);
  });
  it('names files without signs that systems dislike', () => {
    expect(fileName(['Büro / hall', 'illuminance'], 'png')).toBe('büro-hall-illuminance.png');
    expect(fileName(['../..'], 'csv')).toBe('isolux.csv');
  });
});

describe('figures of a section', () => {
  it('weigh by length', () => {
    const f = figuresOf([0, 1, 3].map((at, i) => ({ at, reading: reading([100, 200, 200][i]!, 5) })));
    expect(f?.length).toBe(3);
    expect(f?.mean.value).toBeCloseTo((150 + 400) / 3);
    expect(f?.mean.high).toBeCloseTo((150 + 400) / 3 + 10);
    expect(f?.least).toEqual({ value: 100, low: 90, high: 110 });
    expect(f?.uniformity.value).toBeCloseTo(300 / 550);
  });
  it('leave out what is not known', () => {
    expect(figuresOf([])).toBeNull();
    expect(figuresOf([{ at: 0, reading: reading(null, null) }])).toBeNull();
    expect(figuresOf([{ at: 0, reading: reading(null, null) }, { at: 1, reading: reading(7, Infinity) }])?.unknown).toBe(1);
  });
});
