// Marks over the picture: pin, section, grid points, numbers of isolux lines. They are drawn on a canvas of their own.

import { Vector3, type PerspectiveCamera } from 'three';
import type { Label } from './labels';

export interface GridMark {
  at: Vector3;
  text: string;
  colour: string;
}

/** Whether something stands between the eye and a place. */
export type Hidden = (at: Vector3) => boolean;

const FONT = '600 11px system-ui, sans-serif';
const PIN_M = 0.25;
/** With more points in sight than this, they have no numbers. */
const MOST_NUMBERS = 400;
const NEAREST_NUMBERS_PX = 26;
/** More points than this are not asked whether something hides them. */
const MOST_HIDDEN = 1500;

export class Marks {
  readonly canvas = document.createElement('canvas');
  readonly #context = this.canvas.getContext('2d')!;
  pin: { at: Vector3; normal: Vector3 } | null = null;
  section: (Vector3 | null)[] = [];
  grids: GridMark[] = [];
  labels: Label[] = [];
  #isClear = true;

  constructor(overlay: HTMLElement) {
    this.canvas.style.cssText = 'position:absolute;inset:0;width:100%;height:100%;pointer-events:none';
    this.canvas.setAttribute('aria-hidden', 'true');
    overlay.append(this.canvas);
  }

  /** Draws all marks as the camera sees them, on a picture of so many CSS pixels. */
  draw(camera: PerspectiveCamera, width: number, height: number, hidden: Hidden): void {
    const isEmpty = !this.pin && this.section.length === 0 && this.grids.length === 0 && this.labels.length === 0;
    if (isEmpty && this.#isClear) return;
    const ratio = globalThis.devicePixelRatio || 1;
    this.canvas.width = Math.round(width * ratio);
    this.canvas.height = Math.round(height * ratio);
    this.#context.scale(ratio, ratio);
    const project = projector(camera, width, height);
    this.#drawGrids(project, hidden);
    this.#drawSection(project, hidden);
    this.#drawPin(project);
    this.labels.forEach(({ x, y, text }) => this.#text(text, x, y));
    this.#isClear = isEmpty;
  }

  #drawGrids(project: Project, hidden: Hidden): void {
    const seen = this.grids.map((mark) => ({ mark, at: project(mark.at) })).filter(({ at, mark }) => at && (this.grids.length > MOST_HIDDEN || !hidden(mark.at)));
    const context = this.#context;
    for (const { mark, at } of seen) {
      const [x, y] = at!;
      context.beginPath();
      context.arc(x, y, 4, 0, 2 * Math.PI);
      context.fillStyle = mark.colour;
      context.fill();
      context.lineWidth = 1.5;
      context.strokeStyle = '#fff';
      context.stroke();
      context.lineWidth = 0.75;
      context.strokeStyle = 'rgba(0,0,0,.7)';
      context.beginPath();
      context.arc(x, y, 5, 0, 2 * Math.PI);
      context.stroke();
    }
    if (seen.length > MOST_NUMBERS) return;
    const put: [number, number][] = [];
    for (const { mark, at } of seen) {
      const [x, y] = [at![0], at![1] - 12];
      if (put.some(([a, b]) => Math.abs(a - x) < NEAREST_NUMBERS_PX && Math.abs(b - y) < 13)) continue;
      put.push([x, y]);
      this.#text(mark.text, x, y);
    }
  }

  /** Parts that are hidden are drawn faintly. */
  #drawSection(project: Project, hidden: Hidden): void {
    const places = this.section.map((at) => at && { at: project(at), isHidden: hidden(at) });
    for (const [width, colour] of [[5, 'rgba(0,0,0,.55)'], [2.5, '#ffd23f']] as const) {
      for (let i = 1; i < places.length; i++) {
        const [a, b] = [places[i - 1], places[i]];
        if (!a?.at || !b?.at) continue;
        this.#line(a.at, b.at, width, colour, a.isHidden || b.isHidden ? 0.25 : 1);
      }
    }
  }

  #line(a: [number, number], b: [number, number], width: number, colour: string, alpha: number): void {
    const context = this.#context;
    context.globalAlpha = alpha;
    context.lineCap = 'round';
    context.lineWidth = width;
    context.strokeStyle = colour;
    context.beginPath();
    context.moveTo(...a);
    context.lineTo(...b);
    context.stroke();
    context.globalAlpha = 1;
  }

  #drawPin(project: Project): void {
    if (!this.pin) return;
    const { at, normal } = this.pin;
    const foot = project(at);
    const head = project(at.clone().addScaledVector(normal, PIN_M));
    if (!foot) return;
    if (head) {
      this.#line(foot, head, 4, 'rgba(0,0,0,.55)', 1);
      this.#line(foot, head, 2, '#fff', 1);
    }
    const context = this.#context;
    for (const [radius, colour] of [[6, 'rgba(0,0,0,.6)'], [5, '#fff'], [3, '#e0312f']] as const) {
      context.beginPath();
      context.arc(...foot, radius, 0, 2 * Math.PI);
      context.fillStyle = colour;
      context.fill();
    }
  }

  #text(text: string, x: number, y: number): void {
    const context = this.#context;
    context.font = FONT;
    context.textAlign = 'center';
    context.textBaseline = 'middle';
    context.lineJoin = 'round';
    context.lineWidth = 3;
    context.strokeStyle = 'rgba(0,0,0,.75)';
    context.strokeText(text, x, y);
    context.fillStyle = '#fff';
    context.fillText(text, x, y);
  }
}

type Project = (at: Vector3) => [number, number] | null;

/** From places to CSS pixels; null behind the eye. */
function projector(camera: PerspectiveCamera, width: number, height: number): Project {
  const p = new Vector3();
  return (at) => {
    if (p.copy(at).applyMatrix4(camera.matrixWorldInverse).z > -camera.near) return null;
    p.applyMatrix4(camera.projectionMatrix);
    return [(0.5 + 0.5 * p.x) * width, (0.5 - 0.5 * p.y) * height];
  };
}
