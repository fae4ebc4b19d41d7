//! Pictures that textures refer to, decoded within limits.

use super::buffers::Document;
use super::limits;
use super::notes::{Flaw, no_such};
use crate::srgb;
use image::{DynamicImage, GenericImageView, ImageReader};
use isolux::scene::Texture;
use isolux::units::Rgb;
use std::borrow::Cow;
use std::collections::HashMap;
use std::io::Cursor;

/// Averages over all pixels of a picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Means {
    /// Of a colour picture, linear light.
    pub(super) colour: Rgb,
    /// Of a data picture: bytes over 255, no transfer function.
    pub(super) data: [f64; 3],
    /// Of the fourth channel, 1 where there is none.
    pub(super) alpha: f64,
}

/// Largest face of a cube of surroundings that is kept: a third of a degree a pixel.
const KEPT_SIDE: u32 = 256;

/// A square picture of light, linear Rec. 709, row by row from the top.
pub(super) struct Face {
    pub(super) side: u32,
    pub(super) rgb: Vec<[f32; 3]>,
}

impl Face {
    /// The pixel at a place, in shares of the side from the left and from the top.
    pub(super) fn at(&self, place: [f64; 2]) -> [f64; 3] {
        let [x, y] = place.map(|share| ((share * f64::from(self.side)) as u32).min(self.side - 1));
        self.rgb[(y * self.side + x) as usize].map(f64::from)
    }

    /// Half as wide, each pixel the mean of four.
    fn halved(&self) -> Self {
        let side = self.side / 2;
        let pixel = |x: u32, y: u32| self.rgb[(y * self.side + x) as usize];
        let mean = |x: u32, y: u32| {
            let four =
                [(0, 0), (1, 0), (0, 1), (1, 1)].map(|(dx, dy)| pixel(2 * x + dx, 2 * y + dy));
            [0, 1, 2].map(|k| four.iter().map(|rgb| rgb[k]).sum::<f32>() / 4.0)
        };
        let rgb = (0..side * side).map(|at| mean(at % side, at / side)).collect();
        Self { side, rgb }
    }
}

/// Pictures met so far; each is decoded once, or twice if first only its mean was asked for.
pub(super) struct Pictures<'a> {
    document: &'a Document<'a>,
    textures: Vec<Texture>,
    texture_of_image: HashMap<usize, u32>,
    /// The picture decoded last: its pixels are often wanted right after its means.
    latest: Option<(usize, Texture)>,
    /// Those of which parts are looked at.
    kept: HashMap<usize, Texture>,
    means_of_image: HashMap<usize, Result<Means, Flaw>>,
    pixels_left: u64,
    bytes_left: u64,
}

impl<'a> Pictures<'a> {
    pub(super) fn new(document: &'a Document<'a>) -> Self {
        Self {
            document,
            textures: Vec::new(),
            texture_of_image: HashMap::new(),
            latest: None,
            kept: HashMap::new(),
            means_of_image: HashMap::new(),
            pixels_left: limits::ALL_PIXELS,
            bytes_left: limits::PICTURE_BYTES,
        }
    }

    /// The index, among the textures of the scene, of the picture of a glTF texture.
    pub(super) fn texture(&mut self, texture: usize) -> Result<u32, Flaw> {
        let image = self.image_of(texture)?;
        if let Some(&known) = self.texture_of_image.get(&image) {
            return Ok(known);
        }
        if let Some(Err(flaw)) = self.means_of_image.get(&image) {
            return Err(flaw.clone());
        }
        let picture = self.taken(image)?;
        let index = self.textures.len() as u32;
        self.textures.push(picture);
        self.texture_of_image.insert(image, index);
        Ok(index)
    }

