// Draws pictures: mirrors, surroundings, one side or two.

import { Color, type PerspectiveCamera, type WebGLRenderer } from 'three';
import type { Quality } from './graphics';
import { Mirrors } from './mirrors';
import { LAYER } from './model';
import { Surroundings } from './surroundings';
import type { Navigation } from './navigation';
import { OUTPUT, type Uniforms } from './uniforms';
import type { World } from './worlds';

/** What a side of the picture shows: a world, and its light or the other. */
export interface Side {
  world: World;
  side: 0 | 1;
}

export class Painter {
  readonly #mirrors = new Mirrors();
  #surroundings: Surroundings | null = null;

  constructor(readonly renderer: WebGLRenderer, readonly uniforms: Uniforms, readonly quality: Quality, readonly navigation: Navigation) {
    navigation.camera.layers.enable(LAYER.glass);
    navigation.camera.layers.enable(LAYER.marks);
  }

  /** Draws what is seen: one side, or two that meet at `split`. */
  paint(sides: Side[], split: number): void {
    const { renderer } = this;
    const { width, height } = renderer.domElement;
    renderer.info.reset();
    renderer.setRenderTarget(null);
    const ratio = renderer.getPixelRatio();
    sides.forEach((side, k) => {
      if (sides.length > 1) {
        const at = Math.round(split * width) / ratio;
        renderer.setScissorTest(true);
        if (k === 0) renderer.setScissor(0, 0, at, height / ratio);
        else renderer.setScissor(at, 0, width / ratio - at, height / ratio);
      }
      this.#paintSide(side);
    });
    renderer.setScissorTest(false);
  }

  #paintSide({ world, side }: Side): void {
    const { renderer, uniforms, navigation: { camera } } = this;
    const { model } = world;
    uniforms.uSide.value = side;
    if (model && model.planes.length > 0) this.#drawMirrors(world, camera);
    uniforms.uOutput.value = OUTPUT.display;
    model?.materials.glassAdds(false);
    renderer.render(world.root, camera);
  }

  #drawMirrors(world: World, camera: PerspectiveCamera): void {
    const { renderer, uniforms, quality: { mirrorScale } } = this;
    const model = world.model!;
    const isLuminance = uniforms.uMode.value === 0 || uniforms.uMode.value === 2;
    uniforms.uOutput.value = isLuminance ? OUTPUT.luminance : OUTPUT.falseColour;
    model.materials.glassAdds(isLuminance);
    const { width, height } = renderer.domElement;
    const hadScissor = renderer.getScissorTest();
    renderer.setScissorTest(false);
    this.#mirrors.render(renderer, world.root, camera, model, { width: Math.max(1, Math.round(width * mirrorScale)), height: Math.max(1, Math.round(height * mirrorScale)) });
    renderer.setScissorTest(hadScissor);
  }

  /** Light has changed: what is reflected is out of date. */
  outdate(): void {
    this.#surroundings?.outdate();
  }

  /** Draws the surroundings again if that is worth while; true if it did. */
  renewSurroundings({ world, side }: Side): boolean {
    const { renderer, uniforms, navigation: { camera, room } } = this;
    if (!world.model?.parts.some(({ batch }) => batch.kind !== 'plain')) return false;
    this.#surroundings ??= new Surroundings(this.quality.isSoftware ? 64 : 128, room.min.distanceTo(room.max) * 2 + 10);
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
