// What lies over the view, in a picture that is saved: pins, and where two sides meet.

import { quantity } from './format';
import { seen } from './pin-renew';
import type { Pin, Pins } from './pins';
import { sideNames, whoseMark, type Ui } from './ui';

const FONT = '600 12px system-ui, -apple-system, "Segoe UI", Roboto, sans-serif';
/** Half the height of a label, and the space at its end, CSS pixels. */
const [RADIUS, END] = [13, 9];

/** Draws all pins that are in sight, and the names of two sides. */
export function pinPicture(ui: Ui, pins: Pins): (context: CanvasRenderingContext2D) => void {
  return (context) => {
    context.font = FONT;
    context.textBaseline = 'middle';
    drawSides(ui, context);
    for (const pin of pins.all()) drawPin(ui, context, pin, pins.chosen() === pin);
  };
}

function drawSides({ viewer, canvas }: Ui, context: CanvasRenderingContext2D): void {
  const { compare, mode, split } = viewer.settings;
  if (compare === 'off' || mode === 'difference') return;
  const at = split * canvas.clientWidth;
  context.fillStyle = '#fff';
  context.fillRect(at - 1, 0, 2, canvas.clientHeight);
  sideNames(viewer, compare).forEach((name, k) => {
    const width = context.measureText(name).width + 2 * END;
    const from = k === 0 ? at - 16 - width : at + 16;
    context.beginPath();
    context.roundRect(from, 12, width, 26, 6);
    fill(context, 'rgb(255 255 255 / 0.93)', '#d5dbe2');
    context.fillStyle = '#17212c';
    context.fillText(name, from + END, 25);
  });
}

function drawPin(ui: Ui, context: CanvasRenderingContext2D, { number, reading, whose }: Pin, isChosen: boolean): void {
  const found = reading.position && seen(ui, reading.position);
  if (!found) return;
  const [x, y] = found.at;
  const text = [quantity(reading.illuminance_lx, 'lx'), whoseMark(ui.viewer, whose)].filter(Boolean).join('  ');
  const from = x + RADIUS + 6;
  context.globalAlpha = found.hidden ? 0.45 : 1;
  context.beginPath();
  context.roundRect(x - RADIUS, y - RADIUS, from + context.measureText(text).width + END - x + RADIUS, 2 * RADIUS, RADIUS);
  fill(context, 'rgb(255 255 255 / 0.93)', isChosen ? '#f0a92c' : '#7f8a97');
  context.beginPath();
  context.arc(x, y, RADIUS - 3, 0, 2 * Math.PI);
  fill(context, '#f0a92c', '#7f8a97');
  context.fillStyle = '#17212c';
  context.textAlign = 'center';
  context.fillText(String(number), x, y);
  context.textAlign = 'left';
  context.fillText(text, from, y);
  context.globalAlpha = 1;
}

function fill(context: CanvasRenderingContext2D, colour: string, line: string): void {
  context.fillStyle = colour;
  context.fill();
  context.lineWidth = 1;
  context.strokeStyle = line;
  context.stroke();
}
