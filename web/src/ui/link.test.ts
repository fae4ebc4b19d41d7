import { describe, expect, it } from 'vitest';
import { decodeLink, encodeLink, type LinkState } from './link';

const full: LinkState = {
  view: { position: [1.5, -2.25, 1.6], target: [3, 4, 0.8], fovDeg: 55 },
  navigation: 'walk',
  settings: {
    mode: 'illuminance', tone: 'ward', autoExposure: false, ev100: 7.3, colourMap: 'viridis', limits: { low: 0, high: 750 },
    logarithmic: true, contours: true, mesh: false, grids: true, luminaires: 'solids', dimming: [1, 0.5], otherDimming: [0, 1.25],
    compare: 'dimmings', split: 0.25,
  },
  pins: [{ position: [1, 2, 0], normal: [0, 0, 1], illuminance_lx: 512.3, standard_error_lx: 6.2, whose: 'own' },
    { position: [-1, 2, 0], normal: [0, -1, 0], illuminance_lx: null, standard_error_lx: Infinity, whose: 'map' }],
};

describe('a link', () => {
  it('comes back as it was', () => {
    const back = decodeLink(encodeLink(full));
    expect(back?.bad).toEqual([]);
    expect(back?.state).toEqual({ ...full, pins: [full.pins[0], { ...full.pins[1], standard_error_lx: null }] });
  });
  it('is short and has a version', () => {
    expect(encodeLink({ settings: {}, pins: [] })).toBe('#v1');
    expect(encodeLink(full).length).toBeLessThan(300);
  });
  it('tells all flags', () => {
    expect(decodeLink('#v1&mode=seen')?.state.settings.contours).toBe(false);
    expect(decodeLink('#v1')?.state.settings.contours).toBeUndefined();
  });
});

describe('a bad link', () => {
  it('is none where the version is another', () => {
    for (const hash of ['', '#', '#v2&mode=seen', '#section', '%%%']) expect(decodeLink(hash)).toBeNull();
  });
  it('loses only the parts that make no sense', () => {
    const back = decodeLink('#v1&mode=colour&ev=7&at=1,2&dim=5&lim=3,1&cmp=maps,2&on=x&__proto__=1&lum=points&pin=1&tone=%&=');
    expect(back?.state.settings.ev100).toBe(7);
    expect(back?.state.settings.luminaires).toBe('points');
    expect(back?.state.view).toBeUndefined();
    expect(back?.bad).toEqual(['mode', 'at', 'dim', 'lim', 'cmp', 'on', '__proto__', 'pin', 'tone', '']);
  });
  it('has no pins of light that there is not', () => {
    const pin = (end: string): string => `#v1&pin=1,2,0,0,0,1,5,1${end}`;
    expect(['', ',', ',m', ',d'].map((end) => decodeLink(pin(end))?.state.pins[0]?.whose)).toEqual(['own', 'own', 'map', 'dimming']);
    for (const end of [',x', ',m,', ',own']) expect(decodeLink(pin(end))?.bad).toEqual(['pin']);
  });
  it('takes no numbers that are none', () => {
    for (const text of ['NaN', 'Infinity', '1e999', '0x10', '', ' 1', '1'.repeat(400)]) {
      expect(decodeLink(`#v1&ev=${text}`)?.bad).toEqual(['ev']);
    }
  });
});
