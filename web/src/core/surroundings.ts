// What rough gloss, bent mirrors and panes reflect: the scene all around, as a cube.

import { CubeCamera, HalfFloatType, LinearFilter, LinearMipmapLinearFilter, Vector3, WebGLCubeRenderTarget, type Box3, type Scene, type WebGLRenderer } from 'three';
import type { Uniforms } from './uniforms';
import { OUTPUT } from './uniforms';

export class Surroundings {
  readonly #target: WebGLCubeRenderTarget;
  readonly #camera: CubeCamera;
  #isOld = true;

  /** Moving by `enough`, m, makes it worth another look. */
  constructor(readonly size: number, readonly enough: number, far: number) {
    this.#target = new WebGLCubeRenderTarget(size, { type: HalfFloatType, generateMipmaps: true, minFilter: LinearMipmapLinearFilter, magFilter: LinearFilter });
    this.#camera = new CubeCamera(0.02, far, this.#target);
    this.#camera.matrixAutoUpdate = true;
  }

  /** The light has changed. */
  outdate(): void {
    this.#isOld = true;
  }

  isOldAt(eye: Vector3, room: Box3): boolean {
    return this.#isOld || this.#camera.position.distanceTo(placeIn(room, eye)) > this.enough;
  }

  render(renderer: WebGLRenderer, scene: Scene, uniforms: Uniforms, eye: Vector3, room: Box3): void {
    uniforms.uCubeSize.value = 0;
    uniforms.uSurroundings.value = null;
    uniforms.uOutput.value = OUTPUT.luminance;
    this.#camera.position.copy(placeIn(room, eye));
    this.#camera.updateMatrixWorld();
    this.#camera.update(renderer, scene);
    uniforms.uSurroundings.value = this.#target.texture;
    uniforms.uCubeSize.value = this.size;
    uniforms.uCentre.value.copy(this.#camera.position);
    uniforms.uRoomLow.value.copy(room.min);
    uniforms.uRoomHigh.value.copy(room.max);
    this.#isOld = false;
  }

  dispose(): void {
    this.#target.dispose();
  }
}

/** The eye, or the place within the room that is nearest. */
function placeIn(room: Box3, eye: Vector3): Vector3 {
  const size = room.getSize(new Vector3());
  const inner = room.clone().expandByVector(size.multiplyScalar(-0.1));
  return inner.clampPoint(eye, new Vector3());
}
