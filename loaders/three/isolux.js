// Reads what `isolux export map.glb -o light.glb --lux` writes (and, without dimming and exposure, map.glb itself):
// a scene whose vertices carry lux.
import { Color, DataTexture, Float32BufferAttribute, LinearFilter, MeshBasicMaterial, SRGBColorSpace, Triangle, Vector3 } from 'three';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';

/** What standard errors say in place of a number: that the light is not known, or its error. */
const UNKNOWN = -1;
const NO_ESTIMATE = -2;
/** Photometric weights of linear Rec. 709. */
const LUMINANCE = [0.2126, 0.7152, 0.0722];
/** Colours of the false-colour scale. */
const STEPS = 256;
/** The texture coordinates that hold the place on that scale: the last set that three.js has. */
const SCALE_CHANNEL = 3;
const SCALE_PLACES = `uv${SCALE_CHANNEL}`;

/**
 * Reads a map from an address or from bytes.
 * @param {string | ArrayBuffer} source
 * @returns {Promise<IlluminationMap>}
 */
export async function loadIlluminationMap(source, loader = new GLTFLoader()) {
  const name = typeof source === 'string' ? source : 'the map';
  const gltf = await (typeof source === 'string' ? loader.loadAsync(source) : loader.parseAsync(source, ''));
  return new IlluminationMap(gltf, name);
}

/** A scene with its light. Quantities are in lux and cd/m2, colours linear Rec. 709, positions those of the scene as written, in metres. */
export class IlluminationMap {
  #surfaces = [];
  #levels;
  #mode = 'seen';
  #exposure;
  #limits;
  #scale;
  #isExposed;

  constructor(gltf, name = 'the map') {
    const { isolux, isolux_vertices: note } = gltf.userData;
    this.scene = gltf.scene;
    this.cameras = gltf.cameras;
    this.groups = note?.groups ?? [];
    this.scene.updateMatrixWorld(true);
    this.scene.traverse((object) => {
      if (object.isMesh && object.geometry.attributes._illuminance_lx) this.#surfaces.push(new Surface(object, this.groups.length));
    });
    if (this.#surfaces.length === 0) {
      const remedy = isolux?.lightmap ? 'it holds texels: solve without --layout texels' : 'write it by `isolux export map.glb -o light.glb --lux`';
      throw new Error(`${name}: no surface carries lux at its vertices; ${remedy}`);
    }
    this.#isExposed = this.#surfaces.every((surface) => surface.reflection);
    this.#exposure = note?.exposure_m2_cd ?? isolux?.preview.exposure_m2_cd ?? 1;
    this.#levels = this.groups.map(() => 1);
    this.#light();
    this.#limits = { low: 0, high: roundUp(this.#surfaces.reduce((most, { lux }) => lux.reduce((a, b) => Math.max(a, b), most), 0)) };
    this.#paint();
  }

  /** What a group is dimmed to: 1 is its light as in the file. */
  level(group) {
    return this.#levels[this.#indexOf(group)];
  }

  /** Dims a group: 0 is off. */
  setLevel(group, level) {
    this.setLevels({ [group]: level });
  }

