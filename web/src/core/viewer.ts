// The view of a world: what `Viewer` of the contract promises.

import type { Settings, Source, Viewer } from '../contract';
import { decode } from './container';
import { Emitter } from './emitter';
import { Engine } from './engine';
import { evOfWhite } from './exposure';
import { Finder } from './finder';
import { GridMarks } from './grid-marks';
import { makeRenderer, Quality } from './graphics';
import { Luminaires } from './luminaires';
import { Marks } from './marks';
import { Navigation } from './navigation';
import type { EventName, Parts } from './parts';
import { Renewal } from './renewal';
import { Shown } from './shown';
import { snapshot } from './snapshot';
import { makeUniforms } from './uniforms';
import { World } from './worlds';

function startSettings(world: World, isAlone: boolean): Settings {
  const { scene } = world;
  const ones = (scene.layers.length > 0 ? scene.layers : ['']).map(() => 1);
  return {
    mode: 'seen', tone: scene.tones[0]?.name ?? '', autoExposure: true, ev100: evOfWhite(scene.white_cd_m2 || 1), colourMap: scene.colour_maps[0]?.name ?? '',
    limits: null, logarithmic: false, mesh: false, contours: false, luminaires: 'points', grids: false, dimming: ones, otherDimming: [...ones],
    compare: isAlone ? 'off' : 'maps', split: 0.5, quality: 'auto',
  };
}

export async function createViewer(canvas: HTMLCanvasElement, overlay: HTMLElement, source: Source): Promise<Viewer> {
  // Data travel while the graphics start.
  const asked = source.hello.worlds.map((_, i) => ({ scene: source.scene(i), mesh: source.mesh(i) }));
  asked.flatMap(({ scene, mesh }) => [scene, mesh]).forEach((promise) => promise.catch(() => {}));
  const { renderer, isSoftware } = makeRenderer(canvas);
  const uniforms = makeUniforms();
  const later: { changed: () => void } = { changed: () => {} };
  const changed = (): void => later.changed();
  const worlds = await Promise.all(asked.map(async ({ scene }, i) => new World(i, decode(await scene, 'scene'), uniforms, changed)));
  const first = worlds[0]!;
  const errors = new Errors();
  const settings = startSettings(first, worlds.length === 1);
  const navigation = new Navigation(canvas, first.scene, changed);
  const quality = new Quality(isSoftware, settings.quality);
  const finder = new Finder(source, first, navigation, canvas, () => settings, (bvh) => (navigation.walk.bvh = bvh));
  const parts: Parts = {
    renderer, uniforms, quality, navigation, shown: new Shown(first.container, uniforms), marks: new Marks(overlay), luminaires: new Luminaires(first.scene, first.root),
    worlds, events: new Emitter<EventName>(), settings, white: first.scene.white_cd_m2 || 1, canvas, hidden: () => finder.hidden(),
  };
  const engine = new Engine(parts);
  later.changed = () => engine.invalidate();
  const renewal = new Renewal(source, worlds, () => modelsChanged(engine, finder), () => engine.renew(), (message) => errors.tell(message));
  await renewal.loadAll(asked.map(({ mesh }) => mesh));
  return assemble(source, parts, engine, finder, renewal, errors);
}

function modelsChanged(engine: Engine, finder: Finder): void {
  engine.renew();
  void engine.ready.then(() => engine.refine()).then(() => finder.build());
}

class Errors {
  readonly #calls: ((message: string) => void)[] = [];
  readonly #untold: string[] = [];

