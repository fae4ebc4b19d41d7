// What the parts of the page share.

import type { Mode, Settings, Source, Viewer } from '../contract';
import type { Notices } from './notices';
import type { Panel } from './panel';

export interface Ui {
  viewer: Viewer;
  source: Source;
  canvas: HTMLCanvasElement;
  /** Lies over the canvas; what is in it is placed in CSS pixels of the canvas. */
  stage: HTMLElement;
  panel: Panel;
  say: Notices['say'];
  /** Which of two clicks a click on the canvas is. */
  tool: 'pin' | 'section';
  setTool(tool: Ui['tool']): void;
  onTool(call: () => void): void;
}

export const MODE_NAMES: Record<Mode, string> = {
  seen: 'As seen',
  illuminance: 'Illuminance',
  luminance: 'Luminance',
  direct: 'Direct illuminance',
  indirect: 'Indirect illuminance',
  error: 'Standard error',
  relative: 'Relative error',
  difference: 'Difference',
};

/** Whether two maps are there to be compared. */
export function isComparable(viewer: Viewer): boolean {
  return viewer.otherScene !== null || viewer.scene.other !== null;
}

/** Modes that this scene can show, in the order of their keys. */
export function modesOf(viewer: Viewer): Mode[] {
  const all: Mode[] = ['seen', 'illuminance', 'luminance', 'direct', 'indirect', 'error', 'relative'];
  return isComparable(viewer) || viewer.scene.layers.length > 1 ? [...all, 'difference'] : all;
}

/** Names of the layers of light. */
export function layerNames(viewer: Viewer): string[] {
  const { layers } = viewer.scene;
  return layers.length > 0 ? layers.map((name, i) => name || (layers.length === 1 ? 'All light' : `Layer ${i + 1}`)) : ['All light'];
}

/** A dimming in a few words: `spots 30 %, panels off`. */
export function dimmingName(names: string[], factors: number[]): string {
  const dimmed = names.flatMap((name, i) => {
    const percent = Math.round(100 * (factors[i] ?? 1));
    return percent === 100 ? [] : [`${name} ${percent === 0 ? 'off' : `${percent} %`}`];
  });
  if (dimmed.length === 0) return 'undimmed';
  return dimmed.length > 2 ? `${dimmed.slice(0, 2).join(', ')} and ${dimmed.length - 2} more` : dimmed.join(', ');
}

/** Names of what is left and right of the slider. */
export function sideNames(viewer: Viewer, compare: Settings['compare']): [string, string] {
  if (compare === 'dimmings') {
    const { dimming, otherDimming } = viewer.settings;
    return [`A: ${dimmingName(layerNames(viewer), dimming)}`, `B: ${dimmingName(layerNames(viewer), otherDimming)}`];
  }
  const left = viewer.scene.file || viewer.scene.name;
  const right = viewer.otherScene?.file ?? viewer.scene.other ?? 'other map';
  return [left, right];
}

export function isDimmed({ settings }: Viewer): boolean {
  return settings.dimming.some((factor) => factor !== 1);
}

/** What has to be said of figures that a server finds: they are of the map as it was computed. */
export function undimmedNote({ viewer, source }: Ui): string | null {
  return isDimmed(viewer) && source.hello.readings === 'probe' ? 'These are values of the map undimmed; the dimmers do not act on them.' : null;
}
