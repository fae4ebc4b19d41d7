// What can be done by a key, a button or a menu: one list for all three, and for the list of keys.

import type { Mode, Settings } from '../contract';
import { download, copy } from './notices';
import { fileName } from './csv';
import type { IconName } from './icons';
import { pinPicture } from './pin-picture';
import type { Pins } from './pins';
import { MODE_NAMES, modesOf, type Ui } from './ui';

export interface Action {
  id: string;
  label: string;
  /** As `KeyboardEvent.key` has it, lower case; with "shift+" before it where it needs that. */
  key: string;
  icon?: IconName;
  run(): void;
  /** Whether it is on, for switches. */
  on?(): boolean;
  /** Its letter is one that walks, so it does not act while walking. */
  walks?: boolean;
}

const LUMINAIRES: Settings['luminaires'][] = ['off', 'points', 'solids'];
export const LUMINAIRE_NAMES: Record<Settings['luminaires'], string> =
  { off: 'Luminaires: off', points: 'Luminaires: lamps', solids: 'Luminaires: photometric solids' };

export function actionsOf(ui: Ui, pins: Pins, link: () => string, help: () => void): Action[] {
  return [...modes(ui), ...layers(ui), ...views(ui), ...exposures(ui), ...outputs(ui, pins, link, help)];
}

function modes({ viewer }: Ui): Action[] {
  return modesOf(viewer).map((mode, i) => ({
    id: `mode-${mode}`, label: MODE_NAMES[mode], key: String(i + 1), run: () => viewer.set(compared(viewer, mode)), on: () => viewer.settings.mode === mode,
  }));
}

/** A difference is that of two maps, or else of two dimmings. */
function compared(viewer: Ui['viewer'], mode: Mode): Partial<Settings> {
  return mode === 'difference' && viewer.scene.other === null ? { mode, compare: 'dimmings' } : { mode };
}

function layers({ viewer }: Ui): Action[] {
  const flag = (id: 'contours' | 'mesh' | 'grids', label: string, key: string, icon: IconName): Action => ({
    id, label, key, icon, on: () => viewer.settings[id], run: () => viewer.set({ [id]: !viewer.settings[id] }),
  });
  return [
    flag('contours', 'Isolux lines', 'c', 'contours'),
    flag('mesh', 'Element mesh', 'm', 'mesh'),
    {
      id: 'luminaires', label: 'Luminaires: off, lamps, photometric solids', key: 'l', icon: 'lamp', on: () => viewer.settings.luminaires !== 'off',
      run: () => viewer.set({ luminaires: LUMINAIRES[(LUMINAIRES.indexOf(viewer.settings.luminaires) + 1) % LUMINAIRES.length]! }),
    },
    flag('grids', 'Calculation grids', 'g', 'grid'),
  ];
}

function views(ui: Ui): Action[] {
  const { viewer } = ui;
  let camera = -1;
  const step = (by: number): void => {
    const many = viewer.scene.cameras.length;
    if (many === 0) {
      ui.say('This scene has no cameras.');
      return;
    }
    camera = camera < 0 && by < 0 ? many - 1 : (camera + by + many) % many;
    viewer.goToCamera(camera, true);
    ui.say(viewer.scene.cameras[camera]!.name || `Camera ${camera + 1}`);
  };
  return [
    { id: 'frame', label: 'All of the scene in sight', key: 'home', icon: 'frame', run: () => viewer.frame(true) },
    { id: 'next', label: 'Next camera', key: 'n', run: () => step(1) },
    { id: 'previous', label: 'Camera before', key: 'shift+n', run: () => step(-1) },
    {
      id: 'walk', label: 'Walk or orbit', key: 'v', icon: 'walk', on: () => viewer.navigation === 'walk',
      run: () => viewer.setNavigation(viewer.navigation === 'walk' ? 'orbit' : 'walk'),
    },
    { id: 'section', label: 'Section along a line', key: 's', icon: 'ruler', walks: true, on: () => ui.tool === 'section',
      run: () => ui.setTool(ui.tool === 'section' ? 'pin' : 'section') },
  ];
}

function exposures({ viewer }: Ui): Action[] {
  const by = (step: number): void => {
    const ev100 = Math.round((viewer.exposure().ev100 + step) * 3) / 3;
    viewer.set({ autoExposure: false, ev100 });
  };
  return [
    { id: 'exposure', label: 'Automatic exposure', key: 'e', walks: true, on: () => viewer.settings.autoExposure,
      run: () => viewer.set(viewer.settings.autoExposure
        ? { autoExposure: false, ev100: viewer.exposure().ev100 } : { autoExposure: true }) },
    { id: 'brighter', label: 'Brighter by a third of a stop', key: '[', run: () => by(-1 / 3) },
    { id: 'darker', label: 'Darker by a third of a stop', key: ']', run: () => by(1 / 3) },
  ];
}

function outputs(ui: Ui, pins: Pins, link: () => string, help: () => void): Action[] {
  return [
    { id: 'snapshot', label: 'Save a picture (PNG)', key: 'p', icon: 'picture', run: () => void saveSnapshot(ui, pins) },
    { id: 'link', label: 'Copy a link to this view', key: 'k', icon: 'link', run: () => void copy(link(), 'Link', ui.say) },
    { id: 'full', label: 'Full screen', key: 'f', icon: 'full', on: () => document.fullscreenElement !== null, run: () => void fullScreen(ui) },
    { id: 'help', label: 'Keys and help', key: 'h', icon: 'help', run: help },
  ];
}

async function saveSnapshot(ui: Ui, pins: Pins): Promise<void> {
  const { viewer, say } = ui;
  const name = fileName([viewer.scene.name, viewer.settings.mode], 'png');
  try {
    download(name, await viewer.snapshot(pinPicture(ui, pins)));
    say(`${name} saved.`);
  } catch (error) {
    say(`The picture could not be made: ${words(error)}`, 'bad');
  }
}

async function fullScreen({ say }: Ui): Promise<void> {
  try {
    if (document.fullscreenElement) await document.exitFullscreen();
    else await document.documentElement.requestFullscreen();
  } catch {
    say('This browser does not allow full screen here.');
  }
}

/** What went wrong, in words. */
export function words(error: unknown): string {
  return error instanceof Error ? error.message : String(error);
}
