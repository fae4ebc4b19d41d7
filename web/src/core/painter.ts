// Draws pictures: mirrors, surroundings, one side or two.

import { Color, type PerspectiveCamera, type WebGLRenderTarget, type WebGLRenderer } from 'three';
import type { Quality } from './graphics';
import { Mirrors } from './mirrors';
import { LAYER } from './model';
import { Surroundings } from './surroundings';
import type { Navigation } from './navigation';
import { Smooth } from './smooth';
import { OUTPUT, type Uniforms } from './uniforms';
import type { World } from './worlds';

/** What a side of the picture shows: a world, and its light or the other. */
export interface Side {
  world: World;
  side: 0 | 1;
}

export class Painter {
  readonly #mirrors = new Mirrors();
  readonly #smooth = new Smooth();
  #surroundings: Surroundings | null = null;

  constructor(readonly renderer: WebGLRenderer, readonly uniforms: Uniforms, readonly quality: Quality, readonly navigation: Navigation) {
    navigation.camera.layers.enable(LAYER.glass);
    navigation.camera.layers.enable(LAYER.marks);
  }

  /** Draws what is seen: one side, or two that meet at `split`. Where drawing is slow, mirrors wait until nothing moves. */
  paint(sides: Side[], split: number, moves: boolean): void {
    const { renderer } = this;
    const { width, height } = renderer.domElement;
    renderer.info.reset();
    const target = this.#smooth.target(renderer, this.quality.samples);
    const at = Math.round(split * width);
    sides.forEach((side, k) => {
      this.#prepare(side, !moves || this.quality.level > 0);
      renderer.setRenderTarget(target);
      if (sides.length > 1) scissor(renderer, target, k === 0 ? [0, at] : [at, width - at], height);
      renderer.render(side.world.root, this.navigation.camera);
    });
    if (sides.length > 1) scissor(renderer, target, null, height);
    this.#smooth.show(renderer);
  }

  /** Draws the mirrors of a side, and sets what its picture needs. */
  #prepare({ world, side }: Side, mirrors: boolean): void {
    const { uniforms, navigation: { camera } } = this;
    const { model } = world;
    uniforms.uSide.value = side;
    if (model?.isFine && model.planes.length > 0) {
      if (mirrors) this.#drawMirrors(world, camera);
      else model.planes.forEach((_, i) => (model.materials.plane(i).uIsReflected.value = 0));
    }
    uniforms.uOutput.value = OUTPUT.display;
    model?.materials.glassAdds(false);
  }

  #drawMirrors(world: World, camera: PerspectiveCamera): void {
    const { renderer, uniforms, quality: { mirrorScale } } = this;
    const model = world.model!;
    const isLuminance = uniforms.uMode.value === 0 || uniforms.uMode.value === 2;
    uniforms.uOutput.value = isLuminance ? OUTPUT.luminance : OUTPUT.falseColour;
    model.materials.glassAdds(isLuminance);
    const { width, height } = renderer.domElement;
    this.#mirrors.render(renderer, world.root, camera, model, { width: Math.max(1, Math.round(width * mirrorScale)), height: Math.max(1, Math.round(height * mirrorScale)) });
  }

  /** Gives up all targets; they are made again when they are drawn to. */
  dispose(): void {
    this.#mirrors.dispose();
    this.#smooth.dispose();
    this.#surroundings?.dispose();
    this.#surroundings?.outdate();
  }

  /** Light has changed: what is reflected is out of date. */
  outdate(): void {
    this.#surroundings?.outdate();
  }

  /** Draws the surroundings again if that is worth while; true if it did. */
  renewSurroundings({ world, side }: Side): boolean {
    const { renderer, uniforms, navigation: { camera, room } } = this;
    if (!world.model?.isFine || !world.model.parts.some(({ batch }) => batch.kind !== 'plain')) return false;
    this.#surroundings ??= new Surroundings(this.quality.isSoftware ? 64 : 128, this.quality.isSoftware ? 4 : 0.75, room.min.distanceTo(room.max) * 2 + 10);
    if (!this.#surroundings.isOldAt(camera.position, room)) return false;
    uniforms.uSide.value = side;
    world.model.planes.forEach((_, i) => (world.model!.materials.plane(i).uIsReflected.value = 0));
    const [clear, alpha] = [renderer.getClearColor(new Color()), renderer.getClearAlpha()];
    renderer.setClearColor(0, 0);
    this.#surroundings.render(renderer, world.root, uniforms, camera.position, room);
    renderer.setClearColor(clear, alpha);
    return true;
  }
}

/** Draws within some columns of the picture only, or everywhere. */
function scissor(renderer: WebGLRenderer, target: WebGLRenderTarget | null, columns: [number, number] | null, height: number): void {
  const ratio = renderer.getPixelRatio();
  if (target) {
    target.scissorTest = columns !== null;
    target.scissor.set(columns?.[0] ?? 0, 0, columns?.[1] ?? target.width, height);
    renderer.setRenderTarget(target);
    return;
  }
  renderer.setScissorTest(columns !== null);
  if (columns) renderer.setScissor(columns[0] / ratio, 0, columns[1] / ratio, height / ratio);
}
