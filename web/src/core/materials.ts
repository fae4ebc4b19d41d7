// Materials of surfaces: one for each way of drawing, texture and plane of reflection.

import {
  CustomBlending, FrontSide, GLSL3, Matrix4, OneFactor, OneMinusSrcColorFactor, RawShaderMaterial, SrcColorFactor, ZeroFactor,
  type IUniform, type Texture,
} from 'three';
import type { Batch } from './batches';
import { GLASS_FRAGMENT, SURFACE_FRAGMENT, SURFACE_VERTEX } from './surface-shader';
import type { Uniforms } from './uniforms';

/** What reflections of a plane are read from. */
export interface PlaneUniforms {
  [name: string]: IUniform;
  uReflection: IUniform<Texture | null>;
  uReflectionMatrix: IUniform<Matrix4>;
  uIsReflected: IUniform<number>;
}

export const planeUniforms = (): PlaneUniforms => ({
  uReflection: { value: null }, uReflectionMatrix: { value: new Matrix4() }, uIsReflected: { value: 0 },
});

export interface WorldUniforms {
  [name: string]: IUniform;
  uChunks: IUniform<Texture>;
  uFinishes: IUniform<Texture>;
}

const keyOf = ({ kind, texture, plane, firstChunk }: Batch, pass: 0 | 1): string => `${kind} ${texture} ${plane} ${firstChunk} ${pass}`;

export class Materials {
  readonly #made = new Map<string, RawShaderMaterial>();
  readonly #planes: PlaneUniforms[] = [];

  constructor(readonly shared: Uniforms, readonly world: WorldUniforms, readonly textures: readonly IUniform<Texture>[]) {}

  plane(index: number): PlaneUniforms {
    return (this.#planes[index] ??= planeUniforms());
  }

  /** The material of a batch; `pass` is for glass, which is drawn twice. */
  of(batch: Batch, pass: 0 | 1 = 0): RawShaderMaterial {
    const { kind, texture, plane, firstChunk } = batch;
    const key = keyOf(batch, pass);
    const known = this.#made.get(key);
    if (known) return known;
    const made = kind === 'glass' ? this.#glass(firstChunk, pass) : this.#opaque(kind === 'shiny', texture, plane, firstChunk);
    this.#made.set(key, made);
    return made;
  }

  /** One that is ready soon: without textures and reflections. */
  lean(batch: Batch): RawShaderMaterial {
    return this.of({ ...batch, kind: 'plain', texture: -1, plane: -1 });
  }

  #opaque(reflects: boolean, texture: number, plane: number, firstChunk: number): RawShaderMaterial {
    const defines: Record<string, number> = {};
    if (texture >= 0) defines.TEXTURED = 1;
    if (reflects) defines.REFLECTS = 1;
    if (plane >= 0) defines.PLANE = 1;
    const uniforms = {
      ...this.shared, ...this.world, uFirstChunk: { value: firstChunk },
      ...(texture >= 0 ? { uTexture: this.textures[texture]! } : {}), ...(plane >= 0 ? this.plane(plane) : {}),
    };
    const material = new RawShaderMaterial({ glslVersion: GLSL3, vertexShader: SURFACE_VERTEX, fragmentShader: SURFACE_FRAGMENT, defines, uniforms, side: FrontSide });
    // Mirrors hang close before what holds them: from afar they are to win.
    if (plane >= 0) Object.assign(material, { polygonOffset: true, polygonOffsetFactor: -4, polygonOffsetUnits: -16 });
    return material;
  }

  #glass(firstChunk: number, pass: 0 | 1): RawShaderMaterial {
    const material = new RawShaderMaterial({
      glslVersion: GLSL3, vertexShader: SURFACE_VERTEX, fragmentShader: GLASS_FRAGMENT, defines: { GLASS: 1, PASS: pass },
      uniforms: { ...this.shared, ...this.world, uFirstChunk: { value: firstChunk } }, side: FrontSide, transparent: true, depthWrite: false,
    });
    material.blending = CustomBlending;
    // What is behind keeps its illuminance, which is in the alpha of pictures that are read.
    material.blendSrcAlpha = ZeroFactor;
    material.blendDstAlpha = OneFactor;
    material.blendSrc = pass === 0 ? ZeroFactor : OneFactor;
    material.blendDst = pass === 0 ? SrcColorFactor : OneMinusSrcColorFactor;
    return material;
  }

  /** On the display reflections are added so that white stays white; luminances simply add up. */
  glassAdds(luminance: boolean): void {
    for (const [key, material] of this.#made) {
      if (key.startsWith('glass') && key.endsWith(' 1')) material.blendDst = luminance ? OneFactor : OneMinusSrcColorFactor;
    }
  }

  dispose(): void {
    this.#made.forEach((material) => material.dispose());
    this.#made.clear();
  }
}
