// Error against time, both logarithmic, with the target and the way predicted to it.

import uPlot from 'uplot';
import type { ErrorHistory, LiveState } from '../wire';
import { axes, inked, sized, type Ink } from './chart';
import { h, perFrame } from './dom';
import { isOver } from './predict';

/** More points than that are thinned out: a chart is a few hundred pixels wide. */
const MOST_POINTS = 600;

export interface LiveChart {
  root: HTMLElement;
  history(past: ErrorHistory): void;
  state(state: LiveState): void;
}

export function liveChart(): LiveChart {
  const root = h('div', { class: 'chart', role: 'img', 'aria-label': 'Error against time, with the target and the prediction' });
  let points: [number, number][] = [];
  let newest: LiveState | null = null;
  const chart = sized(root, 200, (width, height) => {
    const ink = inked();
    return new uPlot(options(width, height, ink, () => newest), columns(points), root);
  });
  const redraw = perFrame(() => chart.plot()?.setData(columns(points)));
  return {
    root,
    history: (past) => {
      points = past.filter(isDrawn);
      redraw();
    },
    state: (state) => {
      newest = state;
      const point: [number, number] = [state.elapsed_s, state.error ?? 0];
      const last = points.at(-1);
      if (isDrawn(point) && (!last || point[0] > last[0])) points.push(point);
      if (points.length > MOST_POINTS) points = thinned(points);
      redraw();
    },
  };
}

/** Logarithms need numbers above zero. */
function isDrawn([at, error]: [number, number]): boolean {
  return at > 0 && error > 0 && Number.isFinite(at) && Number.isFinite(error);
}

/** Every other point of the older half. */
export function thinned(points: [number, number][]): [number, number][] {
  const half = points.length / 2;
  return points.filter((_, i) => i >= half || i % 2 === 0);
}

function columns(points: [number, number][]): uPlot.AlignedData {
  return [points.map(([at]) => at), points.map(([, error]) => 100 * error)];
}

function options(width: number, height: number, ink: Ink, state: () => LiveState | null): uPlot.Options {
  return {
    width, height, legend: { show: false }, cursor: { show: false },
    scales: {
      x: { time: false, distr: 3, range: (_, least, most) => xRange(least, most, state()) },
      y: { distr: 3, range: (_, least, most) => yRange(least, most, state()) },
    },
    axes: logAxes(ink), series: [{}, { stroke: ink.data, width: 2, points: { show: false } }],
    hooks: { draw: [(plot) => drawPrediction(plot, ink, state())] },
  };
}

/** Logarithmic axes are labelled at 1, 2 and 5 only, unless they are short. */
function logAxes(ink: Ink): uPlot.Axis[] {
  const isRound = (v: number): boolean => [1, 2, 5].includes(Number((v / 10 ** Math.floor(Math.log10(v) + 1e-9)).toPrecision(3)));
  return axes(ink, 's', '%').map((axis, i) => ({
    ...axis, filter: (plot: uPlot, splits: number[]) => {
      const [least, most] = [plot.scales[i === 0 ? 'x' : 'y']!.min ?? 1, plot.scales[i === 0 ? 'x' : 'y']!.max ?? 10];
      const [wide, narrow] = [most / least > 300, most / least < 8];
      return splits.map((v) => (v > 0 && ((narrow && Number(v.toPrecision(2)) === v) || (wide ? Number.isInteger(Number(Math.log10(v).toFixed(6))) : isRound(v))) ? v : null));
    },
  }));
}

function xRange(least: number | null, most: number | null, state: LiveState | null): [number, number] {
  const [low, high] = [least ?? 0.5, most ?? 10];
  const predicted = state && !isOver(state.phase) ? state.prediction : null;
  const end = Math.max(high, Math.min(predicted?.latest_s ?? 0, 30 * high), 2 * low);
  return [low * 0.9, end * 1.15];
}

function yRange(least: number | null, most: number | null, state: LiveState | null): [number, number] {
  const target = state?.target ? 100 * state.target : (least ?? 1);
  const [low, high] = [Math.min(least ?? target, target), Math.max(most ?? 10 * target, target)];
  return [low / 1.5, high * 1.3];
}

function drawPrediction(plot: uPlot, ink: Ink, state: LiveState | null): void {
  if (!state?.target) return;
  const { ctx, bbox } = plot;
  const x = (at: number): number => plot.valToPos(at, 'x', true);
  const y = (error: number): number => plot.valToPos(100 * error, 'y', true);
  ctx.save();
  ctx.beginPath();
  ctx.rect(bbox.left, bbox.top, bbox.width, bbox.height);
  ctx.clip();
  ctx.lineWidth = 1.5 * devicePixelRatio;
  line(ctx, ink.target, [], [[bbox.left, y(state.target)], [bbox.left + bbox.width, y(state.target)]]);
  const p = state.prediction;
  if (p && state.error && !isOver(state.phase) && p.latest_s > state.elapsed_s && state.elapsed_s > 0) {
    const from: [number, number] = [x(state.elapsed_s), y(state.error)];
    const to = y(state.target);
    const at = (s: number): number => x(Math.max(s, state.elapsed_s));
    ctx.fillStyle = ink.band;
    path(ctx, [from, [at(p.earliest_s), to], [at(p.latest_s), to]]);
    ctx.fill();
    line(ctx, ink.data, [5 * devicePixelRatio, 4 * devicePixelRatio], [from, [at(p.finish_s), to]]);
  }
  ctx.restore();
}

function path(ctx: CanvasRenderingContext2D, points: [number, number][]): void {
  ctx.beginPath();
  points.forEach(([px, py], i) => (i === 0 ? ctx.moveTo(px, py) : ctx.lineTo(px, py)));
}

function line(ctx: CanvasRenderingContext2D, stroke: string, dash: number[], points: [number, number][]): void {
  ctx.setLineDash(dash);
  ctx.strokeStyle = stroke;
  path(ctx, points);
  ctx.stroke();
}
