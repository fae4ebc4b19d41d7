// What a viewer is made of.

import type { Vector3, WebGLRenderer } from 'three';
import type { Settings } from '../contract';
import type { Emitter } from './emitter';
import type { Quality } from './graphics';
import type { Luminaires } from './luminaires';
import type { Marks } from './marks';
import type { Navigation } from './navigation';
import type { Shown } from './shown';
import type { Uniforms } from './uniforms';
import type { World } from './worlds';

export type EventName = 'view' | 'settings' | 'light' | 'exposure' | 'legend' | 'navigation' | 'graphics';

export interface Parts {
  renderer: WebGLRenderer;
  uniforms: Uniforms;
  quality: Quality;
  navigation: Navigation;
  shown: Shown;
  marks: Marks;
  luminaires: Luminaires;
  worlds: World[];
  events: Emitter<EventName>;
  settings: Settings;
  white: number;
  canvas: HTMLCanvasElement;
  /** Whether something is in the way; asked for marks. */
  hidden: () => (at: Vector3) => boolean;
}
