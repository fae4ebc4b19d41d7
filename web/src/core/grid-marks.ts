// Calculation grids as points with their lux.

import { Vector3 } from 'three';
import type { Source } from '../contract';
import type { GridTable } from '../wire';
import type { Parts } from './parts';
import { numberText } from './labels';
import { colourOf } from './scale';

export class GridMarks {
  #tables: Promise<GridTable[]> | null = null;
  #known: GridTable[] = [];

  constructor(readonly source: Source, readonly parts: Parts, readonly changed: () => void) {
    // A new scale has other colours.
    parts.events.on('legend', () => this.#mark());
  }

  tables(): Promise<GridTable[]> {
    this.#tables ??= this.source.grids(0).then((tables) => (this.#known = tables));
    // One that failed can be asked for again.
    this.#tables.catch(() => (this.#tables = null));
    return this.#tables;
  }

  /** Settings have changed. */
  update(): void {
    if (this.parts.settings.grids && this.#known.length === 0) {
      this.tables().then(() => {
        this.#mark();
        this.changed();
      }, () => {});
    }
    this.#mark();
  }

  #mark(): void {
    const { marks, settings, shown, worlds } = this.parts;
    if (!settings.grids) {
      marks.grids = [];
      return;
    }
    const { origin } = worlds[0]!.scene;
    const scale = shown.illuminanceScale(worlds[0]!.model, settings);
    const codes = shown.codes({ ...settings, mode: 'illuminance' });
    marks.grids = this.#known.flatMap(({ points, illuminance_lx }) => points.map((p, i) => {
      const lux = illuminance_lx[i] ?? null;
      return {
        at: new Vector3(p[0] - origin[0], p[1] - origin[1], p[2] - origin[2]),
        text: lux === null ? '–' : numberText(lux), colour: lux === null ? '#777' : colourOf(lux, scale, codes),
      };
    }));
  }
}
