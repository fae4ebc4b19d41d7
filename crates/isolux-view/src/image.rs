//! What a view sees before it is shown: luminance, illuminance and surfaces, pixel by pixel.

use crate::error::ViewError;
use isolux::geometry::{Normal, Point};
use isolux::units::Rgb;

/// Pixels in one picture at most: 8K.
pub(crate) const MAX_PIXELS: u64 = 1 << 25;
/// Samples in one view at most (28 bytes each).
pub(crate) const MAX_SAMPLES: u64 = 1 << 27;

/// Width and height of a picture, neither of them zero.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Size {
    width: u32,
    height: u32,
}

impl Size {
    /// A size in pixels.
    pub fn new(width: u32, height: u32) -> Result<Self, ViewError> {
        let pixels = u64::from(width) * u64::from(height);
        if (1..=MAX_PIXELS).contains(&pixels) {
            Ok(Self { width, height })
        } else {
            Err(ViewError::Size { width, height })
        }
    }

    /// Pixels across.
    pub fn width(self) -> u32 {
        self.width
    }

    /// Pixels down.
    pub fn height(self) -> u32 {
        self.height
    }

    /// Pixels in all.
    pub fn pixels(self) -> usize {
        self.width as usize * self.height as usize
    }

    /// Refuses more samples than fit in memory.
    pub(crate) fn check_samples(self, samples_per_pixel: u32) -> Result<(), ViewError> {
        let samples = self.pixels() as u64 * u64::from(samples_per_pixel);
        if samples <= MAX_SAMPLES { Ok(()) } else { Err(ViewError::Samples { samples }) }
    }
}

/// What kind of thing a sample saw.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sight {
    /// Nothing: black.
    Background,
    /// A surface.
    Surface,
    /// A surface that gives light of its own.
    Emitter,
    /// A diffuse surface of which the map knows no value.
    Unknown,
}

/// One sample of a pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Seen {
    /// Luminance, cd/m2.
    pub luminance_cd_m2: [f32; 3],
    /// What the map says of the surface seen; in mirrors and through glass of the surface behind,
    /// along the stronger branch.
    pub reading: Option<Reading>,
    /// Kind.
    pub sight: Sight,
}

/// The illuminance of a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reading {
    /// Photometric illuminance, lx.
    pub illuminance_lx: f32,
    /// Its standard error, lx.
    pub standard_error_lx: f32,
}

impl Reading {
    /// The error is mostly that of the map, which all rounds share.
    fn take_up(&mut self, other: &Self, share: f32) {
        self.illuminance_lx += share * (other.illuminance_lx - self.illuminance_lx);
        self.standard_error_lx += share * (other.standard_error_lx - self.standard_error_lx);
    }

    /// The mean of readings of one piece of surface, and its standard error from their spread. The
    /// errors of the map are common to them, so the mean keeps the mean error.
    pub(crate) fn mean(readings: impl Iterator<Item = Self>) -> Option<(Self, f32)> {
        let (mut illuminance, mut error, mut squares, mut count) = (0.0, 0.0, 0.0, 0.0);
        for reading in readings {
            let lux = f64::from(reading.illuminance_lx);
            illuminance += lux;
            squares += lux * lux;
            error += f64::from(reading.standard_error_lx);
            count += 1.0;
        }
        let mean = illuminance / count;
        let variance = (squares / count - mean * mean).max(0.0) / f64::max(count - 1.0, 1.0);
        (count > 0.0).then_some((
            Self { illuminance_lx: mean as f32, standard_error_lx: (error / count) as f32 },
            variance.sqrt() as f32,
        ))
    }
}

impl Seen {
    fn take_up(&mut self, other: &Self, share: f32) {
        for (own, other) in self.luminance_cd_m2.iter_mut().zip(other.luminance_cd_m2) {
            *own += share * (other - *own);
        }
        if let (Some(own), Some(other)) = (self.reading.as_mut(), &other.reading) {
            own.take_up(other, share);
        }
    }

    /// Luminance, cd/m2.
    pub fn luminance(&self) -> Rgb {
        Rgb(self.luminance_cd_m2.map(f64::from))
    }
}

/// The place on a surface that the middle of a pixel shows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Surface {
    /// Index of the shape.
    pub shape: u32,
    /// Whether its back is seen.
    pub back: bool,
    /// Mirrors and panes on the way, as a number that differs when they differ.
    pub path: u32,
    /// Where.
    pub position: Point,
    /// Shading normal on the side seen.
    pub normal: Normal,
}

