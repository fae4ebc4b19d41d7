// What the parts of the page share.

import type { Mode, Settings, Source, Viewer, Whose } from '../contract';
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
  // Maps of other surfaces have no places in common.
  return viewer.scene.other !== null || viewer.scene.layers.length > 1 ? [...all, 'difference'] : all;
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
  return left === right ? [`left: ${left}`, `right: ${right}`] : [left, right];
}

/** What a difference is of, the first less the second. */
export function differenceNames(viewer: Viewer): [string, string] {
  const { compare } = viewer.settings;
  return sideNames(viewer, compare === 'dimmings' || viewer.scene.other === null ? 'dimmings' : 'maps');
}

/** Of what a reading is, in words; null where there is nothing else that it could be of. */
export function whoseName(viewer: Viewer, whose: Whose): string | null {
  if (whose === 'dimming') return sideNames(viewer, 'dimmings')[1];
  if (whose === 'map' || viewer.otherScene) return sideNames(viewer, 'maps')[whose === 'map' ? 1 : 0];
  return viewer.settings.compare === 'dimmings' ? sideNames(viewer, 'dimmings')[0] : null;
}

/** The same as short as a pin needs it. */
export function whoseMark(viewer: Viewer, whose: Whose): string | null {
  const name = whoseName(viewer, whose);
  return name && (whose === 'dimming' || !viewer.otherScene ? name.slice(0, 1) : name);
}

export function isDimmed({ settings }: Viewer): boolean {
  return settings.dimming.some((factor) => factor !== 1);
}

/** What has to be said of figures that a server finds: they are of the map as it was computed. */
export function undimmedNote({ viewer, source }: Ui): string | null {
  return isDimmed(viewer) && source.hello.readings === 'probe' ? 'These are values of the map undimmed; the dimmers do not act on them.' : null;
}
