// Plane mirrors: what they show is drawn with a camera behind them.

import { Box3, Color, HalfFloatType, Matrix4, PerspectiveCamera, Plane as Cut, Vector3, Vector4, WebGLRenderTarget, type Object3D, type WebGLRenderer } from 'three';
import { boxOf } from './geometry';
import type { PlaneUniforms } from './materials';
import { LAYER, type Model } from './model';

const MOST = 3;
/** Mirrors with less of the screen, times what they reflect, are not drawn. */
const LEAST_AREA = 2e-4;
const BLACK = new Color(0);
const BIAS = new Matrix4().set(0.5, 0, 0, 0.5, 0, 0.5, 0, 0.5, 0, 0, 0.5, 0.5, 0, 0, 0, 1);

export class Mirrors {
  readonly #targets: WebGLRenderTarget[] = [];
  readonly #cameras: PerspectiveCamera[] = [];

  /** Draws what the largest mirrors in sight show, for pictures of this many pixels. */
  render(renderer: WebGLRenderer, scene: Object3D, camera: PerspectiveCamera, model: Model, size: { width: number; height: number }): void {
    const seen = seenPlanes(model, camera).slice(0, MOST);
    const all = model.planes.map((_, i) => model.materials.plane(i));
    // While one is drawn none is read: a target that is read and drawn to at once stays black.
    all.forEach(({ uIsReflected, uReflection }) => {
      uIsReflected.value = 0;
      uReflection.value = null;
    });
    const [before, clear, alpha] = [renderer.getRenderTarget(), renderer.getClearColor(new Color()), renderer.getClearAlpha()];
    renderer.setClearColor(BLACK, 0);
    seen.forEach((index, k) => this.#draw(renderer, scene, camera, model, index, k, this.#target(k, size), all[index]!));
    renderer.setRenderTarget(before);
    renderer.setClearColor(clear, alpha);
    seen.forEach((index, k) => {
      all[index]!.uReflection.value = this.#targets[k]!.texture;
      all[index]!.uIsReflected.value = 1;
    });
  }

  #camera(k: number): PerspectiveCamera {
    const known = this.#cameras[k];
    if (known) return known;
    const made = (this.#cameras[k] = new PerspectiveCamera());
    made.layers.enable(LAYER.glass);
    made.matrixAutoUpdate = false;
    return made;
  }

  #target(k: number, { width, height }: { width: number; height: number }): WebGLRenderTarget {
    const target = (this.#targets[k] ??= new WebGLRenderTarget(width, height, { type: HalfFloatType }));
    target.setSize(width, height);
    return target;
  }

  #draw(renderer: WebGLRenderer, scene: Object3D, camera: PerspectiveCamera, model: Model, index: number, k: number, target: WebGLRenderTarget, uniforms: PlaneUniforms): void {
    const { normal, point } = model.planes[index]!;
    const virtual = this.#camera(k);
    place(virtual, camera, normal, point);
    uniforms.uReflectionMatrix.value.copy(BIAS).multiply(virtual.projectionMatrix).multiply(virtual.matrixWorldInverse);
    clip(virtual, normal, point);
    renderer.setRenderTarget(target);
    renderer.clear();
    renderer.render(scene, virtual);
  }

  dispose(): void {
    this.#targets.forEach((target) => target.dispose());
  }
}

/** Planes that face the camera and are in sight, by how much of the picture they mirror. */
function seenPlanes(model: Model, camera: PerspectiveCamera): number[] {
  const view = new Matrix4().multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse);
  const areas = model.planes.map(({ normal, point, chunks, weight }) => {
    if (normal.dot(camera.position) - normal.dot(point) < 1e-4) return 0;
    const box = chunks.reduce((all, i) => all.union(boxOf(model.data.header.chunks[i]!)), new Box3());
    return weight * areaOf(box, view);
  });
  return areas.map((_, i) => i).filter((i) => areas[i]! > LEAST_AREA).sort((a, b) => areas[b]! - areas[a]!);
}

/** The share of the picture that a box takes, roughly. */
function areaOf({ min, max }: Box3, view: Matrix4): number {
  const [low, high] = [[1, 1], [-1, -1]];
  let behind = 0;
  for (let i = 0; i < 8; i++) {
    const corner = new Vector4(i & 1 ? max.x : min.x, i & 2 ? max.y : min.y, i & 4 ? max.z : min.z, 1).applyMatrix4(view);
    if (corner.w <= 0) behind += 1;
    const [x, y] = corner.w > 0 ? [corner.x / corner.w, corner.y / corner.w] : [Math.sign(corner.x), Math.sign(corner.y)];
    low[0] = Math.min(low[0]!, x!);
    low[1] = Math.min(low[1]!, y!);
    high[0] = Math.max(high[0]!, x!);
    high[1] = Math.max(high[1]!, y!);
  }
  const side = (k: number): number => Math.max(0, Math.min(1, high[k]!) - Math.max(-1, low[k]!)) / 2;
  return behind === 8 ? 0 : side(0) * side(1);
}

/** Puts the camera where the mirror image of another is; it sees the room the right way round. */
function place(virtual: PerspectiveCamera, camera: PerspectiveCamera, normal: Vector3, point: Vector3): void {
  const mirrored = (p: Vector3): Vector3 => p.sub(point).reflect(normal).add(point);
  const ahead = camera.getWorldDirection(new Vector3()).add(camera.position);
  virtual.position.copy(mirrored(camera.position.clone()));
  virtual.up.set(0, 1, 0).applyQuaternion(camera.quaternion).reflect(normal);
  virtual.lookAt(mirrored(ahead));
  virtual.updateMatrix();
  virtual.matrixWorld.copy(virtual.matrix);
  virtual.matrixWorldInverse.copy(virtual.matrixWorld).invert();
  // It sees as far as the camera does, from behind the mirror.
  const behind = 2 * Math.abs(normal.dot(camera.position) - normal.dot(point));
  const { fov, aspect, near, zoom, view } = camera;
  Object.assign(virtual, { fov, aspect, near, zoom, view, far: camera.far + behind });
  virtual.updateProjectionMatrix();
}

/** Makes the mirror the near plane (Lengyel 2005, "Oblique view frustum depth projection and clipping"). */
function clip(camera: PerspectiveCamera, normal: Vector3, point: Vector3): void {
  const plane = new Cut().setFromNormalAndCoplanarPoint(normal, point.clone().addScaledVector(normal, 1e-3)).applyMatrix4(camera.matrixWorldInverse);
  const cut = new Vector4(plane.normal.x, plane.normal.y, plane.normal.z, plane.constant);
  const e = camera.projectionMatrix.elements;
  const corner = new Vector4((Math.sign(cut.x) + e[8]!) / e[0]!, (Math.sign(cut.y) + e[9]!) / e[5]!, -1, (1 + e[10]!) / e[14]!);
  cut.multiplyScalar(2 / cut.dot(corner));
  e[2] = cut.x;
  e[6] = cut.y;
  e[10] = cut.z + 1;
  e[14] = cut.w;
  camera.projectionMatrixInverse.copy(camera.projectionMatrix).invert();
}
