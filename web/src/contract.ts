// The two halves of the page, and what each knows of the other: `core/` draws and reads the world, `ui/` is what people press.

import type {
  Control, ErrorHistory, Finding, GridTable, Hello, LiveState, Reading, RayAsked, SceneHeader, Vec3,
} from './wire';

/** Where the bytes come from: a server, or the file itself. Made by `core/source.ts`: `openSource(): Promise<Source>`. */
export interface Source {
  hello: Hello;
  /** Containers as bytes. */
  scene(world: number): Promise<ArrayBuffer>;
  mesh(world: number): Promise<ArrayBuffer>;
  light(world: number, mesh: number, since: number): Promise<ArrayBuffer>;
  /**
   * Readings along rays, only where `hello.readings` is `probe`; with each layer of light dimmed, if `dimming` holds a factor for each. A new
   * request ends the one before (AbortSignal).
   */
  read(world: number, rays: RayAsked[], dimming: number[], signal: AbortSignal): Promise<Reading[]>;
  grids(world: number): Promise<GridTable[]>;
  control(what: Control): Promise<void>;
  /** Follows a run: calls back with every state; reconnects by itself and says whether it is connected. */
  follow(on: { state(s: LiveState): void; history(h: ErrorHistory): void; connected(is: boolean): void }): void;
}

/** What is shown. */
export type Mode =
  | 'seen'          // tone-mapped luminance
  | 'illuminance'   // false colour, lx
  | 'luminance'     // false colour, cd/m2
  | 'direct'        // false colour, lx
  | 'indirect'      // false colour, lx
  | 'error'         // standard error in false colour, lx
  | 'relative'      // standard error over illuminance, false colour, per cent
  | 'difference';   // this map less the other, diverging colours, lx

export interface Settings {
  mode: Mode;
  /** Name of a tone operator of the scene. */
  tone: string;
  /** Automatic exposure: log-average of the picture is middle grey, as `render` does it. */
  autoExposure: boolean;
  /** Exposure value at ISO 100 (white = 1.2 x 2^EV cd/m2), where it is not automatic. */
  ev100: number;
  colourMap: string;
  /** Limits of false colour in the unit of the mode; null: automatic (round numbers about the picture or the map). */
  limits: { low: number; high: number } | null;
  logarithmic: boolean;
  /** Edges of elements. */
  mesh: boolean;
  /** Isolux lines with labels, over any mode. */
  contours: boolean;
  /** Markers of luminaires: `off`, `points` (as what they are), `solids` (photometric solids). */
  luminaires: 'off' | 'points' | 'solids';
  /** Calculation grids as points with their lux. */
  grids: boolean;
  /** Factor for each layer of light, 0 to 2. */
  dimming: number[];
  /** The same for the right half, when two dimmings are compared. */
  otherDimming: number[];
  /** What is compared left and right of the slider. */
  compare: 'off' | 'maps' | 'dimmings';
  /** Where the slider is, 0 to 1. */
  split: number;
  quality: 'auto' | 'low' | 'high';
}

/** Whose light is meant where two are compared: that of the map as it is dimmed, of the other map, or of the other dimming. */
export type Whose = 'own' | 'map' | 'dimming';

/** What a difference is made of, at one place. */
export interface Both {
  own: Reading;
  other: Reading;
}

export interface View {
  position: Vec3;
  target: Vec3;
  fovDeg: number;
}

/** A false-colour scale as shown now, for the legend. */
export interface Legend {
  low: number;
  high: number;
  ticks: number[];
  unit: 'lx' | 'cd/m²' | '%';
  logarithmic: boolean;
  /** CSS colours from low to high. */
  colours: string[];
}

/** Made by `core/viewer.ts`: `createViewer(canvas: HTMLCanvasElement, overlay: HTMLElement, source: Source): Promise<Viewer>`. */
export interface Viewer {
  scene: SceneHeader;
  /** Of the second map, when two are shown. */
  otherScene: SceneHeader | null;
  settings: Readonly<Settings>;
  set(change: Partial<Settings>): void;
  view(): View;
  goTo(view: View, animate: boolean): void;
  goToCamera(index: number, animate: boolean): void;
  /** All of the scene in sight. */
  frame(animate: boolean): void;
  navigation: 'orbit' | 'walk';
  /** Walking: pointer lock with WASD and arrow keys, Shift for speed, Q/E or Page up/down for height; touch: left half moves, right half looks. Collides. */
  setNavigation(how: 'orbit' | 'walk'): void;
  /** Whose light is seen at a point of the canvas. */
  whoseAt(x: number): Whose;
  /** The reading under a point of the canvas (CSS pixels) of the light that is seen there: from the server, or interpolated. */
  readAt(x: number, y: number, signal: AbortSignal): Promise<Reading | null>;
  /** Interpolated between vertices at once, without asking anybody; of the light that is seen there, or of that which is meant. */
  glanceAt(x: number, y: number, whose?: Whose): Reading | null;
  /** The same of both sides of a difference. */
  readBothAt(x: number, y: number, signal: AbortSignal): Promise<Both | null>;
  glanceBothAt(x: number, y: number): Both | null;
  /** Marks a place with a pin; null takes it away. */
  pin(reading: Reading | null): void;
  /** A section along what is seen between two points of the canvas; draws its line. `at` is the length along the surface from the start, m. */
  section(from: [number, number], to: [number, number], signal: AbortSignal): Promise<{ at: number; reading: Reading }[]>;
  clearSection(): void;
  grids(): Promise<GridTable[]>;
  legend(): Legend | null;
  /** What exposure is in force: luminance shown as 1, cd/m2, and its EV100. */
  exposure(): { whiteCdM2: number; ev100: number };
  /** A PNG of what is shown, with the legend in false colour; `draw` draws more over it, in CSS pixels of the canvas. */
  snapshot(draw?: (context: CanvasRenderingContext2D) => void): Promise<Blob>;
  stats(): { triangles: number; vertices: number; bytes: number; fps: number; found: Finding };
  /** A run has newer light or another mesh: fetch and show it. */
  refresh(state: LiveState): void;
  on(event: 'view' | 'settings' | 'light' | 'exposure' | 'legend' | 'navigation' | 'graphics', call: () => void): void;
  /** Whether the graphics card has been lost, and nothing can be drawn; the event `graphics` tells of changes. */
  isLost(): boolean;
  /** Something went wrong that people must know. */
  onError(call: (message: string) => void): void;
  /** Resolves once the first picture is drawn with light. */
  ready: Promise<void>;
}
