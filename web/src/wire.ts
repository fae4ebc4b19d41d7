// What the page is given: the words between it and `isolux view`, `isolux solve --live` and exported files.
//
// A *container* is bytes: the magic "ISOWALK1", the length of the header as an unsigned 32-bit number, four zero bytes, the header as
// JSON, and then sections of numbers. A section begins at a multiple of eight bytes after the end of the padded header (the header is padded
// with spaces to a multiple of eight). All numbers are little-endian. Coordinates are those of the scene as written, in metres, less `origin`.
// Illuminance is in lux, luminance in cd/m2. Colours are linear Rec. 709.

export const MAGIC = 'ISOWALK1';

/** Where an array of numbers lies: offset in bytes from the end of the header, and the count of numbers. */
export interface Section {
  offset: number;
  count: number;
  type: 'u8' | 'i8' | 'u16' | 'u32' | 'f32';
}

export type Vec3 = [number, number, number];

/** How one side of a material reflects and emits. */
export interface Finish {
  /** Name of the material. */
  material: string;
  diffuse: Vec3;
  /** Index into `textures`; its values multiply `diffuse`. */
  texture: number | null;
  mirror: Vec3;
  gloss: { f0: Vec3; alpha: number } | null;
  coat: { cover: number; alpha: number } | null;
  luminance_cd_m2: Vec3;
  /** Glass; all else is black then. */
  glass: { ior: number; transmittance: Vec3; thin: boolean } | null;
}

/** A texture of linear colours, coded as sRGB in a PNG. */
export interface Texture {
  width: number;
  height: number;
  /** The bytes of the PNG. */
  png: Section;
}

/** A luminaire that is not a surface. */
export interface Luminaire {
  name: string;
  /** Index into `groups`. */
  group: number;
  /** Chromaticity, luminance 1. */
  colour: Vec3;
  kind: 'point' | 'directional' | 'sky';
  /** Where it is; of parallel light nothing. */
  position: Vec3 | null;
  /** Where parallel light goes, or the way that the luminaire faces. */
  direction: Vec3;
  /** The way of C 0 of its photometric solid, at right angles to `direction`. */
  c0: Vec3;
  luminous_flux_lm: number | null;
  illuminance_lx: number | null;
  /** Greatest luminous intensity, cd. */
  peak_cd: number | null;
  /** Index into `solids`: luminaires of one kind share a photometric solid. */
  solid: number | null;
  /** What it shines from: half of the extent along C0, across it, and along `direction`, m; null of a point. */
  area: { shape: 'box' | 'cylinder_x' | 'cylinder_y' | 'cylinder_z' | 'ellipsoid'; half_m: Vec3 } | null;
}

/** A photometric solid in the frame of the luminaire in the scene: intensity over its peak, along unit vectors. */
export interface Solid {
  /** `rows` x `columns` values from 0 to 1: rows from nadir (gamma 0) to zenith (180 degrees), columns around (C 0 to 360, both ends). */
  rows: number;
  columns: number;
  values: number[];
}

/** What is seen beyond the scene: luminances in codes of RGB9E5 (u32), rows from the zenith, columns from north by east. */
export interface Sky {
  /** Index into `groups`. */
  group: number;
  width: number;
  height: number;
  codes: Section;
  /** Directions of its frame in the scene. */
  east: Vec3;
  north: Vec3;
  zenith: Vec3;
}

/** A disc infinitely far away. */
export interface Sun {
  /** Index into `groups`. */
  group: number;
  towards: Vec3;
  /** Of the angle from its middle to its rim. */
  cosine: number;
  luminance_cd_m2: Vec3;
}

export interface Camera {
  name: string;
  position: Vec3;
  direction: Vec3;
  up: Vec3;
  vertical_fov_deg: number;
}

/** A tone operator as a table: what `render` does, sampled. */
export interface ToneTable {
  /** `linear`, `reinhard`, `hable`, `ward`, `tumblin-rushmeier`. */
  name: string;
  label: string;
  /** Whether it acts on luminance, colours kept, or on each channel. */
  on: 'luminance' | 'channels';
  /** Base-2 logarithms of the luminance of white, cd/m2, of the rows; one row where it does not matter. */
  whites: { first: number; step: number; count: number };
  /** Base-2 logarithms of the exposed luminance of the columns. */
  exposed: { first: number; step: number; count: number };
  /** Base-2 logarithms of what the display emits, row after row (f32); it is linear between them, and goes on at both ends. Above 0 it is cut off. */
  values: Section;
}

/** The header of the container of a scene. */
export interface SceneHeader {
  kind: 'scene';
  /** Name of the scene. */
  name: string;
  /** File name of the map. */
  file: string;
  up: Vec3;
  /** Added to coordinates gives those of the scene as written. */
  origin: Vec3;
  bounds: { min: Vec3; max: Vec3 };
  shapes: string[];
  finishes: Finish[];
  textures: Texture[];
  luminaires: Luminaire[];
  solids: Solid[];
  sky: Sky | null;
  sun: Sun | null;
  groups: string[];
  cameras: Camera[];
  /** Lines of text about the map: `method`, `error`, `seed` and so on, as `isolux info` has them. */
  about: [string, string][];
  /** The luminance that `render` would show as 1 from the first camera, cd/m2: what to start with. */
  white_cd_m2: number;
  /** The light of the luminaires of each layer, lm in three channels: eyes adapt to the colour of their sum. */
  light_lm: Vec3[];
  tones: ToneTable[];
  /** Colour maps by name: 256 x 3 codes of sRGB (u8). */
  colour_maps: { name: string; codes: Section }[];
  /** Round limits of a linear scale over the illuminances of the map, lx. */
  scale_lx: { low: number; high: number };
  /** Whether the light can be dimmed by groups, and how layers of light belong to them. */
  layers: string[];
  /** What is compared with this map: the name of the file, if `light` has a second set of values. */
  other: string | null;
}

