// Pins are read again when the light changes: by the server where it can be, else where they are seen.

import type { Whose } from '../contract';
import type { Reading, Vec3 } from '../wire';
import { throttled } from './dom';
import type { Pin, Pins } from './pins';
import { project } from './project';
import type { Ui } from './ui';

const EVERY_MS = 1500;
/** A ray onto a place begins that far off its surface, m. */
const OFF_M = 0.004;
/** A surface farther than that from a pin that is seen in its place hides it, m; and that share of the distance. */
const [NEAR_M, NEAR_SHARE] = [0.02, 0.02];

export function renewPins(ui: Ui, pins: Pins): void {
  let turn = 0;
  const all = async (): Promise<void> => {
    const mine = ++turn;
    for (const pin of pins.all()) {
      const reading = await again(ui, pin);
      if (mine !== turn) return;
      pins.renew(pin, reading);
    }
  };
  const soon = throttled(() => void all(), EVERY_MS);
  const dimmed = (): string => [ui.viewer.settings.dimming, ui.viewer.settings.otherDimming].join(';');
  let dimming = dimmed();
  ui.viewer.on('light', soon);
  ui.viewer.on('settings', () => {
    const now = dimmed();
    if (now !== dimming) soon();
    dimming = now;
  });
  void ui.viewer.ready.then(soon, () => {});
}

async function again(ui: Ui, { whose, reading: { position, normal } }: Pin): Promise<Reading | null> {
  if (!position || !normal) return null;
  const { viewer, source } = ui;
  const { dimming: own, otherDimming } = viewer.settings;
  const factors = { own, dimming: otherDimming, map: [1] }[whose];
  if (source.hello.readings !== 'probe' || factors.every((factor) => factor === 0)) return seen(ui, position, whose)?.reading ?? null;
  const origin = position.map((v, i) => v + OFF_M * normal[i]!) as Vec3;
  const direction = normal.map((v) => -v) as Vec3;
  try {
    const dimming = factors.every((factor) => factor === 1) ? [] : factors;
    const [reading] = await source.read(whose === 'map' ? 1 : 0, [{ origin, direction }], dimming, new AbortController().signal);
    return reading?.position ? reading : null;
  } catch {
    return null;
  }
}

/** Where a place is on the canvas, null if not on it; with what is read there, if that is known and nothing hides it. */
export function seen({ viewer, canvas }: Ui, position: Vec3, whose: Whose = 'own'): { at: [number, number]; reading: Reading | null; hidden: boolean } | null {
  const { clientWidth: width, clientHeight: height } = canvas;
  const at = project(position, viewer.view(), viewer.scene.up, width, height);
  if (!at || at[0] < 0 || at[1] < 0 || at[0] > width || at[1] > height) return null;
  const [there, reading] = [viewer.glanceAt(at[0], at[1], 'own'), viewer.glanceAt(at[0], at[1], whose)];
  const distance = (a: Vec3): number => Math.hypot(...a.map((v, i) => v - position[i]!));
  const away = there?.position ? distance(there.position) : 0;
  const hidden = away > NEAR_M + NEAR_SHARE * distance(viewer.view().position);
  return { at, reading: hidden || !reading?.position ? null : reading, hidden };
}
