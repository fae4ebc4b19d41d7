// Numbers on isolux lines: where lines cross the small picture, some of the places, none near another.

import type { Sample } from './exposure';

export interface Label {
  x: number;
  y: number;
  text: string;
}

const MOST = 14;
/** Space of a label, CSS pixels. */
const APART_X = 90;
const APART_Y = 46;
const EDGE = 24;

interface Crossing {
  x: number;
  y: number;
  tick: number;
}

/** Labels on a picture of so many CSS pixels. */
export function labelsOf(sample: Sample, ticks: readonly number[], width: number, height: number): Label[] {
  const found = ticks.flatMap((tick) => crossings(sample, tick, width, height));
  const perTick = new Map<number, number>();
  const chosen: Crossing[] = [];
  // Places in an order that has nothing to do with the picture, so that labels spread over it.
  for (const crossing of found.sort((a, b) => order(a) - order(b))) {
    if (chosen.length >= MOST) break;
    const count = perTick.get(crossing.tick) ?? 0;
    const isFree = chosen.every(({ x, y }) => Math.abs(x - crossing.x) > APART_X || Math.abs(y - crossing.y) > APART_Y);
    if (!isFree || count >= Math.max(2, Math.ceil(MOST / ticks.length))) continue;
    perTick.set(crossing.tick, count + 1);
    chosen.push(crossing);
  }
  return chosen.map(({ x, y, tick }) => ({ x, y, text: numberText(tick) }));
}

const order = ({ x, y }: Crossing): number => ((Math.sin(Math.round(x) * 12.9898 + Math.round(y) * 78.233) * 43758.5453) % 1 + 1) % 1;

/** Where neighbours in a row or column lie on both sides of a tick, and the slope is that of a surface, not of an edge. */
function crossings({ width: columns, height: rows, values }: Sample, tick: number, width: number, height: number): Crossing[] {
  const found: Crossing[] = [];
  const lux = (i: number, j: number): number => values[4 * (j * columns + i) + 3]!;
  for (let j = 1; j < rows - 1; j++) {
    for (let i = 1; i < columns - 2; i++) {
      const [before, a, b, after] = [lux(i - 1, j), lux(i, j), lux(i + 1, j), lux(i + 2, j)];
      if (!(before >= 0 && a >= 0 && b >= 0 && after >= 0) || (a < tick) === (b < tick)) continue;
      const isSmooth = Math.abs(b - a) < 3 * (Math.abs(a - before) + Math.abs(after - b)) + 1e-6 * tick;
      if (!isSmooth) continue;
      const x = ((i + 0.5 + (tick - a) / (b - a)) / columns) * width;
      const y = (1 - (j + 0.5) / rows) * height;
      if (x > EDGE && x < width - EDGE && y > EDGE && y < height - EDGE) found.push({ x, y, tick });
    }
  }
  return found;
}

export const numberText = (value: number): string => (value !== 0 && (Math.abs(value) >= 1e5 || Math.abs(value) < 0.01) ? value.toExponential(1) : String(Number(value.toPrecision(3))));
