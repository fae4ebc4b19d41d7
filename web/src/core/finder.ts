// Readings: what is under a place of the picture.

import { Vector2, Vector3, Raycaster } from 'three';
import type { MeshBVH } from 'three-mesh-bvh';
import type { Both, Settings, Source, Whose } from '../contract';
import type { RayAsked, Reading, Vec3 } from '../wire';
import { buildBvh, MOST_FOR_SERVER } from './bvh';
import type { Model } from './model';
import type { Navigation } from './navigation';
import { castRay, nothingHit, readingOf, type Hit } from './pick';
import { comparedWith, whoseAt } from './whose';
import type { World } from './worlds';

const SECTION_RAYS = 64;
/** The line of a section lies so far off its surface, m. */
const OFF = 0.004;

export class Finder {
  #bvh: MeshBVH | null = null;
  #model: Model | null = null;
  #building: AbortController | null = null;

  constructor(
    readonly source: Source, readonly world: World, readonly navigation: Navigation, readonly canvas: HTMLCanvasElement, readonly settings: () => Readonly<Settings>,
    readonly built: (bvh: MeshBVH) => void,
  ) {}

  /** Builds the tree of triangles of the mesh that is shown, unless a server can be asked instead. */
  async build(): Promise<void> {
    const { model } = this.world;
    if (!model || model === this.#model) return;
    if (model.data === this.#model?.data) {
      // The same triangles on another graphics card.
      this.#model = model;
      if (this.#bvh) return;
    }
    this.#building?.abort();
    const { signal } = (this.#building = new AbortController());
    this.#bvh = null;
    this.#model = model;
    if (this.#asksServer && model.data.header.triangles > MOST_FOR_SERVER) return;
    const bvh = await buildBvh(model.data, signal);
    if (!bvh || signal.aborted) return;
    this.#bvh = bvh;
    this.built(bvh);
  }

  get #asksServer(): boolean {
    return this.source.hello.readings === 'probe';
  }

  inScene(position: Vec3): Vector3 {
    return new Vector3(...position.map((c, k) => c - this.world.scene.origin[k]!));
  }

  direction(normal: Vec3): Vector3 {
    return new Vector3(...normal).normalize();
  }

  /** Whose light the picture shows there. */
  whoseAt(x: number): Whose {
    return whoseAt(this.settings(), this.source.hello.worlds.length > 1, x / this.canvas.clientWidth);
  }

  /** What vertices tell at once; nothing of a second map with other surfaces. */
  glanceAt(x: number, y: number, whose: Whose = this.whoseAt(x)): Reading | null {
    const hit = this.#cast(...this.#ray(x, y));
    return hit && this.#between(hit, whose);
  }

  glanceBothAt(x: number, y: number): Both | null {
    const hit = this.#cast(...this.#ray(x, y));
    const [own, other] = [hit && this.#between(hit, 'own'), hit && this.#between(hit, this.#compared)];
    return own && other && { own, other };
  }

  #between(hit: Hit, whose: Whose): Reading | null {
    const model = this.#model;
    if (!model) return null;
    if (whose === 'own') return readingOf(model, this.world.scene, hit);
    return model.hasSecond && whose === this.#compared ? readingOf(model, this.world.scene, hit, 'light2') : null;
  }

  get #compared(): Whose {
    return comparedWith(this.settings(), this.world.scene.other !== null) ?? 'own';
  }

  async readAt(x: number, y: number, signal: AbortSignal): Promise<Reading | null> {
    const ray = this.#ray(x, y);
    if (!this.#asksServer) return this.glanceAt(x, y);
    const [reading] = await this.#read([ray], signal, this.whoseAt(x));
    return reading?.position ? reading : null;
  }

  /** Both sides of a difference, one after the other. */
  async readBothAt(x: number, y: number, signal: AbortSignal): Promise<Both | null> {
    const [ray, compared] = [this.#ray(x, y), this.#compared];
    if (!this.#asksServer || (compared === 'map' && this.source.hello.worlds.length < 2)) return this.glanceBothAt(x, y);
    const [own] = await this.#read([ray], signal, 'own');
    const [other] = own?.position ? await this.#read([ray], signal, compared) : [];
    return own?.position && other?.position ? { own, other } : null;
  }

  #ray(x: number, y: number): [Vector3, Vector3] {
    const at = new Vector2((2 * x) / this.canvas.clientWidth - 1, 1 - (2 * y) / this.canvas.clientHeight);
    const caster = new Raycaster();
    caster.setFromCamera(at, this.navigation.camera);
    return [this.navigation.camera.position.clone(), caster.ray.direction.clone()];
  }

  #cast(origin: Vector3, direction: Vector3): Hit | null {
    return this.#bvh && this.#model && this.#model === this.world.model ? castRay(this.#bvh, this.#model, origin, direction) : null;
  }

  #asked(origin: Vector3, direction: Vector3): RayAsked {
    const { origin: off } = this.world.scene;
    return { origin: origin.toArray().map((c, k) => c + off[k]!) as Vec3, direction: direction.toArray() as Vec3 };
  }

  /** Readings along a line of the picture, and the line that they make on the surfaces. */
  async section([x0, y0]: [number, number], [x1, y1]: [number, number], signal: AbortSignal): Promise<{ readings: { at: number; reading: Reading }[]; line: (Vector3 | null)[] }> {
    const rays = Array.from({ length: SECTION_RAYS }, (_, i) => {
      const t = i / (SECTION_RAYS - 1);
      return this.#ray(x0 + t * (x1 - x0), y0 + t * (y1 - y0));
    });
    const all = this.#asksServer ? await this.#read(rays, signal) : rays.map((ray) => this.#glance(ray));
    signal.throwIfAborted();
    return { readings: measured(all), line: all.map((r) => (r.position ? this.inScene(r.position).addScaledVector(this.direction(r.normal ?? [0, 0, 0]), OFF) : null)) };
  }

  /** What the server reads in the light as it is dimmed; where that leaves no light, what the vertices tell. */
  async #read(rays: [Vector3, Vector3][], signal: AbortSignal, whose: Whose = 'own'): Promise<Reading[]> {
    const { dimming: own, otherDimming } = this.settings();
    const factors = { own, dimming: otherDimming, map: [] }[whose];
    if (factors.length > 0 && factors.every((factor) => factor === 0)) return rays.map((ray) => this.#glance(ray, whose));
    const dimming = factors.every((factor) => factor === 1) ? [] : factors;
    return this.source.read(whose === 'map' ? 1 : 0, rays.map((ray) => this.#asked(...ray)), dimming, signal);
  }

  #glance(ray: [Vector3, Vector3], whose: Whose = 'own'): Reading {
    const hit = this.#cast(...ray);
    return (hit && this.#between(hit, whose)) ?? nothingHit();
  }

  /** Whether something is between the eye and a place. */
  hidden(): (at: Vector3) => boolean {
    const eye = this.navigation.camera.position.clone();
    return (at) => {
      const way = at.clone().sub(eye);
      const hit = this.#cast(eye, way);
      return hit !== null && hit.distance < way.length() - 0.01;
    };
  }
}

/** Each reading with its way along the line from the first place, m; where nothing was hit it does not grow. */
function measured(all: Reading[]): { at: number; reading: Reading }[] {
  let [at, before]: [number, Vec3 | null] = [0, null];
  return all.map((reading) => {
    if (reading.position && before) at += Math.hypot(...reading.position.map((c, k) => c - before![k]!));
    before = reading.position ?? before;
    return { at, reading };
  });
}
