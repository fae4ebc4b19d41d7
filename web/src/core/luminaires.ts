// Luminaires without surface: their luminous areas, small lamps that glow where they are points, or their photometric solids.

import {
  BoxGeometry, BufferAttribute, BufferGeometry, CylinderGeometry, DoubleSide, GLSL3, InstancedBufferAttribute, InstancedBufferGeometry, Mesh,
  RawShaderMaterial, SphereGeometry, type Object3D,
} from 'three';
import type { Luminaire, SceneHeader, Solid } from '../wire';
import { LAYER } from './model';

/** Radius of a lamp, m, and of a solid at its peak. */
const LAMP_M = 0.04;
const SOLID_M = 0.5;

const LAMP_VERTEX = /* glsl */ `
precision highp float;
in vec2 corner;
in vec3 at, way, tint;
in float power;
uniform mat4 viewMatrix, projectionMatrix;
uniform float uSize, uLeast;
out vec2 vCorner;
out vec3 vTint;
out float vFacing, vPower;
void main() {
  vPower = power;
  vec4 eye = viewMatrix * vec4(at, 1.0);
  float radius = max(uSize, uLeast * -eye.z / projectionMatrix[1][1]);
  vec3 faces = (viewMatrix * vec4(way, 0.0)).xyz;
  vFacing = dot(faces, normalize(-eye.xyz));
  vTint = tint;
  // A lamp is flat: seen from the side it is narrower.
  vec2 axis = length(faces.xy) > 1e-4 ? normalize(faces.xy) : vec2(0.0, 1.0);
  vec2 from = corner * 5.0;
  vCorner = from + axis * dot(from, axis) * (1.0 / mix(0.4, 1.0, abs(vFacing)) - 1.0);
  // It lies a little before what it hangs from.
  float nearer = min(8.0 * radius, 0.2 * -eye.z) / -eye.z;
  eye.xyz *= 1.0 - nearer;
  radius *= 1.0 - nearer;
  eye.xy += from * radius;
  gl_Position = projectionMatrix * eye;
}
`;

const LAMP_FRAGMENT = /* glsl */ `
precision highp float;
in vec2 vCorner;
in vec3 vTint;
in float vFacing, vPower;
uniform float uGlow;
out vec4 colour;
void main() {
  float r = length(vCorner);
  float bright = smoothstep(-0.25, 0.25, vFacing) * min(1.0, vPower);
  float core = 1.0 - smoothstep(0.85, 1.1, r);
  vec3 tint = vTint / max(vTint.r, max(vTint.g, vTint.b));
  vec3 body = mix(vec3(0.22), mix(tint, vec3(1.0), 0.6), bright);
  float halo = uGlow * bright * 0.35 * pow(max(0.0, 1.0 - r / 5.0), 3.0);
  // Premultiplied: the core covers, the halo adds.
  colour = vec4(body * core + tint * halo * (1.0 - core), core);
}
`;

const AREA_VERTEX = /* glsl */ `
precision highp float;
in vec3 position;
in vec3 at, way, side, tint, extent;
in float power;
uniform mat4 viewMatrix, projectionMatrix;
out vec3 vTint;
out float vFacing, vPower;
void main() {
  vec3 part = position * extent;
  vec4 eye = viewMatrix * vec4(at + side * part.x + cross(side, way) * part.y - way * part.z, 1.0);
  vFacing = dot((viewMatrix * vec4(way, 0.0)).xyz, normalize(-eye.xyz));
  vTint = tint;
  vPower = power;
  // Nearer along the way to the eye, so that it lies before what it hangs from and looks the same.
  eye.xyz *= 1.0 - min(0.05, 0.2 * -eye.z) / -eye.z;
  gl_Position = projectionMatrix * eye;
}
`;

const AREA_FRAGMENT = /* glsl */ `
precision highp float;
in vec3 vTint;
in float vFacing, vPower;
out vec4 colour;
void main() {
  float bright = smoothstep(-0.25, 0.25, vFacing) * min(1.0, vPower);
  vec3 tint = vTint / max(vTint.r, max(vTint.g, vTint.b));
  colour = vec4(mix(vec3(0.22), mix(tint, vec3(1.0), 0.6), bright), 1.0);
}
`;

