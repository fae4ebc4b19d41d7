//! The pages of a lightmap as pictures in the file.

use super::file::TexelFile;
use crate::lightmap::{LightmapFileError, Way};
use crate::map_glb::bytes::Bytes;
use crate::map_glb::displayed::srgb;
use crate::map_glb::document::{Image, Objects, Sampler, Texture};
use crate::map_glb::preview::luminance_cd_m2;
use image::{ExtendedColorType, ImageEncoder};
use isolux::lightmap::Side;
use isolux::scene::{Finish, Reflectance};
use isolux::units::Rgb;

const LINEAR: u32 = 9729;
const CLAMP: u32 = 33071;

/// A page in the file.
#[derive(Clone, Copy, Debug)]
pub(super) struct Page {
    /// Index of its texture.
    pub(super) texture: u32,
    /// What texels between 0 and 1 are multiplied by.
    pub(super) strength: f64,
}

/// A page as a PNG.
pub(crate) struct Picture {
    pub(crate) png: Vec<u8>,
    /// What texels between 0 and 1 are multiplied by.
    pub(crate) strength: f64,
}

/// All pages as pictures.
pub(super) fn pictures(file: &TexelFile<'_>) -> Result<Vec<Picture>, LightmapFileError> {
    let picture = |page| {
        let texels = texels(file, page);
        let strength = match file.target.way() {
            Way::Preview => 1.0,
            // A dark page has any strength but none.
            _ => Some(largest(&texels)).filter(|most| *most > 0.0).unwrap_or(1.0),
        };
        Ok(Picture { png: png(file, &texels, strength)?, strength })
    };
    (0..file.lightmap.layout.pages).map(picture).collect()
}

/// Adds all pages.
pub(super) fn add(
    file: &TexelFile<'_>,
    objects: &mut Objects,
    bytes: &mut Bytes,
) -> Result<Vec<Page>, LightmapFileError> {
    let sampler_index = objects.samplers.len() as u32;
    objects.samplers.push(sampler());
    let add = |Picture { png, strength }| {
        objects.images.push(Image { buffer_view: bytes.view(&png, None), mime_type: "image/png" });
        let source = objects.images.len() as u32 - 1;
        objects.textures.push(Texture { sampler: Some(sampler_index), source });
        Page { texture: objects.textures.len() as u32 - 1, strength }
    };
    Ok(pictures(file)?.into_iter().map(add).collect())
}

/// What the texels of a page hold for the target, linear.
fn texels(file: &TexelFile<'_>, page: u32) -> Vec<Rgb> {
    let first = file.lightmap.layout.index(page, 0, 0);
    let shown = file.lightmap.page(page);
    let from_lux = file.target.convention().from_lux;
    let one = |(k, lx): (usize, &[f32; 3])| {
        let lx = Rgb(lx.map(f64::from));
        match file.target.way() {
            Way::Lightmap => lx * from_lux,
            Way::Emission => luminance(file, first + k, lx),
            Way::Preview => Rgb(file.preview.colour(luminance(file, first + k, lx))),
        }
    };
    shown.iter().enumerate().map(one).collect()
}

fn largest(texels: &[Rgb]) -> f64 {
    texels.iter().fold(0.0, |most, rgb| f64::max(most, rgb.max_channel()))
}

/// Luminance of the surface at a texel, cd/m2: emitted and reflected, textures included.
fn luminance(file: &TexelFile<'_>, texel: usize, lx: Rgb) -> Rgb {
    let Some((side, [u, v])) = file.lightmap.place(texel) else { return Rgb::BLACK };
    let Some(finish) = finish_at(file, side, u, v) else { return Rgb::BLACK };
    luminance_cd_m2(&finish, lx)
}

fn finish_at(file: &TexelFile<'_>, side: &Side, u: f64, v: f64) -> Option<Finish> {
    let finish = file.scene.material(side.triangle).finish(side.back)?;
    let colour = file.scene.diffuse_reflectance(finish, side.triangle, u, v);
    Some(Finish { diffuse: Reflectance { colour, texture: None }, ..finish.clone() })
}

/// Texels over the strength, as sRGB. What programs that do not stop at 8 bits read has 16: in 8, dark places
/// next to bright ones show steps.
fn png(file: &TexelFile<'_>, texels: &[Rgb], strength: f64) -> Result<Vec<u8>, LightmapFileError> {
    let codes = |most: f64| {
        let code = move |c: f64| (srgb((c / strength).clamp(0.0, 1.0)) * most).round();
        texels.iter().flat_map(move |rgb| rgb.0.map(code))
    };
    let (pixels, kind): (Vec<u8>, _) = match file.target.way() {
        Way::Emission => {
            let words = codes(65_535.0).flat_map(|c| (c as u16).to_ne_bytes());
            (words.collect(), ExtendedColorType::Rgb16)
        }
        _ => (codes(255.0).map(|c| c as u8).collect(), ExtendedColorType::Rgb8),
    };
    let mut png = Vec::new();
    let layout = &file.lightmap.layout;
    image::codecs::png::PngEncoder::new(&mut png)
        .write_image(&pixels, layout.width, layout.height, kind)
        .map_err(|error| LightmapFileError::Png(error.to_string()))?;
    Ok(png)
}

/// Lightmaps do not repeat, and have no mipmaps: those would mix charts.
pub(super) fn sampler() -> Sampler {
    Sampler { mag_filter: LINEAR, min_filter: LINEAR, wrap_s: CLAMP, wrap_t: CLAMP }
}
