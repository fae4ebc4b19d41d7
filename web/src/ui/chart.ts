// What charts have in common: colours of the page, size, axes.

import type uPlot from 'uplot';
import { tick } from './format';
import { colour, onTheme } from './theme';

export interface Chart {
  close(): void;
}

export interface Ink {
  text: string;
  line: string;
  data: string;
  band: string;
  target: string;
  none: string;
}

export function inked(): Ink {
  return {
    text: colour('text-2'), line: colour('chart-line'), data: colour('data'), band: colour('data-band'), target: colour('good'), none: 'transparent',
  };
}

export function axes(ink: Ink, x: string, y: string): uPlot.Axis[] {
  const common: uPlot.Axis = {
    stroke: ink.text, font: '11px system-ui, sans-serif', labelFont: '11px system-ui, sans-serif',
    grid: { stroke: ink.line, width: 1 }, ticks: { stroke: ink.line, width: 1, size: 4 }, values: (_, at) => at.map((v) => (v === null ? '' : tick(v))),
  };
  return [
    { ...common, label: x, labelSize: 14, labelGap: 0, size: 24, gap: 3, space: 45 },
    { ...common, label: y, labelSize: 14, labelGap: 0, size: 42, gap: 3, space: 26 },
  ];
}

/** Makes a chart as wide as its place, anew when that or the colours change. */
export function sized(into: HTMLElement, height: number, make: (width: number, height: number) => uPlot): Chart & { plot(): uPlot | null } {
  let plot: uPlot | null = null;
  let width = 0;
  const again = (): void => {
    plot?.destroy();
    plot = width > 40 ? make(width, height) : null;
  };
  const observer = new ResizeObserver(() => {
    const now = Math.floor(into.clientWidth);
    if (now === width) return;
    width = now;
    if (plot && width > 40) plot.setSize({ width, height });
    else again();
  });
  observer.observe(into);
  let open = true;
  onTheme(() => {
    if (open) again();
  });
  return {
    plot: () => plot,
    close: () => {
      open = false;
      observer.disconnect();
      plot?.destroy();
    },
  };
}
