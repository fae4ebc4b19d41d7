// What is seen beyond the scene: its sky and its sun, drawn before everything else.

import {
  BufferAttribute, BufferGeometry, ClampToEdgeWrapping, DataTexture, GLSL3, LinearFilter, Matrix3, Mesh, RawShaderMaterial, RepeatWrapping, RGBFormat, UnsignedInt5999Type, Vector3,
  type IUniform, type Texture,
} from 'three';
import type { SceneHeader } from '../wire';
import type { Container } from './container';
import { LAYER } from './model';
import { DISPLAY, FALSE_COLOUR } from './shader-common';
import type { Uniforms } from './uniforms';

/** The most that pictures in half precision hold, cd/m2. */
const MOST = 6e4;

const VERTEX = /* glsl */ `
precision highp float;
in vec2 corner;
uniform mat4 viewMatrix, projectionMatrix;
out vec3 vWay;
void main() {
  // The first two rows of a projection tell directions, wherever its near plane is.
  vec2 across = (corner + vec2(projectionMatrix[2][0], projectionMatrix[2][1])) / vec2(projectionMatrix[0][0], projectionMatrix[1][1]);
  vWay = vec3(across, -1.0) * mat3(viewMatrix);
  gl_Position = vec4(corner, 0.9999, 1.0);
}
`;

const FRAGMENT = /* glsl */ `
precision highp float;
precision highp int;
const vec3 GREY = vec3(0.2126, 0.7152, 0.0722);
${DISPLAY}
${FALSE_COLOUR}
in vec3 vWay;
uniform int uMode, uOutput;
uniform highp sampler2D uSky;
uniform mat3 uSkyFromWorld;
uniform vec3 uSun, uSunLight;
uniform float uSunCosine, uSkyPower, uSunPower;
out vec4 colour;
void main() {
  vec3 way = normalize(vWay), at = uSkyFromWorld * way;
  float turn = atan(at.x, at.y) * 0.15915494309, fall = acos(clamp(at.z, -1.0, 1.0)) * 0.31830988618;
  vec3 seen = uSkyPower * textureLod(uSky, vec2(turn, fall), 0.0).rgb;
  // Close to its middle a cosine has too few digits: the angle is that of its sine.
  float off = length(cross(way, uSun)), rim = sqrt(1.0 - uSunCosine * uSunCosine);
  if (uSunPower > 0.0 && dot(way, uSun) > 0.0 && off < rim) seen += uSunPower * uSunLight;
  seen = min(seen, vec3(${MOST.toFixed(1)}));
  if (uOutput == 1 || uOutput == 3) colour = vec4(uOutput == 3 ? -seen : seen, -1.0);
  else if (uMode == 0) colour = vec4(display(seen), 1.0);
  else if (uMode == 2) colour = vec4(falseColour(dot(seen, GREY)), 1.0);
  else colour = vec4(vec3(0.078, 0.086, 0.102), 1.0);
}
`;

export class Sky {
  readonly mesh: Mesh<BufferGeometry, RawShaderMaterial>;
  readonly #layers: { sky: number; sun: number };
  readonly #hasSun: boolean;

  constructor(container: Container<SceneHeader>, shared: Uniforms) {
    const { sky, sun, layers, groups } = container.header;
    // One layer is all light.
    const layerOf = (group: number | undefined): number => (layers.length === 1 ? 0 : layers.indexOf(group === undefined ? '' : groups[group] ?? ''));
    this.#hasSun = sun !== null;
    this.#layers = { sky: layerOf(sky?.group), sun: layerOf(sun?.group) };
    const codes = sky ? container.numbers<Uint32Array<ArrayBuffer>>(sky.codes) : new Uint32Array(1);
    const fromWorld = new Matrix3();
    if (sky) fromWorld.set(...sky.east, ...sky.north, ...sky.zenith);
    const own: Record<string, IUniform> = {
      uSky: { value: picture(codes, sky?.width ?? 1, sky?.height ?? 1) }, uSkyFromWorld: { value: fromWorld },
      uSun: { value: new Vector3(...(sun?.towards ?? [0, 0, 1])) }, uSunCosine: { value: sun?.cosine ?? 1 }, uSunLight: { value: new Vector3(...(sun?.luminance_cd_m2 ?? [0, 0, 0])) },
      uSkyPower: { value: 1 }, uSunPower: { value: sun ? 1 : 0 },
    };
    const material = new RawShaderMaterial({ glslVersion: GLSL3, vertexShader: VERTEX, fragmentShader: FRAGMENT, uniforms: { ...shared, ...own }, depthTest: false, depthWrite: false });
    const geometry = new BufferGeometry();
    geometry.setAttribute('corner', new BufferAttribute(new Float32Array([-1, -1, 3, -1, -1, 3]), 2));
    geometry.setDrawRange(0, 3);
    this.mesh = new Mesh(geometry, material);
    Object.assign(this.mesh, { frustumCulled: false, matrixAutoUpdate: false, renderOrder: -1 });
    this.mesh.layers.set(LAYER.surfaces);
  }

  /** The sky and the sun of layers that are dimmed are darker. */
  dim(factors: readonly number[]): void {
    const { uSkyPower, uSunPower } = this.mesh.material.uniforms;
    uSkyPower!.value = factors[this.#layers.sky] ?? 1;
    uSunPower!.value = this.#hasSun ? factors[this.#layers.sun] ?? 1 : 0;
  }

  /** All that the graphics card had is gone. */
  lose(): void {
    (this.mesh.material.uniforms.uSky!.value as Texture).dispose();
    this.mesh.material.dispose();
    this.mesh.geometry.dispose();
  }
}

function picture(codes: Uint32Array<ArrayBuffer>, width: number, height: number): DataTexture {
  const texture = new DataTexture(codes, width, height, RGBFormat, UnsignedInt5999Type);
  texture.minFilter = texture.magFilter = LinearFilter;
  texture.wrapS = RepeatWrapping;
  texture.wrapT = ClampToEdgeWrapping;
  texture.generateMipmaps = false;
  texture.needsUpdate = true;
  return texture;
}
