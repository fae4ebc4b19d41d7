// Smooth edges: pictures are drawn aside with several samples a pixel, and then copied.

import { BufferAttribute, BufferGeometry, Camera, GLSL3, Mesh, RawShaderMaterial, WebGLRenderTarget, type WebGLRenderer } from 'three';

const VERTEX = /* glsl */ `
in vec2 corner;
out vec2 at;
void main() { at = 0.5 + 0.5 * corner; gl_Position = vec4(corner, 0.0, 1.0); }
`;

const FRAGMENT = /* glsl */ `
precision highp float;
uniform sampler2D picture;
in vec2 at;
out vec4 colour;
void main() { colour = vec4(texture(picture, at).rgb, 1.0); }
`;

export class Smooth {
  #target: WebGLRenderTarget | null = null;
  readonly #camera = new Camera();
  readonly #material = new RawShaderMaterial({ glslVersion: GLSL3, vertexShader: VERTEX, fragmentShader: FRAGMENT, depthTest: false, depthWrite: false, uniforms: { picture: { value: null } } });
  readonly #copy: Mesh;

  constructor() {
    const triangle = new BufferGeometry();
    triangle.setAttribute('corner', new BufferAttribute(new Float32Array([-1, -1, 3, -1, -1, 3]), 2));
    triangle.setDrawRange(0, 3);
    triangle.setIndex([0, 1, 2]);
    this.#copy = new Mesh(triangle, this.#material);
    this.#copy.frustumCulled = false;
  }

  /** What to draw to: a target with so many samples, or the canvas itself for none. */
  target(renderer: WebGLRenderer, samples: number): WebGLRenderTarget | null {
    if (samples === 0) {
      this.dispose();
      return null;
    }
    const { width, height } = renderer.domElement;
    this.#target ??= new WebGLRenderTarget(width, height, { samples });
    this.#target.setSize(width, height);
    return this.#target;
  }

  /** Brings what was drawn to the canvas. */
  show(renderer: WebGLRenderer): void {
    if (!this.#target) return;
    renderer.setRenderTarget(null);
    this.#material.uniforms.picture!.value = this.#target.texture;
    renderer.render(this.#copy, this.#camera);
  }

  dispose(): void {
    this.#target?.dispose();
    this.#target = null;
  }
}
