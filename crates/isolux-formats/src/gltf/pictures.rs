//! Pictures that textures refer to, decoded within limits.

use super::buffers::Document;
use super::limits;
use super::notes::{Flaw, no_such};
use image::ImageReader;
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
}

/// Pictures met so far; each is decoded once, or twice if first only its mean was asked for.
pub(super) struct Pictures<'a> {
    document: &'a Document<'a>,
    textures: Vec<Texture>,
    texture_of_image: HashMap<usize, u32>,
    /// The picture decoded last: its pixels are often wanted right after its means.
    latest: Option<(usize, Texture)>,
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
        let latest = self.latest.take().filter(|(of, _)| *of == image);
        let picture = match latest {
            Some((_, picture)) => picture,
            None => self.decode(image)?,
        };
        let index = self.textures.len() as u32;
        self.textures.push(picture);
        self.texture_of_image.insert(image, index);
        Ok(index)
    }

    /// The averages of the picture of a glTF texture.
    pub(super) fn means(&mut self, texture: usize) -> Result<Means, Flaw> {
        let image = self.image_of(texture)?;
        if !self.means_of_image.contains_key(&image) {
            self.latest = Some((image, self.decode(image)?));
        }
        self.means_of_image[&image].clone()
    }

    pub(super) fn into_textures(self) -> Vec<Texture> {
        self.textures
    }

    fn image_of(&self, texture: usize) -> Result<usize, Flaw> {
        let textures = &self.document.root.textures;
        let found = textures.get(texture);
        let source = found.ok_or_else(|| no_such("textures", texture, textures.len()))?.source;
        let images = self.document.root.images.len();
        // What the typed model puts where a texture names no image.
        if source.value() == u32::MAX as usize {
            let what = "no picture but perhaps one of an extension";
            return Err(Flaw::new(what, "export the textures as PNG or JPEG")
                .rooted(format!("textures[{texture}]")));
        }
        if source.value() >= images {
            let flaw = no_such("images", source.value(), images);
            return Err(flaw.rooted(format!("textures[{texture}].source")));
        }
        Ok(source.value())
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
        if let Ok(picture) = &decoded {
            self.pixels_left -= u64::from(picture.width) * u64::from(picture.height);
        }
        self.means_of_image.insert(image, decoded.as_ref().map(means).map_err(Flaw::clone));
        decoded
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

/// PNG or JPEG to sRGB bytes; what is transparent is taken as opaque.
fn decode(bytes: &[u8], pixels_left: u64) -> Result<Texture, Flaw> {
    let broken = |error: image::ImageError| {
        Flaw::new(format!("the picture cannot be read: {error}"), "save it as PNG or JPEG")
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
    let picture = reader()?.decode().map_err(broken)?.into_rgb8();
    Ok(Texture { width: picture.width(), height: picture.height(), srgb: picture.into_raw() })
}

fn means(picture: &Texture) -> Means {
    let mut sums = [0_u64; 3];
    for pixel in picture.srgb.chunks_exact(3) {
        for (sum, &byte) in sums.iter_mut().zip(pixel) {
            *sum += u64::from(byte);
        }
    }
    let count = (picture.srgb.len() / 3).max(1) as f64;
    Means { colour: picture.mean(), data: sums.map(|sum| sum as f64 / (255.0 * count)) }
}
