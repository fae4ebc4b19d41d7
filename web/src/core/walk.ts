// Walking: eyes at their height above the floor, walls solid from both sides.

import { Vector3, type PerspectiveCamera } from 'three';
import type { MeshBVH } from 'three-mesh-bvh';
import { floorBelow, RADIUS, roomAbove, slide, STEP } from './collide';
import { WalkInput } from './walk-input';

/** Height of eyes above the floor at first, m. */
const EYES = 1.65;
const LOWEST = 0.3;
const HIGHEST = 30;
/** Speeds, m/s. */
const SPEED = 1.6;
const RUNNING = 4.5;
const RISING = 1.2;
const STEEPEST = 1.5;

export class Walk {
  readonly #input: WalkInput;
  readonly #direction = new Vector3();
  readonly #velocity = new Vector3();
  #eyes = EYES;
  #fall = 0;
  bvh: MeshBVH | null = null;

  constructor(canvas: HTMLCanvasElement, readonly camera: PerspectiveCamera, readonly up: Vector3, readonly changed: () => void) {
    this.#input = new WalkInput(canvas, (right, above) => this.#turn(right, above), changed);
  }

  start(): void {
    this.camera.getWorldDirection(this.#direction);
    this.#eyes = EYES;
    this.settle();
    this.#input.start();
  }

  stop(): void {
    this.#input.stop();
    this.#velocity.set(0, 0, 0);
  }

  /** Looks from the camera's place, which others may have changed. */
  settle(): void {
    this.camera.getWorldDirection(this.#direction);
    this.#fall = 0;
    this.#turn(0, 0);
  }

  #turn(right: number, above: number): void {
    const side = this.#direction.clone().cross(this.up).normalize();
    if (side.lengthSq() < 0.5) side.set(1, 0, 0).cross(this.up).normalize();
    const now = Math.asin(Math.max(-1, Math.min(1, this.#direction.dot(this.up))));
    const pitch = Math.max(-STEEPEST, Math.min(STEEPEST, now + above));
    const flat = this.up.clone().cross(side).applyAxisAngle(this.up, -right);
    this.#direction.copy(flat).multiplyScalar(Math.cos(pitch)).addScaledVector(this.up, Math.sin(pitch));
    this.camera.up.copy(this.up);
    this.camera.lookAt(this.camera.position.clone().add(this.#direction));
    this.changed();
  }

  /** Goes on for some seconds; true while something moves. */
  update(seconds: number): boolean {
    const dt = Math.min(seconds, 0.25);
    const before = this.camera.position.clone();
    const [ahead, right, above] = this.#input.way();
    const side = this.#direction.clone().cross(this.up).normalize();
    const forward = this.up.clone().cross(side);
    const wanted = forward.multiplyScalar(ahead).addScaledVector(side, right).clampLength(0, 1).multiplyScalar(this.#input.isRunning ? RUNNING : SPEED);
    this.#velocity.lerp(wanted, 1 - Math.exp(-dt / 0.07));
    if (wanted.lengthSq() === 0 && this.#velocity.lengthSq() < 1e-3) this.#velocity.set(0, 0, 0);
    this.#eyes = Math.max(LOWEST, Math.min(HIGHEST, this.#eyes + above * RISING * dt));
    this.#slide(dt);
    this.#stand(dt, above);
    return before.distanceToSquared(this.camera.position) > 1e-10 || this.#velocity.lengthSq() > 0 || above !== 0;
  }

  /** Moves in steps that no wall is thin enough for. */
  #slide(dt: number): void {
    const eye = this.camera.position;
    const steps = Math.ceil((this.#velocity.length() * dt) / (RADIUS / 2));
    for (let i = 0; i < steps; i++) {
      const way = this.#velocity.clone().multiplyScalar(dt / steps);
      eye.copy(this.bvh ? slide(this.bvh, eye, way, this.up, this.#eyes) : eye.clone().add(way));
    }
  }

  /** Brings the eyes to their height above the floor: at once a little up, or down as things fall. */
  #stand(dt: number, above: number): void {
    const floor = this.bvh && floorBelow(this.bvh, this.camera.position, this.up);
    if (floor === null) {
      // Nothing to stand on: hovering.
      this.camera.position.addScaledVector(this.up, above * RISING * dt);
      return;
    }
    const off = this.#eyes - floor;
    if (off > 0) this.#rise(Math.min(off, Math.max(1.5, off / 0.12) * dt));
    else if (off < 0) {
      this.#fall += 9.81 * dt;
      this.camera.position.addScaledVector(this.up, Math.max(off, off > -STEP ? -2 * dt : -this.#fall * dt));
    }
    if (Math.abs(off) < 1e-4) this.#fall = 0;
  }

  #rise(by: number): void {
    const room = this.bvh ? roomAbove(this.bvh, this.camera.position, this.up) - 0.12 : by;
    if (room < by) this.#eyes = Math.max(LOWEST, this.#eyes - Math.max(0, by - room));
    this.camera.position.addScaledVector(this.up, Math.max(0, Math.min(by, room)));
  }
}