/** Shapes of luminous areas with half extents of 1. */
const SHAPES = {
  box: () => new BoxGeometry(2, 2, 2),
  cylinder_x: () => new CylinderGeometry(1, 1, 2, 48).rotateZ(Math.PI / 2),
  cylinder_y: () => new CylinderGeometry(1, 1, 2, 48),
  cylinder_z: () => new CylinderGeometry(1, 1, 2, 48).rotateX(Math.PI / 2),
  ellipsoid: () => new SphereGeometry(1, 32, 16),
} satisfies Record<NonNullable<Luminaire['area']>['shape'], () => BufferGeometry>;

const SOLID_VERTEX = /* glsl */ `
precision highp float;
in vec3 point;
in vec3 at, way, side, tint;
uniform mat4 viewMatrix, projectionMatrix;
uniform float uSize;
out vec3 vTint, vPlace;
void main() {
  vec3 across = cross(side, way);
  vec3 place = at + uSize * (side * point.x + across * point.y + way * point.z);
  vec4 eye = viewMatrix * vec4(place, 1.0);
  vPlace = eye.xyz;
  vTint = tint;
  gl_Position = projectionMatrix * eye;
}
`;

const SOLID_FRAGMENT = /* glsl */ `
precision highp float;
in vec3 vTint, vPlace;
out vec4 colour;
void main() {
  vec3 n = normalize(cross(dFdx(vPlace), dFdy(vPlace)));
  float shade = 0.45 + 0.55 * abs(dot(n, normalize(vPlace)));
  vec3 tint = vTint / max(vTint.r, max(vTint.g, vTint.b));
  colour = vec4(mix(vec3(1.0, 0.78, 0.25), tint, 0.35) * shade * 0.8, 0.8);
}
`;

export class Luminaires {
  readonly #lamps: Mesh | null;
  readonly #areas: Mesh[];
  readonly #solids: Mesh[];
  /** The layer of light of each instance of a mesh, or -1. */
  readonly #groups = new Map<Mesh, number[]>();
  /** Lamps wait for the first picture. */
  isReady = false;

