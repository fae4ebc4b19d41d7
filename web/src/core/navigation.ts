// Where the camera is: orbiting, walking, flights between views.

import CameraControls from 'camera-controls';
import { Box3, Matrix4, MathUtils, PerspectiveCamera, Quaternion, Raycaster, Sphere, Spherical, Vector2, Vector3, Vector4 } from 'three';
import type { View } from '../contract';
import type { Camera, SceneHeader, Vec3 } from '../wire';
import { Walk } from './walk';

CameraControls.install({ THREE: { Vector2, Vector3, Vector4, Quaternion, Matrix4, Spherical, Box3, Sphere, Raycaster, MathUtils } as never });

const FOV = 55;
const FLIGHT_S = 0.9;

interface Flight {
  from: View;
  to: View;
  done: number;
}

export class Navigation {
  readonly camera: PerspectiveCamera;
  readonly walk: Walk;
  readonly #controls: CameraControls;
  readonly #origin: Vec3;
  readonly #box: Box3;
  #flight: Flight | null = null;
  #wasTold = '';
  how: 'orbit' | 'walk' = 'orbit';

  constructor(canvas: HTMLCanvasElement, readonly scene: SceneHeader, readonly changed: () => void) {
    const { bounds, origin, up } = scene;
    this.#origin = origin;
    this.#box = new Box3(new Vector3(...bounds.min), new Vector3(...bounds.max));
    this.camera = new PerspectiveCamera(FOV, 1, 0.03, 100);
    this.camera.up.set(...up).normalize();
    this.#controls = new CameraControls(this.camera, canvas);
    this.#controls.updateCameraUp();
    Object.assign(this.#controls, { dollyToCursor: true, smoothTime: 0.12, draggingSmoothTime: 0.06, minDistance: 0.05, infinityDolly: true, restThreshold: 1e-4 });
    for (const event of ['control', 'controlstart', 'wake', 'transitionstart'] as const) this.#controls.addEventListener(event, changed);
    this.walk = new Walk(canvas, this.camera, this.camera.up.clone(), changed);
    if (scene.cameras.length > 0) this.goTo(this.#viewOf(scene.cameras[0]!), false);
    else this.frame(false);
  }

  /** Where cameras may be said to be inside of. */
  get room(): Box3 {
    return this.#box;
  }

  setHow(how: 'orbit' | 'walk'): void {
    if (how === this.how) return;
    const now = this.view();
    this.how = how;
    this.#flight = null;
    this.#controls.enabled = how === 'orbit';
    if (how === 'walk') this.walk.start();
    else {
      this.walk.stop();
      this.#look(now);
    }
    this.changed();
  }

  view(): View {
    const { camera } = this;
    const target = this.how === 'orbit' ? this.#controls.getTarget(new Vector3()) : camera.getWorldDirection(new Vector3()).multiplyScalar(2).add(camera.position);
    return { position: this.#written(camera.position), target: this.#written(target), fovDeg: camera.fov };
  }

  goTo(view: View, animate: boolean): void {
    this.#flight = animate ? { from: this.view(), to: view, done: 0 } : null;
    if (!animate) this.#look(view);
    this.changed();
  }

  goToCamera(index: number, animate: boolean): void {
    const camera = this.scene.cameras[index];
    if (camera) this.goTo(this.#viewOf(camera), animate);
  }

  /** The whole scene, from above and the side. */
  frame(animate: boolean): void {
    const ball = this.#box.getBoundingSphere(new Sphere());
    const up = new Vector3(...this.scene.up).normalize();
    const [a, b] = Math.abs(up.y) > 0.5 ? [new Vector3(1, 0, 0), new Vector3(0, 0, 1)] : [new Vector3(1, 0, 0), new Vector3(0, -1, 0)];
    const narrow = Math.min(1, this.camera.aspect);
    const far = (1.05 * ball.radius) / Math.sin(((FOV / 2) * Math.PI) / 180) / narrow;
    const from = a.multiplyScalar(0.55).add(b.multiplyScalar(0.75)).add(up.multiplyScalar(0.75)).normalize().multiplyScalar(far).add(ball.center);
    this.goTo({ position: this.#written(from), target: this.#written(ball.center), fovDeg: FOV }, animate);
  }

  /** Goes on for some seconds; true while something moves. */
  update(seconds: number): boolean {
    const moves = this.#flight ? this.#fly(seconds) : this.how === 'walk' ? this.walk.update(seconds) : this.#controls.update(seconds);
    this.#setDepth();
    return moves;
  }

  /** Whether the camera is elsewhere than when this was asked last. */
  hasMoved(): boolean {
    const { position, quaternion, fov, aspect } = this.camera;
    const now = [...position, ...quaternion, fov, aspect].join();
    const moved = now !== this.#wasTold;
    this.#wasTold = now;
    return moved;
  }

  #fly(seconds: number): boolean {
    const flight = this.#flight!;
    flight.done = Math.min(1, flight.done + seconds / FLIGHT_S);
    const part = flight.done ** 2 * (3 - 2 * flight.done);
    const between = (a: Vec3, b: Vec3): Vec3 => a.map((c, k) => c + part * (b[k]! - c)) as Vec3;
    const { from, to } = flight;
    this.#look({ position: between(from.position, to.position), target: between(from.target, to.target), fovDeg: from.fovDeg + part * (to.fovDeg - from.fovDeg) });
    if (flight.done >= 1) this.#flight = null;
    return true;
  }

  #look({ position, target, fovDeg }: View): void {
    const [eye, at] = [this.#inScene(position), this.#inScene(target)];
    this.camera.fov = fovDeg;
    if (this.how === 'walk') {
      this.camera.position.copy(eye);
      this.camera.lookAt(at);
      this.walk.settle();
      return;
    }
    void this.#controls.setLookAt(eye.x, eye.y, eye.z, at.x, at.y, at.z, false);
    this.#controls.update(0);
  }

  /** Near and far planes: tight, so that depths are told apart. */
  #setDepth(): void {
    const { camera } = this;
    const size = this.#box.getSize(new Vector3()).length();
    const outside = this.#box.distanceToPoint(camera.position);
    camera.near = Math.max(0.03, size * 2e-5, outside * 0.5);
    camera.far = Math.max(1, 1.2 * (outside + size));
    camera.updateProjectionMatrix();
    camera.updateMatrixWorld();
  }

  resize(width: number, height: number): void {
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
  }

  #viewOf({ position, direction, vertical_fov_deg }: Camera): View {
    const eye = new Vector3(...position);
    const ray = new Vector3(...direction).normalize();
    const size = this.#box.getSize(new Vector3()).length();
    const ahead = eye.clone().addScaledVector(ray, Math.max(0.5, Math.min(0.25 * size, 4)));
    return { position: this.#written(eye), target: this.#written(ahead), fovDeg: vertical_fov_deg };
  }

  #written(p: Vector3): Vec3 {
    return [p.x + this.#origin[0], p.y + this.#origin[1], p.z + this.#origin[2]];
  }

  #inScene([x, y, z]: Vec3): Vector3 {
    return new Vector3(x - this.#origin[0], y - this.#origin[1], z - this.#origin[2]);
  }
}
