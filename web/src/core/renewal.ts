// Follows a run: fetches the newest mesh and light, one at a time.

import type { Source } from '../contract';
import type { LiveState } from '../wire';
import type { World } from './worlds';

/** After a failure it is tried again after so long, ms. */
const AGAIN_MS = 3000;

export class Renewal {
  #wanted: LiveState | null = null;
  #last: LiveState | null = null;
  #isBusy = false;
  #hasFailed = false;

  /** `swapped` after there is another mesh, `patched` after there is newer light. */
  constructor(
    readonly source: Source, readonly worlds: readonly World[], readonly swapped: () => void, readonly patched: () => void, readonly failed: (message: string) => void,
  ) {}

  /** Fetches what there is at first. */
  async loadAll(meshes: Promise<ArrayBuffer>[]): Promise<void> {
    const loaded = await Promise.all(this.worlds.map((world, i) => world.load(this.source, meshes[i])));
    if (loaded.some((is) => is)) this.swapped();
  }

  refresh(state: LiveState): void {
    this.#wanted = state;
    if (!this.#isBusy) void this.#work();
  }

  async #work(): Promise<void> {
    this.#isBusy = true;
    try {
      while (this.#wanted) {
        const state = this.#wanted;
        this.#wanted = null;
        this.#last = state;
        await this.#fetch(state);
      }
      this.#hasFailed = false;
    } catch (error) {
      // It is told once, and tried again.
      if (!this.#hasFailed) this.failed(`New light could not be fetched: ${error instanceof Error ? error.message : String(error)}`);
      this.#hasFailed = true;
      setTimeout(() => this.refresh(this.#wanted ?? this.#last!), AGAIN_MS);
    } finally {
      this.#isBusy = false;
    }
  }

  async #fetch({ mesh, light }: LiveState): Promise<void> {
    const world = this.worlds[0]!;
    const { model } = world;
    if (mesh === 0) return;
    if (!model || model.data.header.mesh !== mesh) {
      if (await world.load(this.source)) this.swapped();
    } else if (light !== model.light.version && (await world.renew(this.source))) this.patched();
  }
}
