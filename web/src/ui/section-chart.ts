// Illuminance along a section, with a band of two standard errors.

import uPlot from 'uplot';
import { axes, inked, sized, type Chart } from './chart';
import type { Sample } from './figures';
import { isKnown, withError } from './format';
import { h } from './dom';

export type { Chart };

export function sectionChart(into: HTMLElement, samples: Sample[]): Chart {
  const known = samples.map((s) => (isKnown(s.reading.illuminance_lx) ? s.reading.illuminance_lx : null));
  const wide = samples.map((s) => (isKnown(s.reading.standard_error_lx) ? 2 * s.reading.standard_error_lx : 0));
  const data: uPlot.AlignedData = [
    samples.map((s) => s.at), known,
    known.map((v, i) => (v === null ? null : Math.max(0, v - wide[i]!))), known.map((v, i) => (v === null ? null : v + wide[i]!)),
  ];
  const text = h('p', { class: 'chart-reading figure', 'aria-live': 'off' }, '\u00a0');
  into.append(text);
  const read = (plot: uPlot): void => {
    const sample = samples[plot.cursor.idx ?? -1];
    text.textContent = sample
      ? `${sample.at.toFixed(2)} m: ${withError(sample.reading.illuminance_lx, sample.reading.standard_error_lx, 'lx')}` : '\u00a0';
  };
  return sized(into, 190, (width, height) => {
    const ink = inked();
    return new uPlot({
      width, height, legend: { show: false }, cursor: { y: false, drag: { x: false, y: false }, points: { size: 7 } },
      scales: { x: { time: false }, y: { range: (_, __, most) => [0, most > 0 ? most * 1.08 : 1] } },
      axes: axes(ink, 'm', 'lx'),
      series: [{}, { stroke: ink.data, width: 2, spanGaps: false, points: { show: false } },
        { stroke: ink.none, points: { show: false } }, { stroke: ink.none, points: { show: false } }],
      bands: [{ series: [3, 2], fill: ink.band }], hooks: { setCursor: [read] },
    }, data, into);
  });
}
