// Textures of a scene: grey at once, their pictures as soon as they are decoded.

import { DataTexture, LinearFilter, LinearMipmapLinearFilter, RepeatWrapping, RGBAFormat, SRGBColorSpace, Texture, type IUniform } from 'three';
import type { SceneHeader } from '../wire';
import type { Container } from './container';
import { Texels } from './texels';

/** A texture for shaders, and its colours for readings once they are there. */
export interface SceneTexture extends IUniform<Texture> {
  texels: Texels | null;
}

/** One texture each; `changed` is called whenever a picture has arrived. */
export function openTextures({ header, numbers }: Container<SceneHeader>, changed: () => void): SceneTexture[] {
  return header.textures.map(({ png }) => {
    const uniform: SceneTexture = { value: plain(), texels: null };
    const blob = new Blob([numbers<Uint8Array<ArrayBuffer>>(png)], { type: 'image/png' });
    // The first row is at v = 0, as in glTF. The values are used as they are stored; three.js tells WebGL that they are coded as sRGB.
    createImageBitmap(blob, { colorSpaceConversion: 'none', premultiplyAlpha: 'none' }).then((bitmap) => {
      uniform.value.dispose();
      uniform.value = pictured(bitmap);
      uniform.texels = new Texels(bitmap);
      changed();
    }, () => console.warn('A texture of the scene cannot be decoded.'));
    return uniform;
  });
}

function plain(): Texture {
  const texture = new DataTexture(new Uint8Array([188, 188, 188, 255]), 1, 1, RGBAFormat);
  texture.colorSpace = SRGBColorSpace;
  texture.needsUpdate = true;
  return texture;
}

function pictured(bitmap: ImageBitmap): Texture {
  const texture = new Texture(bitmap);
  texture.colorSpace = SRGBColorSpace;
  texture.flipY = false;
  texture.wrapS = texture.wrapT = RepeatWrapping;
  texture.minFilter = LinearMipmapLinearFilter;
  texture.magFilter = LinearFilter;
  texture.anisotropy = 4;
  texture.needsUpdate = true;
  return texture;
}
