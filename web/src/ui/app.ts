// The page: all of its parts, put together.

import 'uplot/dist/uPlot.min.css';
import '../style.css';
import type { Both, Source, Viewer } from '../contract';
import type { Reading } from '../wire';
import { about } from './about';
import { actionsOf, words } from './actions';
import { compareChoice, compareSlider } from './compare';
import { dimmers } from './dimmers';
import { h, replace } from './dom';
import { exposure } from './exposure';
import { grids } from './grids';
import { helpDialog } from './help';
import { hover } from './hover';
import { listenToKeys } from './keys';
import { legend } from './legend';
import { syncLink, type LinkSync } from './link-sync';
import { live } from './live';
import { lostNote } from './lost';
import { notices } from './notices';
import { panel } from './panel';
import { pinLabels } from './pin-labels';
import { pinList } from './pin-list';
import { renewPins } from './pin-renew';
import { pinsOf, type Pins } from './pins';
import { watchPointer } from './pointer';
import { sectionTool, type SectionTool } from './section';
import { applyTheme } from './theme';
import { topBar } from './topbar';
import type { Ui } from './ui';

/** Puts everything people press into `root`, around the canvas that the viewer draws on. */
export function startUi(root: HTMLElement, viewer: Viewer, source: Source): void {
  applyTheme();
  const messages = notices();
  const ui = makeUi(viewer, source, messages.say);
  viewer.onError((message) => messages.say(message, 'bad'));
  const pins = pinsOf(ui);
  const section = sectionTool(ui);
  const tip = hover(ui);
  ui.stage.append(pinLabels(ui, pins), section.mark, compareSlider(ui), crosshair(ui.canvas), waiting(viewer), lostNote(viewer), h('div', { class: 'stage-foot' }, tip.root, legend(ui)), messages.root);
  let link: LinkSync | null = null;
  const actions = actionsOf(ui, pins, () => link?.link() ?? location.href, () => help.toggle());
  const help = helpDialog(actions);
  fillPanel(ui, pins, section);
  // Finer shadows come while somebody looks at a finished map, too.
  if (!source.hello.live) source.follow({ state: (state) => viewer.refresh(state), history: () => {}, connected: () => {} });
  replace(root, topBar(ui, actions), ui.stage, ui.panel.root, help.root);
  document.documentElement.classList.add('started');
  link = syncLink(ui, pins);
  renewPins(ui, pins);
  listenToKeys(ui, actions, () => escape(ui, pins, section, tip.hide));
  watchPointer(ui, {
    hover: tip.at, leave: tip.hide,
    click: (x, y, touch) => (ui.tool === 'section' ? section.click(x, y) : void pinAt(ui, pins, x, y).then((found) => touch && found && tip.show(found, x, y))),
  });
}

function makeUi(viewer: Viewer, source: Source, say: Ui['say']): Ui {
  const canvas = document.getElementById('view') as HTMLCanvasElement;
  const calls: (() => void)[] = [];
  const ui: Ui = {
    viewer, source, canvas, say, stage: h('div', { class: 'stage' }), panel: panel(), tool: 'pin', onTool: (call) => void calls.push(call),
    setTool: (tool) => {
      ui.tool = tool;
      canvas.classList.toggle('drawing', tool === 'section');
      calls.forEach((call) => call());
    },
  };
  return ui;
}

function fillPanel(ui: Ui, pins: Pins, section: SectionTool): void {
  const tables = grids(ui);
  const facts = about(ui);
  if (ui.source.hello.live) {
    const run = live(ui);
    ui.panel.add({ id: 'run', label: 'Run', icon: 'run', body: run.root });
    ui.stage.append(run.chip);
    const chip = (): void => void (run.chip.hidden = ui.panel.current() === 'run');
    ui.panel.onChange(chip);
  }
  ui.panel.add({ id: 'readings', label: 'Readings', icon: 'pin', body: pinList(ui, pins) });
  ui.panel.add({ id: 'light', label: 'Light', icon: 'light', body: h('div', {}, exposure(ui), dimmers(ui), compareChoice(ui)) });
  ui.panel.add({ id: 'section', label: 'Section', icon: 'ruler', body: section.root });
  ui.panel.add({ id: 'grids', label: 'Grids', icon: 'grid', body: tables.root, shown: (is) => is && tables.load() });
  ui.panel.add({ id: 'about', label: 'Map', icon: 'map', body: facts.root, shown: facts.shown });
  if (ui.source.hello.live && matchMedia('(min-width: 1000px)').matches) ui.panel.open('run');
}

/** Keeps what is read at a point of the canvas; what is to be shown of it. */
async function pinAt(ui: Ui, pins: Pins, x: number, y: number): Promise<Reading | Both | null> {
  const { viewer } = ui;
  const [{ signal }, whose] = [new AbortController(), viewer.whoseAt(x)];
  try {
    const both = viewer.settings.mode === 'difference' ? await viewer.readBothAt(x, y, signal) : null;
    const reading = both?.own ?? (await viewer.readAt(x, y, signal));
    if (!reading?.position) return null;
    pins.add(reading, whose);
    return both ?? reading;
  } catch (error) {
    ui.say(`The reading failed: ${words(error)}`, 'bad');
    return null;
  }
}

/** Closes one thing at a time: the tool, the pin chosen, the panel. */
function escape(ui: Ui, pins: Pins, section: SectionTool, hide: () => void): void {
  hide();
  if (document.pointerLockElement) return;
  if (ui.tool === 'section') {
    section.reset();
    ui.setTool('pin');
  } else if (pins.chosen()) pins.choose(null);
  else ui.panel.close();
}

/** The middle of the view, while the pointer is locked or the canvas has the focus of the keyboard. */
function crosshair(canvas: HTMLCanvasElement): HTMLElement {
  const mark = h('div', { class: 'crosshair', hidden: true, 'aria-hidden': 'true' });
  const refresh = (): void => {
    const locked = document.pointerLockElement !== null;
    mark.hidden = !locked && !canvas.matches(':focus-visible');
    canvas.classList.toggle('locked', locked);
  };
  document.addEventListener('pointerlockchange', refresh);
  canvas.addEventListener('focus', refresh);
  canvas.addEventListener('blur', refresh);
  return mark;
}

/** Said until there is a first picture with light. */
function waiting(viewer: Viewer): HTMLElement {
  const note = h('p', { class: 'first-light card', role: 'status', hidden: true }, 'Waiting for the first light …');
  const timer = window.setTimeout(() => { note.hidden = false; }, 600);
  const done = (): void => {
    window.clearTimeout(timer);
    note.remove();
  };
  viewer.ready.then(done, done);
  return note;
}
