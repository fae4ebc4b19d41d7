//! Finished pictures.

use crate::error::ViewError;
use crate::image::Size;
use std::sync::Arc;

/// Drawn in charts where a surface carries no known value: a mid grey that no colour map contains.
pub const UNKNOWN: [u8; 3] = [128, 128, 128];

/// Pixels, rows from the top.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Picture {
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
    /// One colour a pixel.
    pub rgb: Vec<[u8; 3]>,
    /// The ICC profile that says what the colours are; `None` for sRGB (IEC 61966-2-1).
    pub icc: Option<Arc<[u8]>>,
}

impl Picture {
    /// A picture of one sRGB colour.
    pub fn filled(size: Size, colour: [u8; 3]) -> Self {
        let (width, height) = (size.width(), size.height());
        Self { width, height, rgb: vec![colour; size.pixels()], icc: None }
    }

    /// The colour at a pixel; `None` outside.
    pub fn pixel(&self, x: u32, y: u32) -> Option<[u8; 3]> {
        let inside = x < self.width && y < self.height;
        inside.then(|| self.rgb[(y * self.width + x) as usize])
    }

    /// Two pictures side by side, the shorter one at the top.
    pub(crate) fn beside(self, right: &Self) -> Result<Self, ViewError> {
        let size = Size::new(self.width + right.width, self.height.max(right.height))?;
        let mut joined = Self::filled(size, [0; 3]);
        for (part, left) in [(&self, 0), (right, self.width)] {
            for y in 0..part.height {
                let row = (y * part.width) as usize;
                let at = (y * joined.width + left) as usize;
                let width = part.width as usize;
                joined.rgb[at..at + width].copy_from_slice(&part.rgb[row..row + width]);
            }
        }
        Ok(joined)
    }

    /// Lays a colour over a pixel with the given opacity; nothing outside.
    pub(crate) fn blend(&mut self, x: i64, y: i64, colour: [u8; 3], opacity: f64) {
        let inside =
            (0..i64::from(self.width)).contains(&x) && (0..i64::from(self.height)).contains(&y);
        if !inside {
            return;
        }
        let pixel = &mut self.rgb[y as usize * self.width as usize + x as usize];
        for (under, over) in pixel.iter_mut().zip(colour) {
            let mixed = f64::from(*under) * (1.0 - opacity) + f64::from(over) * opacity;
            *under = (mixed + 0.5) as u8;
        }
    }

    /// Fills the part of a rectangle that lies inside.
    pub(crate) fn fill(&mut self, left: i64, top: i64, width: i64, height: i64, colour: [u8; 3]) {
        for y in top..top + height {
            for x in left..left + width {
                self.blend(x, y, colour, 1.0);
            }
        }
    }
}