  tell(message: string): void {
    if (this.#calls.length === 0) this.#untold.push(message);
    this.#calls.forEach((call) => call(message));
  }

  on(call: (message: string) => void): void {
    this.#calls.push(call);
    this.#untold.splice(0).forEach(call);
  }
}

/** Puts the parts together to what the contract says. */
function assemble(source: Source, parts: Parts, engine: Engine, finder: Finder, renewal: Renewal, errors: Errors): Viewer {
  const { worlds, settings, navigation, events, marks, shown } = parts;
  const gridMarks = new GridMarks(source, parts, () => engine.invalidate());
  parts.canvas.addEventListener('webglcontextlost', () => engine.lose());
  // Heard after three.js has made itself at home again.
  parts.canvas.addEventListener('webglcontextrestored', () => {
    engine.restore();
    modelsChanged(engine, finder);
  });
  const jump = (animate: boolean): void => {
    if (!animate) engine.jump();
  };
  return {
    scene: worlds[0]!.scene,
    otherScene: worlds[1]?.scene ?? null,
    settings,
    set: (change) => change_(parts, engine, gridMarks, change),
    view: () => navigation.view(),
    goTo: (view, animate) => (jump(animate), navigation.goTo(view, animate)),
    goToCamera: (index, animate) => (jump(animate), navigation.goToCamera(index, animate)),
    frame: (animate) => (jump(animate), navigation.frame(animate)),
    get navigation() {
      return navigation.how;
    },
    setNavigation: (how) => {
      navigation.setHow(how);
      events.tell('navigation');
    },
    readAt: (x, y, signal) => finder.readAt(x, y, signal),
    whoseAt: (x) => finder.whoseAt(x),
    glanceAt: (x, y, whose) => finder.glanceAt(x, y, whose),
    readBothAt: (x, y, signal) => finder.readBothAt(x, y, signal),
    glanceBothAt: (x, y) => finder.glanceBothAt(x, y),
    isLost: () => engine.isLost,
    pin: (reading) => {
      marks.pin = reading?.position && reading.normal ? { at: finder.inScene(reading.position), normal: finder.direction(reading.normal) } : null;
      engine.invalidate();
    },
    section: async (from, to, signal) => {
      const found = await finder.section(from, to, signal);
      marks.section = found.line;
      engine.invalidate();
      return found.readings;
    },
    clearSection: () => {
      marks.section = [];
      engine.invalidate();
    },
    grids: () => gridMarks.tables(),
    legend: () => {
      engine.freshen();
      return shown.legend(settings);
    },
    exposure: () => ({ whiteCdM2: engine.adaptation.white, ev100: evOfWhite(engine.adaptation.white) }),
    snapshot: (draw) => snapshot(parts, engine, draw),
    stats: () => statsOf(parts, source),
    refresh: (state) => renewal.refresh(state),
    on: (event, call) => events.on(event, call),
    onError: (call) => errors.on(call),
    ready: engine.ready,
  };
}

function change_(parts: Parts, engine: Engine, gridMarks: GridMarks, change: Partial<Settings>): void {
  const { settings, worlds, events, quality } = parts;
  const isMixed = (['dimming', 'otherDimming', 'compare', 'mode'] as const).some((name) => name in change && String(change[name]) !== String(settings[name]));
  const isComparedAnew = isMixed && ('compare' in change || (change.mode === 'difference') !== (settings.mode === 'difference'));
  const isSplitOnly = Object.keys(change).every((name) => name === 'split');
  // Switching automatic exposure off keeps what is seen.
  if (change.autoExposure === false && settings.autoExposure && change.ev100 === undefined) settings.ev100 = evOfWhite(engine.adaptation.white);
  Object.assign(settings, change);
  quality.how = settings.quality;
  if (isComparedAnew || (isMixed && ('dimming' in change || 'otherDimming' in change))) {
    worlds.forEach(({ model }) => model?.remix());
    parts.luminaires.dim(settings.dimming);
    worlds[0]!.sky?.dim(settings.dimming);
  }
  gridMarks.update();
  if (isSplitOnly) engine.invalidate();
  else engine.renew();
  events.tell('settings');
}

function statsOf({ worlds, quality }: Parts, source: Source): ReturnType<Viewer['stats']> {
  const headers = worlds.flatMap(({ model }) => (model ? [model.data.header] : []));
  const sum = (of: (h: (typeof headers)[number]) => number): number => headers.reduce((all, h) => all + of(h), 0);
  return {
    triangles: sum((h) => h.triangles), vertices: sum((h) => h.positions.count / 3), fps: quality.fps, found: source.hello.readings,
    bytes: worlds.reduce((all, { model, container }) => all + container.bytes + (model ? model.data.bytes + 12 * model.light.vertices : 0), 0),
  };
}