  constructor(scene: SceneHeader, parent: Object3D) {
    const placed = scene.luminaires.filter(({ kind, position }) => kind === 'point' && position);
    const layered = (mesh: Mesh, all: Luminaire[]): Mesh => {
      this.#groups.set(mesh, all.map(({ group }) => scene.layers.indexOf(scene.groups[group] ?? '')));
      return mesh;
    };
    const points = placed.filter(({ area }) => !area);
    this.#lamps = points.length > 0 ? layered(lamps(points), points) : null;
    this.#areas = (Object.keys(SHAPES) as (keyof typeof SHAPES)[]).flatMap((shape) => {
      const alike = placed.filter(({ area }) => area?.shape === shape);
      return alike.length > 0 ? [layered(areas(SHAPES[shape](), alike), alike)] : [];
    });
    this.#solids = scene.solids.map((solid, i) => solids(solid, placed.filter((l) => l.solid === i))).filter((mesh) => mesh !== null);
    for (const mesh of [this.#lamps, ...this.#areas, ...this.#solids]) {
      if (!mesh) continue;
      mesh.frustumCulled = false;
      mesh.matrixAutoUpdate = false;
      mesh.layers.set(LAYER.marks);
      mesh.renderOrder = 30;
      parent.add(mesh);
    }
  }

  show(how: 'off' | 'points' | 'solids', glows: boolean): void {
    if (this.#lamps) {
      this.#lamps.visible = this.isReady && how === 'points';
      (this.#lamps.material as RawShaderMaterial).uniforms.uGlow!.value = glows ? 1 : 0;
    }
    this.#areas.forEach((mesh) => (mesh.visible = this.isReady && how === 'points'));
    this.#solids.forEach((mesh) => (mesh.visible = this.isReady && how === 'solids'));
  }

  /** Lamps of layers that are dimmed glow less. */
  dim(factors: readonly number[]): void {
    for (const [mesh, layers] of this.#groups) {
      const power = mesh.geometry.getAttribute('power') as InstancedBufferAttribute;
      layers.forEach((layer, i) => power.setX(i, factors[layer] ?? 1));
      power.needsUpdate = true;
    }
  }

  /** Lamps are at least this many device pixels wide on pictures of this height. */
  setHeight(pixels: number): void {
    if (this.#lamps) (this.#lamps.material as RawShaderMaterial).uniforms.uLeast!.value = 3.5 / pixels;
  }
}

function instances(geometry: InstancedBufferGeometry, all: Luminaire[]): void {
  const each = (name: string, of: (l: Luminaire) => readonly number[]): void => {
    const values = new Float32Array(3 * all.length);
    all.forEach((l, i) => values.set(of(l), 3 * i));
    geometry.setAttribute(name, new InstancedBufferAttribute(values, 3));
  };
  each('at', (l) => l.position!);
  each('way', (l) => l.direction);
  each('side', (l) => l.c0);
  each('tint', (l) => l.colour);
  each('extent', (l) => l.area?.half_m ?? [0, 0, 0]);
  geometry.setAttribute('power', new InstancedBufferAttribute(new Float32Array(all.length).fill(1), 1));
  geometry.instanceCount = all.length;
}

function lamps(all: Luminaire[]): Mesh {
  const geometry = new InstancedBufferGeometry();
  geometry.setAttribute('corner', new BufferAttribute(new Float32Array([-1, -1, 1, -1, 1, 1, -1, 1]), 2));
  geometry.setIndex([0, 1, 2, 0, 2, 3]);
  instances(geometry, all);
  const material = new RawShaderMaterial({
    glslVersion: GLSL3, vertexShader: LAMP_VERTEX, fragmentShader: LAMP_FRAGMENT, transparent: true, depthWrite: false,
    premultipliedAlpha: true, uniforms: { uSize: { value: LAMP_M }, uLeast: { value: 0.005 }, uGlow: { value: 1 } },
  });
  return new Mesh(geometry, material);
}

function areas(shape: BufferGeometry, all: Luminaire[]): Mesh {
  const geometry = new InstancedBufferGeometry();
  geometry.setAttribute('position', shape.getAttribute('position'));
  geometry.setIndex(shape.index);
  instances(geometry, all);
  const material = new RawShaderMaterial({ glslVersion: GLSL3, vertexShader: AREA_VERTEX, fragmentShader: AREA_FRAGMENT, side: DoubleSide });
  return new Mesh(geometry, material);
}

function solids(solid: Solid, all: Luminaire[]): Mesh | null {
  if (all.length === 0 || solid.rows < 2 || solid.columns < 2) return null;
  const geometry = new InstancedBufferGeometry();
  const shape = solidShape(solid);
  geometry.setAttribute('point', shape.getAttribute('point'));
  geometry.setIndex(shape.index);
  instances(geometry, all);
  const material = new RawShaderMaterial({
    glslVersion: GLSL3, vertexShader: SOLID_VERTEX, fragmentShader: SOLID_FRAGMENT, transparent: true, premultipliedAlpha: true, side: DoubleSide,
    uniforms: { uSize: { value: SOLID_M } },
  });
  return new Mesh(geometry, material);
}

/** Points at the intensity of each direction; x is C 0, z is where the luminaire faces. */
function solidShape({ rows, columns, values }: Solid): BufferGeometry {
  const points = new Float32Array(3 * rows * columns);
  const index: number[] = [];
  for (let j = 0; j < rows; j++) {
    const gamma = (Math.PI * j) / (rows - 1);
    for (let i = 0; i < columns; i++) {
      const c = (2 * Math.PI * i) / (columns - 1);
      const far = values[j * columns + i]!;
      points.set([far * Math.sin(gamma) * Math.cos(c), far * Math.sin(gamma) * Math.sin(c), far * Math.cos(gamma)], 3 * (j * columns + i));
      const a = j * columns + i;
      if (i + 1 < columns && j + 1 < rows) index.push(a, a + 1, a + columns, a + 1, a + columns + 1, a + columns);
    }
  }
  const geometry = new BufferGeometry();
  geometry.setAttribute('point', new BufferAttribute(points, 3));
  geometry.setIndex(index);
  return geometry;
}
