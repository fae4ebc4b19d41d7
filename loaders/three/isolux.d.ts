import type { Camera, Color, Intersection, Mesh, Object3D } from 'three';
import type { GLTF, GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';

/** What a map says of a place. Null: not known. */
export interface Reading {
  /** Name of the shape in the scene. */
  shape: string;
  /** In the axes of the scene as written, m. */
  position: [number, number, number];
  normal: [number, number, number];
  illuminance_lx: number;
  standard_error_lx: number | null;
  /** Null while groups are dimmed. */
  direct_lx: number | null;
  rgb_lx: [number, number, number];
}

export interface Limits {
  low: number;
  high: number;
}

export class IlluminationMap {
  constructor(gltf: GLTF, name?: string);
  readonly scene: Object3D;
  readonly cameras: Camera[];
  /** Groups that can be dimmed; none in files without them. */
  readonly groups: string[];
  level(group: string): number;
  /** 1 is the light as in the file, 0 is off. */
  setLevel(group: string, level: number): void;
  setLevels(levels: Record<string, number>): void;
  mode: 'seen' | 'illuminance' | 'error';
  /** m2/cd. */
  exposure: number;
  /** Ends of the scale of false colours, lx. */
  limits: Limits;
  readAt(hit: Intersection): Reading | null;
  readVertex(mesh: Mesh, vertex: number): Reading | null;
  dispose(): void;
}

export function loadIlluminationMap(source: string | ArrayBuffer, loader?: GLTFLoader): Promise<IlluminationMap>;

/** A colour of the scale, 0 to 1. */
export function falseColour(share: number): Color;