  /** Dims several groups at once. */
  setLevels(levels) {
    const changes = Object.entries(levels).map(([group, level]) => [this.#indexOf(group), level]);
    for (const [index, level] of changes) {
      if (!(Number.isFinite(level) && level >= 0)) throw new RangeError(`group "${this.groups[index]}": a level is 0 or more, not ${level}`);
    }
    for (const [index, level] of changes) this.#levels[index] = level;
    this.#light();
    this.#paint();
  }

  #indexOf(group) {
    const index = this.groups.indexOf(group);
    if (index >= 0) return index;
    const known = this.groups.length ? `there are ${this.groups.join(', ')}` : 'the file has none: solve with --group and export with --lux';
    throw new Error(`no group "${group}": ${known}`);
  }

  /** 'seen', or in false colour 'illuminance' or 'error'. */
  get mode() {
    return this.#mode;
  }

  set mode(mode) {
    if (!['seen', 'illuminance', 'error'].includes(mode)) throw new RangeError(`no mode "${mode}": there are seen, illuminance, error`);
    this.#mode = mode;
    this.#paint();
  }

  /** What luminances are multiplied by where the map is seen, m2/cd. */
  get exposure() {
    return this.#exposure;
  }

  set exposure(exposure) {
    if (!this.#isExposed) throw new Error('the colours of this file are finished; export it with --lux to expose them');
    if (!(Number.isFinite(exposure) && exposure > 0)) throw new RangeError(`an exposure is above 0, not ${exposure}`);
    this.#exposure = exposure;
    for (const { seen } of this.#surfaces) seen.color.setScalar(exposure);
  }

  /** What the ends of the false-colour scale stand for, lx. */
  get limits() {
    return { ...this.#limits };
  }

  set limits({ low, high }) {
    if (!(low < high)) throw new RangeError(`limits go from a smaller to a larger number, not from ${low} to ${high}`);
    this.#limits = { low, high };
    this.#paint();
  }

  /** What is read where a ray of a `Raycaster` hits; null where the surface carries no light, or where nothing is known. */
  readAt({ object, face, point }) {
    return this.#read(object, () => cornersOf(object, face, point));
  }

  /** The same at a vertex of a mesh. */
  readVertex(mesh, vertex) {
    return this.#read(mesh, () => [[vertex, 1]]);
  }

  #read(object, corners) {
    const surface = this.#surfaces.find(({ mesh }) => mesh === object);
    const isUndimmed = this.#levels.every((level) => level === 1);
    return surface?.read(corners(), isUndimmed) ?? null;
  }

  #light() {
    for (const surface of this.#surfaces) surface.light(this.#levels);
  }

  #paint() {
    if (this.#mode !== 'seen') this.#scale ??= new MeshBasicMaterial({ map: falseColours(), vertexColors: true, toneMapped: false });
    for (const surface of this.#surfaces) {
      if (this.#mode === 'seen') surface.see(this.#exposure);
      else surface.measure(this.#mode, this.#limits, this.#scale);
    }
  }

  /** Frees what the map has on the graphics card. */
  dispose() {
    for (const { mesh, seen } of this.#surfaces) {
      mesh.geometry.dispose();
      seen.map?.dispose();
      seen.dispose();
    }
    this.#scale?.map.dispose();
    this.#scale?.dispose();
  }
}

/** A mesh with light at its vertices. */
class Surface {
  constructor(mesh, groups) {
    const { attributes, userData } = mesh.geometry;
    this.mesh = mesh;
    /** Reflectance and own luminance; of maps that were not exported with lux nothing. */
    this.reflection = userData.reflectance && { reflectance: userData.reflectance, luminance: userData.luminance_cd_m2 };
    this.whole = { rgb: attributes._illuminance_lx, error: attributes._stderr_lx };
    this.direct = attributes._direct_lx;
    this.groups = Array.from({ length: groups }, (_, k) => ({ rgb: attributes[`_group_${k}_lx`], error: attributes[`_group_${k}_stderr_lx`] }));
    const { count } = attributes.position;
    this.rgb = new Float32Array(3 * count);
    this.lux = new Float32Array(count);
    this.error = new Float32Array(count);
    // Meshes of one material have different exposures as long as they are not told the same.
    this.seen = mesh.material.clone();
    this.colours = new Float32BufferAttribute(new Float32Array(3 * count), 3);
    this.finished = attributes.color;
  }

  /** Mixes the light of the groups. */
  light(levels) {
    const { rgb, lux, error, whole } = this;
    const parts = this.groups.length ? this.groups.map((part, k) => ({ ...part, level: levels[k] })) : [{ ...whole, level: 1 }];
    rgb.fill(0);
    error.fill(0);
    for (const { rgb: { array }, level } of parts) {
      for (let k = 0; k < rgb.length; k++) rgb[k] += level * array[k];
    }
    for (let k = 0; k < lux.length; k++) {
      lux[k] = LUMINANCE.reduce((sum, weight, channel) => sum + weight * rgb[3 * k + channel], 0);
      error[k] = whole.error.getX(k) === UNKNOWN ? UNKNOWN : mixedError(parts, k);
    }
  }

  see(exposure) {
    const { mesh, seen, reflection, rgb } = this;
    mesh.material = seen;
    if (!reflection) {
      mesh.geometry.setAttribute('color', this.finished);
      return;
    }
    const { reflectance, luminance } = reflection;
    const { array } = this.colours;
    for (let k = 0; k < array.length; k++) array[k] = (reflectance[k % 3] * rgb[k]) / Math.PI + luminance[k % 3];
    seen.color.setScalar(exposure);
    this.#colour();
  }

  /** Elements are known or not as a whole, so that no colour of what is known runs into black. */
  measure(mode, { low, high }, material) {
    const { mesh, lux, error } = this;
    const values = mode === 'error' ? error : lux;
    const places = mesh.geometry.getAttribute(SCALE_PLACES) ?? new Float32BufferAttribute(new Float32Array(2 * lux.length).fill(0.5), 2);
    for (let k = 0; k < values.length; k++) {
      // From the middle of the first colour to that of the last.
      places.array[2 * k] = (0.5 + ((STEPS - 1) * (values[k] - low)) / (high - low)) / STEPS;
      this.colours.array.fill(error[k] === UNKNOWN || values[k] < 0 ? 0 : 1, 3 * k, 3 * k + 3);
    }
    places.needsUpdate = true;
    mesh.geometry.setAttribute(SCALE_PLACES, places);
    mesh.material = material;
    this.#colour();
  }

  #colour() {
    this.colours.needsUpdate = true;
    this.mesh.geometry.setAttribute('color', this.colours);
  }

  /** Means over vertices with weights; those of unknown light are left out. */
  read(corners, isUndimmed) {
    const known = corners.filter(([vertex]) => this.error[vertex] !== UNKNOWN);
    const all = total(known, () => 1);
    if (!(all > 0)) return null;
    const mean = (of) => total(known, of) / all;
    const rgb_lx = [0, 1, 2].map((channel) => mean((vertex) => this.rgb[3 * vertex + channel]));
    const direct_lx = [0, 1, 2].map((channel) => mean((vertex) => this.direct.getComponent(vertex, channel)));
    const hasError = known.every(([vertex]) => this.error[vertex] !== NO_ESTIMATE);
    const { position, normal } = this.mesh.geometry.attributes;
    const place = (attribute) => [0, 1, 2].map((axis) => total(corners, (vertex) => attribute.getComponent(vertex, axis)) / total(corners, () => 1));
    return {
      shape: this.mesh.userData.name ?? this.mesh.parent?.userData.name ?? this.mesh.name,
      position: place(position),
      normal: place(normal),
      illuminance_lx: luminanceOf(rgb_lx),
      standard_error_lx: hasError ? mean((vertex) => this.error[vertex]) : null,
      // That of groups is not in the file.
      direct_lx: isUndimmed ? luminanceOf(direct_lx) : null,
      rgb_lx,
    };
  }
}

/** The photometric value of three channels. */
const luminanceOf = (rgb) => LUMINANCE.reduce((sum, weight, channel) => sum + weight * rgb[channel], 0);

/** A sum over vertices with weights. */
const total = (corners, of) => corners.reduce((sum, [vertex, weight]) => sum + weight * of(vertex), 0);

/** Noise of groups is independent and adds in squares, as `isolux mix` adds it. */
function mixedError(parts, k) {
  let squares = 0;
  for (const { error, level } of parts) {
    if (level > 0 && error.getX(k) < 0) return NO_ESTIMATE;
    squares += (level * error.getX(k)) ** 2;
  }
  return Math.sqrt(squares);
}

/** The corners of a face with their weights at a point of the world. */
function cornersOf(mesh, { a, b, c }, point) {
  const { position } = mesh.geometry.attributes;
  const place = mesh.worldToLocal(point.clone());
  const [p, q, r] = [a, b, c].map((vertex) => new Vector3().fromBufferAttribute(position, vertex));
  const weights = new Triangle(p, q, r).getBarycoord(place, new Vector3()) ?? new Vector3(1, 1, 1);
  return [[a, weights.x], [b, weights.y], [c, weights.z]].map(([vertex, weight]) => [vertex, Math.max(0, weight)]);
}

/** 1, 2 or 5 times a power of ten, not below a number. */
function roundUp(value) {
  if (!(value > 0)) return 1;
  const unit = 10 ** Math.floor(Math.log10(value));
  return [1, 2, 5, 10].map((times) => times * unit).find((round) => round >= value) ?? 10 * unit;
}

/**
 * A colour of the scale, from black to white by blue, green and red: lightness rises all the way, in print as well.
 * Green 2011, A colour scheme for the display of astronomical intensity images, equations 1 and 2 (start 0.5, -1.5 turns, hue 1, gamma 1).
 */
export function falseColour(share) {
  const angle = 2 * Math.PI * (0.5 / 3 + 1 - 1.5 * share);
  const depth = (share * (1 - share)) / 2;
  const [cos, sin] = [Math.cos(angle), Math.sin(angle)];
  const channels = [[-0.14861, 1.78277], [-0.29227, -0.90649], [1.97294, 0]];
  const codes = channels.map(([ofCos, ofSin]) => Math.min(1, Math.max(0, share + depth * (ofCos * cos + ofSin * sin))));
  return new Color().setRGB(...codes, SRGBColorSpace);
}

function falseColours() {
  const codes = Array.from({ length: STEPS }, (_, k) => {
    const { r, g, b } = falseColour(k / (STEPS - 1)).convertLinearToSRGB();
    return [r, g, b, 1].map((channel) => Math.round(255 * channel));
  });
  const texture = new DataTexture(Uint8Array.from(codes.flat()), STEPS, 1);
  texture.colorSpace = SRGBColorSpace;
  texture.channel = SCALE_CHANNEL;
  texture.magFilter = texture.minFilter = LinearFilter;
  texture.needsUpdate = true;
  return texture;
}
