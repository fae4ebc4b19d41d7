// The loop: it draws when something has changed, and rests otherwise.

import { Edges } from './edges';
import { Adaptation, logAverage, Meter, MIDDLE_GREY, whiteOfEv, type Sample } from './exposure';
import { labelsOf } from './labels';
import type { Model } from './model';
import { Painter, type Side } from './painter';
import type { Parts } from './parts';
import { mixesOf } from './worlds';

/** Time for mixing light in a frame, ms. */
const MIXING_MS = 10;
/** After so long without movement pictures rest, ms. */
const REST_MS = 250;
/** Between readings of the exposure while something moves, ms. */
const METER_MS = 150;
/** And at least so many frames. */
const METER_FRAMES = 5;
/** With fewer frames in a second exposure does not follow smoothly: it jumps. */
const SMOOTH_FPS = 8;
/** How often it is looked whether the exposure can be read, ms. */
const BUSY_MS = 4;

export class Engine {
  readonly adaptation: Adaptation;
  readonly #painter: Painter;
  readonly #meter: Meter;
  readonly #edges = new Edges();
  #isAsked = false;
  #isDirty = true;
  #isMeterOld = true;
  #isScaleOld = true;
  #before = 0;
  #wasMoving = false;
  #metered = 0;
  #hasJumped = true;
  /** When something moved last. */
  #moving = -1e9;
  #size = '';
  #first: (() => void) | null = null;
  #sample: Sample | null = null;
  #isLost = false;
  readonly ready = new Promise<void>((resolve) => (this.#first = resolve));

  constructor(readonly parts: Parts) {
    this.adaptation = new Adaptation(parts.white);
    this.#painter = new Painter(parts.renderer, parts.uniforms, parts.quality, parts.navigation);
    this.#meter = new Meter(parts.renderer);
    new ResizeObserver(() => this.invalidate()).observe(parts.canvas);
    document.addEventListener('visibilitychange', () => this.invalidate());
  }

  get #model(): Model | null {
    return this.parts.worlds[0]!.model;
  }

  /** Something may look different: a frame is drawn soon. */
  invalidate(): void {
    this.#isDirty = true;
    this.#ask();
  }

  /** Settings or light have changed. */
  renew(): void {
    this.#isScaleOld = true;
    this.#isMeterOld = true;
    this.invalidate();
  }

  #ask(): void {
    if (this.#isAsked) return;
    this.#isAsked = true;
    requestAnimationFrame((now) => this.#frame(now));
  }

  #frame(now: number): void {
    this.#isAsked = false;
    const { navigation, quality } = this.parts;
    const passed = this.#wasMoving ? Math.min(1, (now - this.#before) / 1000) : 1 / 60;
    if (this.#wasMoving && quality.took(now - this.#before)) this.#isDirty = true;
    this.#before = now;
    this.#resize(!this.#wasMoving && now - this.#moving > REST_MS);
    const moves = navigation.update(Math.min(0.25, passed));
    const hasMoved = navigation.hasMoved();
    const mixed = this.#mix(this.#first ? Infinity : MIXING_MS);
    const adapts = this.#adapt(passed);
    if (hasMoved) this.#moved();
    if (this.#isDirty || hasMoved || mixed || adapts) this.#draw();
    const rests = !moves && !hasMoved && !this.#model?.isWaiting;
    this.#measure(now, rests);
    this.#goOn(now, moves || hasMoved, adapts);
  }

  #goOn(now: number, isMoving: boolean, adapts: boolean): void {
    if (isMoving) this.#moving = now;
    else if (this.#wasMoving) setTimeout(() => this.#settle(), REST_MS + 20);
    this.#wasMoving = isMoving || adapts;
    if (this.#wasMoving || this.#isDirty || this.#model?.isWaiting || this.#isMeterOld) this.#ask();
  }

  /** What rests is drawn once more, finer. */
  #settle(): void {
    if (this.parts.quality.level === 0) this.#isDirty = true;
    this.#ask();
  }

  /** The camera has been put elsewhere: exposure does not follow slowly. */
  jump(): void {
    this.#hasJumped = true;
  }

  #moved(): void {
    this.#isMeterOld = true;
    this.parts.marks.labels = [];
    this.parts.events.tell('view');
  }

  #resize(rests: boolean): void {
    const { canvas, renderer, quality, navigation, luminaires, uniforms } = this.parts;
    const [width, height, ratio] = [Math.max(1, canvas.clientWidth), Math.max(1, canvas.clientHeight), quality.pixelRatio(rests)];
    const size = `${width} ${height} ${ratio}`;
    if (size === this.#size) return;
    this.#size = size;
    renderer.setPixelRatio(ratio);
    renderer.setSize(width, height, false);
    navigation.resize(width, height);
    luminaires.setHeight(height * ratio);
    uniforms.uPixels.value = Math.max(0.75, ratio);
    this.#isDirty = true;
  }

  /** Mixes waiting light, for so long; all of it before the first picture. */
  #mix(milliseconds: number): boolean {
    const { worlds, settings } = this.parts;
    let did = false;
    for (const world of worlds) {
      const { model } = world;
      if (!model) continue;
      const { own, second } = mixesOf(world, model, settings);
      model.setSecond(second !== null);
      if (!model.work(own, second, milliseconds)) continue;
      did = true;
      if (!model.isWaiting) this.#lightChanged();
    }
    return did;
  }

  #lightChanged(): void {
    this.#isScaleOld = true;
    this.#isMeterOld = true;
    this.#painter.outdate();
    this.parts.events.tell('light');
  }

