// The maps that are shown, and how their data arrive.

import { Scene, type Camera, type WebGLRenderer } from 'three';
import type { Settings, Source } from '../contract';
import type { SceneHeader } from '../wire';
import { decodeMesh } from './batches';
import type { Container } from './container';
import { openLight } from './light-store';
import type { Mix } from './mixing';
import { Model } from './model';
import { Refused } from './server';
import { Sky } from './sky';
import { openTextures, type SceneTexture } from './textures';
import type { Uniforms } from './uniforms';
import { comparedWith } from './whose';

export class World {
  readonly scene: SceneHeader;
  readonly root = new Scene();
  readonly #textures: SceneTexture[];
  /** What is seen beyond the scene, if there is anything. */
  readonly sky: Sky | null;
  model: Model | null = null;
  #retired: Model | null = null;

  constructor(readonly number: number, readonly container: Container<SceneHeader>, readonly uniforms: Uniforms, changed: () => void) {
    this.scene = container.header;
    this.root.matrixWorldAutoUpdate = false;
    this.#textures = openTextures(container, changed);
    this.sky = this.scene.sky || this.scene.sun ? new Sky(container, uniforms) : null;
    if (this.sky) this.root.add(this.sky.mesh);
  }

  /** Fetches the mesh with its light; false where there is none yet. The old one is shown until both are there. */
  async load(source: Source, asked?: Promise<ArrayBuffer>): Promise<boolean> {
    const buffer = await orNotYet(asked ?? source.mesh(this.number));
    if (!buffer) return false;
    const data = decodeMesh(buffer);
    const light = await orNotYet(source.light(this.number, data.header.mesh, 0));
    if (!light) return false;
    this.#take(new Model(data, this.scene.finishes, this.#textures, this.uniforms, openLight(light, data.header.lit_vertices)));
    return true;
  }

  /** All that the graphics card had is gone. */
  lose(): void {
    this.#retired?.dispose();
    this.#retired = null;
    this.model?.dispose();
    this.#textures.forEach(({ value }) => value.dispose());
    this.sky?.lose();
  }

  /** Makes the model anew of what is in memory. */
  restore(): void {
    if (!this.model) return;
    const { data, light } = this.model;
    this.#take(new Model(data, this.scene.finishes, this.#textures, this.uniforms, light));
    this.#retired = null;
  }

  #take(model: Model): void {
    // The old shaders are those of the new one as well: they stay until it has taken them over.
    this.#retired?.dispose();
    this.#retired = this.model;
    this.#retired?.group.removeFromParent();
    this.model = model;
    this.root.add(model.group);
  }

  /** Makes all shaders of the model ready; at once where they were ready before. */
  async refine(renderer: WebGLRenderer, camera: Camera, shown: () => void): Promise<void> {
    const { model } = this;
    if (model && !model.isFine) await model.refine(renderer, camera, this.#retired?.isFine ? null : shown);
    if (model !== this.model) return;
    this.#retired?.dispose();
    this.#retired = null;
  }

  /** Fetches light that is newer than the one held; false where there is none. */
  async renew(source: Source): Promise<boolean> {
    const { model } = this;
    if (!model) return false;
    const buffer = await orNotYet(source.light(this.number, model.data.header.mesh, model.light.version));
    if (!buffer || model !== this.model) return false;
    const ranges = model.light.patch(buffer);
    model.remix(ranges);
    return ranges.length > 0;
  }
}

async function orNotYet(promise: Promise<ArrayBuffer>): Promise<ArrayBuffer | null> {
  try {
    return await promise;
  } catch (error) {
    if (error instanceof Refused && error.isNotYet) return null;
    throw error;
  }
}

/**
 * The light of a world as the settings mix it; and the other light that it is compared with, on the same vertices. Dimmers are
 * those of the first map.
 */
export function mixesOf({ number }: World, { light }: Model, settings: Readonly<Settings>): { own: Mix; second: Mix | null } {
  const own = { layers: light.layers, errors: light.errors, factors: number === 0 ? settings.dimming : [] };
  const hasOther = light.other !== null && light.otherErrors !== null;
  switch (number === 0 ? comparedWith(settings, hasOther) : null) {
    case 'dimming': return { own, second: { ...own, factors: settings.otherDimming } };
    case 'map': return { own, second: { layers: [light.other!], errors: light.otherErrors!, factors: [1] } };
    default: return { own, second: null };
  }
}
