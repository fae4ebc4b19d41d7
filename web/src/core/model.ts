// A mesh with its light on the GPU.

import { Group, Mesh, Scene, type BufferAttribute, type BufferGeometry, type Camera, type IUniform, type Material, type Texture, type WebGLRenderer } from 'three';
import type { Finish } from '../wire';
import { packBatches, type Batch, type MeshData, type Slot } from './batches';
import { makeGeometry, lightAttribute, setLight } from './geometry';
import type { LightStore, Range } from './light-store';
import { Materials } from './materials';
import { mix, WORDS, type Mix } from './mixing';
import type { Plane } from './planes';
import type { SceneTexture } from './textures';
import { table, type Uniforms } from './uniforms';

/** Layers of objects: what is drawn in every picture, and marks that are on the display alone. */
export const LAYER = { surfaces: 0, glass: 1, marks: 2 } as const;

export interface Part {
  batch: Batch;
  geometry: BufferGeometry;
  meshes: Mesh[];
}

export class Model {
  readonly group = new Group();
  readonly parts: Part[];
  readonly slots: readonly Slot[];
  readonly planes: Plane[];
  readonly materials: Materials;
  readonly #tables: { uChunks: IUniform<Texture>; uFinishes: IUniform<Texture> };
  /** Chunks with light, by first vertex, whose light is to be mixed again: for this side, and for the other. */
  readonly #waiting = { light: new Set<number>(), light2: new Set<number>() };
  readonly #lit: number[];
  hasSecond = false;
  /** Whether it is drawn with all its shaders. */
  isFine = false;
  readonly #ready = new Set<Material>();

  constructor(readonly data: MeshData, readonly finishes: Finish[], readonly textures: readonly SceneTexture[], shared: Uniforms, public light: LightStore) {
    const { chunks } = data.header;
    const packed = packBatches(data, finishes);
    this.slots = packed.slots;
    this.planes = packed.planes;
    this.#tables = { uChunks: { value: chunkTable(data) }, uFinishes: { value: finishTable(finishes) } };
    this.materials = new Materials(shared, this.#tables, textures);
    this.parts = packed.batches.map((batch) => this.#part(batch));
    this.#lit = chunks.map((_, i) => i).filter((i) => chunks[i]!.lit);
    this.group.matrixWorldAutoUpdate = false;
    this.remix();
  }

  #part(batch: Batch): Part {
    const geometry = makeGeometry(this.data, batch, this.slots);
    const passes = batch.kind === 'glass' ? [0, 1] as const : [0] as const;
    const meshes = passes.map((pass) => {
      const isGlass = batch.kind === 'glass';
      const mesh = new Mesh(geometry, isGlass ? this.materials.of(batch, pass) : this.materials.lean(batch));
      mesh.visible = !isGlass;
      mesh.matrixAutoUpdate = false;
      mesh.layers.set(isGlass ? LAYER.glass : LAYER.surfaces);
      mesh.renderOrder = isGlass ? 10 + pass : 0;
      return mesh;
    });
    this.group.add(...meshes);
    return { batch, geometry, meshes };
  }

  /**
   * Makes the shaders ready one after another, and draws with each from then on: textures, reflections, glass. `shown` is called
   * after each; without it nothing is waited for.
   */
  async refine(renderer: WebGLRenderer, camera: Camera, shown: (() => void) | null): Promise<void> {
    const trial = new Scene();
    const canWait = renderer.extensions.has('KHR_parallel_shader_compile');
    for (const { batch, meshes, geometry } of this.parts) {
      if (batch.kind === 'plain' && batch.texture < 0) continue;
      for (const [pass, mesh] of meshes.entries()) {
        const material = this.materials.of(batch, pass as 0 | 1);
        const isNew = shown !== null && !this.#ready.has(material);
        this.#ready.add(material);
        trial.clear().add(new Mesh(geometry, material));
        // Without the extension, which three.js would complain of, it is made when it is first drawn with.
        if (isNew && canWait) await renderer.compileAsync(trial, camera);
        mesh.material = material;
        mesh.visible = true;
        // Between two shaders that take long the page stays alive.
        if (isNew) await nextFrame(shown);
      }
    }
    this.isFine = true;
  }

  /** Light of vertices is new: it is mixed when there is time. */
  remix(ranges?: readonly Range[]): void {
    const changed = ranges ? this.#lit.filter((i) => ranges.some((r) => this.#touches(i, r))) : this.#lit;
    for (const i of changed) {
      this.#waiting.light.add(i);
      if (this.hasSecond) this.#waiting.light2.add(i);
    }
  }

  #touches(chunk: number, { first, end }: Range): boolean {
    const { first_vertex, vertices } = this.data.header.chunks[chunk]!;
    return first < first_vertex + vertices && end > first_vertex;
  }

