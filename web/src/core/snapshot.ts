// A picture of what is shown, with the legend in false colour.

import type { Engine } from './engine';
import type { Parts } from './parts';
import { positionOf } from './axis';
import { numberText } from './labels';

const WIDTH = 84;
const MARGIN = 16;

export async function snapshot(parts: Parts, engine: Engine, draw?: (context: CanvasRenderingContext2D) => void): Promise<Blob> {
  const { canvas, marks } = parts;
  await engine.settle();
  engine.drawNow();
  const picture = document.createElement('canvas');
  [picture.width, picture.height] = [canvas.width, canvas.height];
  const context = picture.getContext('2d')!;
  // The canvas keeps its pixels only until the browser shows them: they are copied at once.
  context.drawImage(canvas, 0, 0);
  if (marks.canvas.width > 0) context.drawImage(marks.canvas, 0, 0, picture.width, picture.height);
  if (draw) drawOver(canvas, context, draw);
  if (parts.settings.mode !== 'seen') drawLegend(parts, context, parts.renderer.getPixelRatio());
  return new Promise((resolve, reject) => {
    picture.toBlob((blob) => (blob ? resolve(blob) : reject(new Error('The picture could not be written.'))), 'image/png');
  });
}

/** In CSS pixels of the canvas. */
function drawOver(canvas: HTMLCanvasElement, context: CanvasRenderingContext2D, draw: (context: CanvasRenderingContext2D) => void): void {
  context.save();
  context.scale(canvas.width / canvas.clientWidth, canvas.height / canvas.clientHeight);
  draw(context);
  context.restore();
}

function drawLegend({ shown, settings }: Parts, context: CanvasRenderingContext2D, ratio: number): void {
  const { scale } = shown;
  const legend = shown.legend(settings);
  if (!legend) return;
  const codes = shown.codes(settings);
  const height = Math.min(320, context.canvas.height / ratio - 4 * MARGIN);
  context.save();
  context.scale(ratio, ratio);
  context.fillStyle = 'rgba(20, 22, 26, .85)';
  context.fillRect(MARGIN, MARGIN, WIDTH, height + 44);
  for (let i = 0; i < 256; i++) {
    context.fillStyle = `rgb(${codes[3 * i]}, ${codes[3 * i + 1]}, ${codes[3 * i + 2]})`;
    context.fillRect(MARGIN + 8, MARGIN + 32 + height * (1 - (i + 1) / 256), 18, height / 256 + 1);
  }
  context.fillStyle = '#fff';
  context.font = '12px system-ui, sans-serif';
  context.textBaseline = 'middle';
  context.fillText(legend.unit, MARGIN + 8, MARGIN + 15);
  for (const tick of legend.ticks) {
    context.fillText(numberText(tick), MARGIN + 32, MARGIN + 32 + height * (1 - positionOf(tick, scale, scale.logarithmic)));
  }
  context.restore();
}