    /// The picture of a glTF texture, to be looked at.
    pub(super) fn picture(&mut self, texture: usize) -> Result<&Texture, Flaw> {
        let image = self.image_of(texture)?;
        if let Some(&known) = self.texture_of_image.get(&image) {
            return Ok(&self.textures[known as usize]);
        }
        if let Some(Err(flaw)) = self.means_of_image.get(&image) {
            return Err(flaw.clone());
        }
        if !self.kept.contains_key(&image) {
            let picture = self.taken(image)?;
            self.kept.insert(image, picture);
        }
        Ok(&self.kept[&image])
    }

    fn taken(&mut self, image: usize) -> Result<Texture, Flaw> {
        let latest = self.latest.take().filter(|(of, _)| *of == image);
        match latest.map(|(_, picture)| picture).or_else(|| self.kept.remove(&image)) {
            Some(picture) => Ok(picture),
            None => self.decode(image),
        }
    }

    /// The averages of the picture of a glTF texture.
    pub(super) fn means(&mut self, texture: usize) -> Result<Means, Flaw> {
        let image = self.image_of(texture)?;
        if !self.means_of_image.contains_key(&image) {
            self.latest = Some((image, self.decode(image)?));
        }
        self.means_of_image[&image].clone()
    }

    /// A face of a cube of surroundings, by the index of its image.
    pub(super) fn face(&mut self, image: usize) -> Result<Face, Flaw> {
        let images = self.document.root.images.len();
        if image >= images {
            return Err(no_such("images", image, images));
        }
        let read = self.bytes(image).and_then(|bytes| {
            self.bytes_left = self.bytes_left.saturating_sub(bytes.len() as u64);
            opened(&bytes, self.pixels_left)
        });
        let picture =
            read.and_then(face).map_err(|flaw| flaw.rooted(format!("images[{image}]")))?;
        self.pixels_left -= u64::from(picture.side) * u64::from(picture.side);
        Ok(kept(picture))
    }

    pub(super) fn into_textures(self) -> Vec<Texture> {
        self.textures
    }

    /// The picture of a texture: the one every reader can read, else that of EXT_texture_webp.
    fn image_of(&self, texture: usize) -> Result<usize, Flaw> {
        let textures = &self.document.root.textures;
        let record = textures.get(texture);
        let record = record.ok_or_else(|| no_such("textures", texture, textures.len()))?;
        let others = record.extensions.as_ref().map(|e| &e.others);
        let webp =
            others.and_then(|others| others.get("EXT_texture_webp")?.get("source")?.as_u64());
        // What the typed model puts where a texture names no image.
        let own = Some(record.source.value()).filter(|&source| source != u32::MAX as usize);
        let Some(source) = own.or_else(|| webp.and_then(|index| usize::try_from(index).ok()))
        else {
            let names: Vec<&str> =
                others.into_iter().flat_map(|o| o.keys()).map(|k| &**k).collect();
            let what = match &names[..] {
                [] => "no picture".to_owned(),
                names => format!("no picture but that of {}", names.join(", ")),
            };
            let remedy =
                "save the textures as PNG, JPEG or WebP (KTX2: `gltf-transform ktxdecompress`)";
            return Err(Flaw::new(what, remedy).rooted(format!("textures[{texture}]")));
        };
        let images = self.document.root.images.len();
        if source >= images {
            let flaw = no_such("images", source, images);
            return Err(flaw.rooted(format!("textures[{texture}].source")));
        }
        Ok(source)
    }

    /// Decodes and keeps the averages, or the reason why there are none.
    fn decode(&mut self, image: usize) -> Result<Texture, Flaw> {
        let decoded = self
            .bytes(image)
            .and_then(|bytes| {
                self.bytes_left = self.bytes_left.saturating_sub(bytes.len() as u64);
                decode(&bytes, self.pixels_left)
            })
            .map_err(|flaw| flaw.rooted(format!("images[{image}]")));
        if let Ok((picture, _)) = &decoded {
            self.pixels_left -= u64::from(picture.width) * u64::from(picture.height);
        }
        let averages = decoded.as_ref().map(|(picture, alpha)| means(picture, *alpha));
        self.means_of_image.insert(image, averages.map_err(Flaw::clone));
        decoded.map(|(picture, _)| picture)
    }

