//! What a view is asked for.

use crate::image::{MAX_PIXELS, MAX_SAMPLES, Size};

/// A place of a triangle of a scene, on one side: barycentric weights `(1 - u - v, u, v)`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfacePoint {
    /// Index of the triangle.
    pub triangle: u32,
    /// Whether it is seen from the back.
    pub back: bool,
    /// Weight of the second corner.
    pub u: f64,
    /// Weight of the third corner.
    pub v: f64,
    /// Whether it is seen by gloss, which blurs it, or faintly in a pane: a cheap reading is then as
    /// good as a fine one.
    pub blurred: bool,
    /// The pixel that it is seen in, counted in rows from the top left.
    pub pixel: usize,
    /// Mirrors and panes on the way, as a number that differs when they differ.
    pub path: u32,
}

/// How finely a view is traced.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TraceSettings {
    /// Samples along each side of a pixel: 3 makes 9 a pixel.
    pub samples_per_side: u32,
    /// Mirrors, panes and glossy surfaces followed in a row; behind the last one is black.
    pub depth: u32,
    /// Facets looked along in a pixel at a glossy surface that is seen directly, shared out among its
    /// samples; one a sample behind a mirror.
    pub gloss_samples: u32,
    /// Whether glossy surfaces look at luminaires, too.
    pub highlights: bool,
    /// Whether the camera looks through the black backs of one-sided materials, into a room from
    /// outside. Reflections never do.
    pub through_black_backs: bool,
    /// Number of the random numbers: views with different numbers have independent noise.
    pub round: u64,
    /// The part of a picture that the view is; `None` for all of it.
    pub window: Option<Window>,
}

/// A part of a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Window {
    /// The size of the whole picture.
    pub of: Size,
    /// Pixels from its left edge.
    pub left: u32,
    /// Pixels from its upper edge.
    pub top: u32,
}

impl TraceSettings {
    /// The most pixels that a view may have.
    pub fn most_pixels(&self) -> u64 {
        let samples = u64::from(self.samples_per_side).pow(2).max(1);
        MAX_PIXELS.min(MAX_SAMPLES / samples)
    }

    /// One sample a pixel, in its middle.
    pub const DRAFT: Self = Self { samples_per_side: 1, ..Self::FINE };
    /// Smooth outlines.
    pub const FINE: Self = Self {
        samples_per_side: 3,
        depth: 8,
        gloss_samples: 9,
        highlights: true,
        through_black_backs: false,
        round: 0,
        window: None,
    };
}

impl Default for TraceSettings {
    fn default() -> Self {
        Self::FINE
    }
}
