// Readings: what is under a place of the picture.

import { Vector2, Vector3, Raycaster } from 'three';
import type { MeshBVH } from 'three-mesh-bvh';
import type { Settings, Source } from '../contract';
import type { RayAsked, Reading, Vec3 } from '../wire';
import { buildBvh, MOST_FOR_SERVER } from './bvh';
import type { Model } from './model';
import type { Navigation } from './navigation';
import { castRay, nothingHit, readingOf, type Hit } from './pick';
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

  /** Whether a place of the picture shows the second map. */
  #isOther(x: number): boolean {
    const { compare, split } = this.settings();
    return compare === 'maps' && this.source.hello.worlds.length > 1 && x > split * this.canvas.clientWidth;
  }

  /** Nothing of the second map, whose vertices are not kept for that. */
  glanceAt(x: number, y: number): Reading | null {
    if (this.#isOther(x)) return null;
    const hit = this.#cast(...this.#ray(x, y));
    return hit && this.#model ? readingOf(this.#model, this.world.scene, hit) : null;
  }

  async readAt(x: number, y: number, signal: AbortSignal): Promise<Reading | null> {
    const ray = this.#ray(x, y);
    if (!this.#asksServer) return this.glanceAt(x, y);
    const [reading] = await this.#read([ray], signal, this.#isOther(x) ? 1 : 0);
    return reading?.position ? reading : null;
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
  async #read(rays: [Vector3, Vector3][], signal: AbortSignal, world: 0 | 1 = 0): Promise<Reading[]> {
    const factors = world === 0 ? this.settings().dimming : [];
    if (factors.length > 0 && factors.every((factor) => factor === 0)) return rays.map((ray) => this.#glance(ray));
    const dimming = factors.every((factor) => factor === 1) ? [] : factors;
    return this.source.read(world, rays.map((ray) => this.#asked(...ray)), dimming, signal);
  }

  #glance(ray: [Vector3, Vector3]): Reading {
    const hit = this.#cast(...ray);
    return hit && this.#model ? readingOf(this.#model, this.world.scene, hit) : nothingHit();
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