    fn bytes(&self, image: usize) -> Result<Cow<'a, [u8]>, Flaw> {
        let document = self.document;
        let record = &document.root.images[image];
        match (&record.uri, record.buffer_view) {
            (Some(uri), _) => document.folder.fetch(uri, self.bytes_left).map(Cow::Owned),
            (None, Some(view)) => Ok(Cow::Borrowed(document.view(view.value())?.bytes)),
            (None, None) => Err(Flaw::new("neither uri nor bufferView", "export the file again")),
        }
    }
}

/// PNG, JPEG or WebP to sRGB bytes, and the mean of alpha; what is transparent is taken as opaque.
fn decode(bytes: &[u8], pixels_left: u64) -> Result<(Texture, f64), Flaw> {
    let picture = opened(bytes, pixels_left)?;
    let alpha = if picture.color().has_alpha() { mean_alpha(&picture) } else { 1.0 };
    let picture = picture.into_rgb8();
    let (width, height) = picture.dimensions();
    Ok((Texture { width, height, srgb: picture.into_raw() }, alpha))
}

/// PNG, JPEG or WebP within limits.
fn opened(bytes: &[u8], pixels_left: u64) -> Result<DynamicImage, Flaw> {
    let broken = |error: image::ImageError| {
        Flaw::new(format!("the picture cannot be read: {error}"), "save it as PNG, JPEG or WebP")
    };
    let reader = || {
        ImageReader::new(Cursor::new(bytes))
            .with_guessed_format()
            .map_err(|error| broken(error.into()))
    };
    let (width, height) = reader()?.into_dimensions().map_err(broken)?;
    let pixels = u64::from(width) * u64::from(height);
    if pixels == 0 || pixels > limits::PICTURE_PIXELS.min(pixels_left) {
        let what = format!("a picture of {width} x {height} pixels");
        let remedy = format!(
            "pictures may have {} pixels each and {} together; make it smaller",
            limits::PICTURE_PIXELS,
            limits::ALL_PIXELS
        );
        return Err(Flaw::new(what, remedy));
    }
    reader()?.decode().map_err(broken)
}

/// The light of a picture: one with alpha is packed as RGBD, colours of sRGB to be divided by alpha.
fn face(picture: DynamicImage) -> Result<Face, Flaw> {
    let (side, height) = (picture.width(), picture.height());
    if side != height || !side.is_power_of_two() {
        let what = format!("a face of {side} x {height} pixels");
        return Err(Flaw::new(what, "faces of a cube are square, with a power of two of pixels"));
    }
    let light = |pixel: &image::Rgba<u8>| {
        let [r, g, b, alpha] = pixel.0;
        let alpha = f64::from(alpha.max(1)) / 255.0;
        [r, g, b].map(|code| (srgb::linear(f64::from(code) / 255.0) / alpha) as f32)
    };
    let rgb = picture.into_rgba8().pixels().map(light).collect();
    Ok(Face { side, rgb })
}

fn kept(mut face: Face) -> Face {
    while face.side > KEPT_SIDE {
        face = face.halved();
    }
    face
}

fn mean_alpha(picture: &DynamicImage) -> f64 {
    let sum: u64 = picture.pixels().map(|(_, _, pixel)| u64::from(pixel.0[3])).sum();
    let pixels = u64::from(picture.width()) * u64::from(picture.height());
    sum as f64 / (255.0 * pixels as f64)
}

fn means(picture: &Texture, alpha: f64) -> Means {
    let mut sums = [0_u64; 3];
    for pixel in picture.srgb.chunks_exact(3) {
        for (sum, &byte) in sums.iter_mut().zip(pixel) {
            *sum += u64::from(byte);
        }
    }
    let count = (picture.srgb.len() / 3).max(1) as f64;
    Means { colour: picture.mean(), data: sums.map(|sum| sum as f64 / (255.0 * count)), alpha }
}