impl Surface {
    /// Whether two places belong to one smooth piece of surface, so that values may be interpolated
    /// between them: same shape, side and path, normals within 25 degrees, and neither far out of
    /// the other's tangent plane. Best effort: a narrow slit in one plane is not seen.
    pub(crate) fn continues(&self, other: &Self) -> bool {
        const COS_25_DEG: f64 = 0.906;
        /// Sine of the steepest chord between places of one smooth piece.
        const STEEPEST: f64 = 0.35;
        let step = other.position - self.position;
        let height = step.dot(self.normal.to_vector()).abs();
        self.shape == other.shape
            && self.back == other.back
            && self.path == other.path
            && self.normal.dot(other.normal) > COS_25_DEG
            && height <= STEEPEST * step.length()
    }
}

/// A view in physical units: several samples a pixel and what its middle shows.
#[derive(Clone, Debug, PartialEq)]
pub struct LuminanceImage {
    size: Size,
    samples_per_pixel: u32,
    samples: Vec<Seen>,
    middles: Vec<Option<Middle>>,
    has_shadow_noise: bool,
}

/// The middle of a pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Middle {
    pub(crate) surface: Surface,
    /// Mean over the samples of the pixel on the same piece of surface.
    pub(crate) reading: Option<Reading>,
    /// Standard error of that mean, from the spread of the samples, lx: shadow rays are few.
    pub(crate) noise_lx: f32,
}

impl LuminanceImage {
    /// Pixel by pixel, rows from the top; `samples` pixel after pixel. Readings of the light of
    /// emitting surfaces have the noise of a few shadow rays.
    pub(crate) fn new(
        size: Size,
        samples: Vec<Seen>,
        middles: Vec<Option<Middle>>,
        has_shadow_noise: bool,
    ) -> Self {
        debug_assert!(samples.len().is_multiple_of(size.pixels()));
        let samples_per_pixel = (samples.len() / size.pixels()) as u32;
        Self { size, samples_per_pixel, samples, middles, has_shadow_noise }
    }

    /// Width and height.
    pub fn size(&self) -> Size {
        self.size
    }

    /// Takes up another view of the same, as one of `rounds` in all: what is seen becomes the mean over the rounds.
    pub(crate) fn take_up(&mut self, other: &Self, rounds: u32) {
        let share = 1.0 / rounds as f32;
        let samples = self.samples.iter_mut().zip(&other.samples);
        samples.for_each(|(own, other)| own.take_up(other, share));
        for (own, other) in self.middles.iter_mut().zip(&other.middles) {
            if let (Some(own), Some(other)) = (own.as_mut(), other) {
                if let (Some(reading), Some(more)) = (own.reading.as_mut(), &other.reading) {
                    reading.take_up(more, share);
                }
                // Independent noise of means with their shares.
                own.noise_lx = ((1.0 - share) * own.noise_lx).hypot(share * other.noise_lx);
            }
        }
    }

    /// Samples of each pixel.
    pub fn samples_per_pixel(&self) -> u32 {
        self.samples_per_pixel
    }

    /// The samples of a pixel, counted in rows from the top left.
    ///
    /// # Panics
    /// Beyond the last pixel, as all functions of a pixel's index.
    pub fn samples(&self, pixel: usize) -> &[Seen] {
        let count = self.samples_per_pixel as usize;
        &self.samples[pixel * count..(pixel + 1) * count]
    }

    /// Mean luminance of a pixel, cd/m2.
    pub fn luminance_cd_m2(&self, pixel: usize) -> Rgb {
        let sum: Rgb = self.samples(pixel).iter().map(Seen::luminance).sum();
        sum / f64::from(self.samples_per_pixel)
    }

    /// Illuminance of the surface in the middle of a pixel: the mean over the samples on it.
    pub fn reading(&self, pixel: usize) -> Option<Reading> {
        self.middles[pixel]?.reading
    }

    /// Whether readings may have the noise of shadow rays.
    pub(crate) fn has_shadow_noise(&self) -> bool {
        self.has_shadow_noise
    }

    /// What the middle of a pixel shows.
    pub(crate) fn middle(&self, pixel: usize) -> Option<&Middle> {
        self.middles[pixel].as_ref()
    }

    /// The surface in the middle of a pixel.
    pub fn surface(&self, pixel: usize) -> Option<&Surface> {
        self.middles[pixel].as_ref().map(|m| &m.surface)
    }
}