  /** Gives every vertex a second light, for what is compared, or takes it away. */
  setSecond(is: boolean): void {
    if (is === this.hasSecond) return;
    this.hasSecond = is;
    this.#waiting.light2.clear();
    for (const { geometry, batch } of this.parts) {
      setLight(geometry, 'light2', is ? lightAttribute(batch.vertices) : lightOf(geometry, 'light'));
    }
    if (is) this.#lit.forEach((i) => this.#waiting.light2.add(i));
  }

  get isWaiting(): boolean {
    return this.#waiting.light.size + this.#waiting.light2.size > 0;
  }

  /** Mixes waiting light for some milliseconds; true if there was any. */
  work(own: Mix, second: Mix | null, milliseconds: number): boolean {
    const end = performance.now() + milliseconds;
    const did = this.isWaiting;
    this.#mixWaiting('light', own, end);
    if (second) this.#mixWaiting('light2', second, end);
    else this.#waiting.light2.clear();
    return did;
  }

  #mixWaiting(name: 'light' | 'light2', how: Mix, end: number): void {
    const waiting = this.#waiting[name];
    for (const i of waiting) {
      if (performance.now() > end) return;
      waiting.delete(i);
      const { first_vertex, vertices } = this.data.header.chunks[i]!;
      const { batch, firstVertex } = this.slots[i]!;
      const attribute = lightOf(this.parts[batch]!.geometry, name);
      mix(how, first_vertex, vertices, attribute.array as Uint32Array, firstVertex);
      attribute.addUpdateRange(WORDS * firstVertex, WORDS * vertices);
      attribute.needsUpdate = true;
    }
  }

  /** The mixed light of a chunk's vertex, as three words from the place returned. */
  wordsOf(chunk: number, vertex: number, name: 'light' | 'light2' = 'light'): { words: Uint32Array; at: number } {
    const { batch, firstVertex } = this.slots[chunk]!;
    const { first_vertex } = this.data.header.chunks[chunk]!;
    const words = lightOf(this.parts[batch]!.geometry, name).array as Uint32Array;
    return { words, at: WORDS * (firstVertex + vertex - first_vertex) };
  }

  dispose(): void {
    this.parts.forEach(({ geometry }) => geometry.dispose());
    this.materials.dispose();
    Object.values(this.#tables).forEach(({ value }) => value.dispose());
    this.group.removeFromParent();
  }
}

const nextFrame = (call: () => void): Promise<void> => new Promise((resolve) => setTimeout(() => {
  call();
  resolve();
}, 20));

const lightOf = (geometry: BufferGeometry, name: string): BufferAttribute => geometry.getAttribute(name) as BufferAttribute;

function chunkTable({ header }: MeshData): Texture {
  return table(header.chunks.flatMap(({ min, step, finish, lit }) => [[...min, finish], [...step, lit ? 1 : 0]]));
}

function finishTable(finishes: Finish[]): Texture {
  return table(finishes.flatMap(({ diffuse, mirror, gloss, coat, luminance_cd_m2: own, glass }) => [
    [...diffuse, 0],
    [...mirror, gloss?.alpha ?? 1],
    [...(gloss?.f0 ?? [0, 0, 0]), coat?.cover ?? 0],
    [...own, coat?.alpha ?? 1],
    [...(glass?.transmittance ?? [0, 0, 0]), glass?.ior ?? 1],
  ]));
}