  #adapt(seconds: number): boolean {
    if (!this.parts.settings.autoExposure) this.#expose();
    if (!this.adaptation.isSettled) this.adaptation.step(seconds);
    return this.#showWhite();
  }

  /** Exposure by its value, at once. */
  #expose(): void {
    this.adaptation.want(whiteOfEv(this.parts.settings.ev100));
    this.adaptation.finish();
  }

  /** Brings the white of the shaders up to date; true if the picture is another one now. */
  #showWhite(): boolean {
    const { settings, shown, events } = this.parts;
    if (shown.uniforms.uWhite.value === this.adaptation.white) return false;
    shown.setWhite(settings, this.adaptation.white);
    events.tell('exposure');
    return settings.mode === 'seen';
  }

  #draw(): void {
    this.#isDirty = false;
    const { settings, luminaires, worlds } = this.parts;
    this.freshen();
    if (settings.mesh) this.#edges.show(this.#model);
    else this.#edges.clear();
    luminaires.show(settings.luminaires, settings.mode === 'seen');
    if (this.#isLost) return;
    if (!worlds[0]!.model) return this.parts.renderer.clear();
    this.#painter.paint(this.#sides(), settings.split, this.#wasMoving);
    this.drawMarks();
    this.#first?.();
    this.#first = null;
  }

  /** Brings scale and colours up to date with settings and light. */
  freshen(): void {
    if (!this.#isScaleOld) return;
    this.#isScaleOld = false;
    const { settings, shown, events } = this.parts;
    shown.update(settings, this.#model, this.adaptation.white);
    events.tell('legend');
  }

  #sides(): Side[] {
    const { worlds, settings } = this.parts;
    const [own, other] = [{ world: worlds[0]!, side: 0 as const }, worlds[1]];
    if (settings.compare === 'off' || settings.mode === 'difference') return [own];
    if (settings.compare === 'maps' && other?.model) return [own, { world: other, side: 0 }];
    return this.#model?.hasSecond ? [own, { ...own, side: 1 }] : [own];
  }

  drawMarks(): void {
    const { marks, navigation, canvas, hidden } = this.parts;
    if (this.#model) marks.draw(navigation.camera, canvas.clientWidth, canvas.clientHeight, hidden());
  }

  /** Reads the exposure, and where isolux lines run; when all rests, once more. */
  #measure(now: number, rests: boolean): void {
    const { worlds, quality } = this.parts;
    const model = this.#model;
    if (!model || this.#isLost) this.#isMeterOld = false;
    if (!model || !this.#isMeterOld || this.#meter.isBusy || (!rests && now - this.#metered < Math.max(METER_MS, METER_FRAMES * quality.frameMs))) return;
    this.#metered = now;
    if (rests) this.#isMeterOld = false;
    if (rests && this.#painter.renewSurroundings({ world: worlds[0]!, side: 0 })) this.#isDirty = true;
    const reading = this.#meterNow(model);
    const jumps = this.#hasJumped;
    this.#hasJumped = false;
    reading.then((sample) => this.#read(sample, rests, jumps), () => {});
  }

  #meterNow(model: Model): Promise<Sample> {
    const { renderer, worlds, navigation, uniforms } = this.parts;
    uniforms.uSide.value = 0;
    model.materials.glassAdds(true);
    return this.#meter.read(renderer, worlds[0]!.root, navigation.camera, uniforms);
  }

  #read(sample: Sample, rests: boolean, jumps: boolean): void {
    if (this.#isLost) return;
    const { settings, marks, shown, canvas, quality } = this.parts;
    this.#sample = sample;
    if (jumps || quality.fps < SMOOTH_FPS) this.adaptation.jump();
    if (settings.autoExposure) this.adaptation.want(whiteOf(sample));
    const isStill = rests && !this.#wasMoving;
    marks.labels = isStill && shown.lines.length > 0 && settings.compare === 'off' ? labelsOf(sample, shown.lines, canvas.clientWidth, canvas.clientHeight) : [];
    this.drawMarks();
    this.#ask();
  }

  /** Makes all shaders ready, now that something is seen. */
  async refine(): Promise<void> {
    const { worlds, renderer, navigation, luminaires } = this.parts;
    for (const world of worlds) await world.refine(renderer, navigation.camera, () => this.invalidate());
    luminaires.isReady = true;
    this.#painter.outdate();
    this.renew();
  }

  /** The small picture read last. */
  get sample(): Sample | null {
    return this.#sample;
  }

  /** Brings light and exposure to what is asked for now, without taking time as eyes do. */
  async settle(): Promise<void> {
    if (this.#isLost) throw new Error('The graphics card has been lost.');
    this.#mix(Infinity);
    if (!this.parts.settings.autoExposure) return this.#expose();
    this.freshen();
    while (this.#meter.isBusy) await new Promise((resolve) => setTimeout(resolve, BUSY_MS));
    if (!this.#model || this.#isLost) return;
    this.adaptation.want(whiteOf(await this.#meterNow(this.#model)));
    this.adaptation.finish();
  }

  /** Draws at once, for a copy of the canvas. */
  drawNow(): void {
    this.#resize(true);
    this.#showWhite();
    this.#draw();
  }

  get isLost(): boolean {
    return this.#isLost;
  }

  /** The graphics card has gone, and all that it had. */
  lose(): void {
    const { worlds, shown } = this.parts;
    this.#isLost = true;
    // What belongs to the old context is let go of while it is lost: later that would be an error.
    worlds.forEach((world) => world.lose());
    [this.#painter, this.#meter, shown].forEach((held) => held.dispose());
    this.#edges.clear();
    this.parts.events.tell('graphics');
  }

  /** It is there again: what it had is given to it anew. */
  restore(): void {
    this.#isLost = false;
    this.parts.worlds.forEach((world) => world.restore());
    this.parts.events.tell('graphics');
  }
}

/** The luminance of white for which the mean of a picture is middle grey. */
const whiteOf = (sample: Sample): number => (logAverage(sample) ?? MIDDLE_GREY) / MIDDLE_GREY;