/** Triangles of one side of one shape, with vertices of their own. Indices count from `first_vertex`. */
export interface Chunk {
  shape: number;
  finish: number;
  back: boolean;
  /** Whether its vertices have light. */
  lit: boolean;
  first_vertex: number;
  vertices: number;
  first_index: number;
  indices: number;
  /** A position is `min` + `step` times three numbers of `positions`. */
  min: Vec3;
  step: Vec3;
  /** First vertex in `uvs`, for chunks with a texture. */
  first_uv: number | null;
}

/** The header of the container of a mesh: the elements of the map, and surfaces without. */
export interface MeshHeader {
  kind: 'mesh';
  /** Which mesh; another number is another mesh. */
  mesh: number;
  chunks: Chunk[];
  /** u16, three a vertex. */
  positions: Section;
  /** i8, two a vertex: octahedral normals (Cigolla et al. 2014), -127 to 127. */
  normals: Section;
  /** u16 or u32, three a triangle. Chunks have at most 65,536 vertices. */
  indices: Section;
  /** f32, two a vertex, for textured chunks. */
  uvs: Section;
  /** Vertices with light come first; so many. */
  lit_vertices: number;
  /** Triangles of the elements, and all. */
  triangles: number;
}

/** The light of one layer (all of it, or a group of luminaires undimmed). */
export interface LightLayer {
  /** u32, one a vertex in the format of shared exponents, RGB9E5 (EXT_texture_shared_exponent), lx. */
  direct: Section;
  indirect: Section;
}

/**
 * The header of the container of light: some blocks of vertices with values that are new. A section holds the values of
 * the blocks one after another; block b is the vertices from b * block_size, the last one may be shorter.
 */
export interface LightHeader {
  kind: 'light';
  mesh: number;
  /** Version of these values; ask for those since then. */
  version: number;
  block_size: number;
  blocks: number[];
  layers: LightLayer[];
  /** u16: standard error as a half float, lx; infinite where it is not known, not a number where the light is not known. */
  standard_error: Section;
  /** The values of the map that this one is compared with, at the same vertices. */
  other: LightLayer | null;
  other_standard_error: Section | null;
}

export type Finding = 'probe' | 'vertices';

/** What is known of a place of a surface. */
export interface Reading {
  /** Place in the coordinates of the scene as written, and the normal of the side that is seen; null: nothing was hit. */
  position: Vec3 | null;
  normal: Vec3 | null;
  shape: string;
  material: string;
  /** Share of light, luminance-weighted, that is reflected diffusely. */
  diffuse_reflectance: number | null;
  illuminance_lx: number | null;
  standard_error_lx: number | null;
  direct_lx: number | null;
  indirect_lx: number | null;
  rgb_lx: Vec3 | null;
  /** Of diffusely reflected and own light, cd/m2. */
  luminance_cd_m2: number | null;
  /** `probe`: direct light afresh, what `isolux probe` says; `vertices`: interpolated between vertices. */
  found: Finding;
}

/** A ray: what is under the pointer. Origin in coordinates of the scene as written. */
export interface RayAsked {
  origin: Vec3;
  direction: Vec3;
}

export interface GridTable {
  name: string;
  corner: Vec3;
  u: Vec3;
  v: Vec3;
  columns: number;
  rows: number;
  /** The share of the initial light that is left when the installation is maintained; values are maintained ones. */
  maintenance_factor: number;
  /** Positions of the points, row after row. */
  points: Vec3[];
  illuminance_lx: (number | null)[];
  standard_error_lx: (number | null)[];
  /** Em, Emin, Emax, U0, Ud with their intervals of 95 %, as `isolux grid` has them; the unit is `lx` or nothing. None: nothing is known. */
  figures: { name: string; value: number; low: number; high: number; unit: string }[];
}

/** What a page begins with. */
export interface Hello {
  /** Version of isolux. */
  version: string;
  /** One or two maps. */
  worlds: { name: string; file: string }[];
  /** Whether a run is under way. */
  live: boolean;
  /** Whether readings are those of `probe`. */
  readings: Finding;
}

export type Phase = 'starting' | 'elements' | 'increments' | 'audit' | 'done' | 'stopped' | 'failed';

/** A state of a run, sent whenever it changes, some times a second at most. */
export interface LiveState {
  /** Counts states; one that joins late gets the newest. */
  number: number;
  phase: Phase;
  paused: boolean;
  method: string;
  elapsed_s: number;
  increments: number;
  rays: number;
  rays_per_s: number;
  receivers: number;
  error: number | null;
  error_statistical: number | null;
  error_elements: number | null;
  target: number | null;
  /** Share of the light's detail that the filter has taken off; null where it is not known or there is none. */
  filtered_share: number | null;
  unshot: number | null;
  prediction: { finish_s: number; earliest_s: number; latest_s: number } | null;
  audit: { error: number; low: number; high: number; told: number; places: number; contradicts: boolean } | null;
  /** What `light` and `mesh` can be fetched now. Mesh 0: none yet. */
  mesh: number;
  light: number;
  /** File written, once the run has ended. */
  saved: string | null;
  /** Something to tell: why it failed, or how it ended. */
  message: string | null;
}

/** All errors told so far: `[elapsed_s, error]`; sent before the first state. */
export type ErrorHistory = [number, number][];

export type Control =
  | { action: 'pause' }
  | { action: 'resume' }
  | { action: 'stop' }
  | { action: 'target'; accuracy: number };
