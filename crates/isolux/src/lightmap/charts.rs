//! What cuts surfaces into charts and lays them out: a small trait, so that the library behind it can be replaced.

use std::fmt;

/// Triangles to be laid out together: one side of one shape.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Patch {
    /// Vertices, m from the origin of the scene's ray kernel, each place once.
    pub positions: Vec<[f32; 3]>,
    /// Corners of triangles, counter-clockwise seen from the lit side.
    pub triangles: Vec<[u32; 3]>,
    /// Whether a chart must end at the edge from corner k to the next: there the surface has a crease.
    pub creases: Vec<[bool; 3]>,
}

/// What is asked of a layout.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct UnwrapRequest {
    /// Texels a metre.
    pub texels_per_m: f64,
    /// Width and height of a page at most, texels.
    pub page: u32,
    /// Texels around each chart.
    pub padding: u32,
}

/// Charts, laid out in pages.
#[derive(Clone, Debug, PartialEq)]
pub struct Unwrapped {
    /// Texels across a page.
    pub width: u32,
    /// Texels down.
    pub height: u32,
    /// Pages.
    pub pages: u32,
    /// Charts.
    pub charts: u32,
    /// Texels a metre of the chart that has the fewest: as asked, or less where one is larger than a page.
    pub least_texels_per_m: f64,
    /// For every patch, for every triangle, where it lies.
    pub placed: Vec<Vec<Placed>>,
}

/// Where a triangle lies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placed {
    /// The page.
    pub page: u32,
    /// Of its corners, 0 to 1 over the page. Triangles too thin to be laid out are points.
    pub uvs: [[f32; 2]; 3],
}

/// Why there is no layout.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum UnwrapError {
    /// More texels than any layout can have.
    TooLarge,
    /// Anything else, as the library says it.
    Other(String),
}

impl fmt::Display for UnwrapError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::TooLarge => write!(f, "the density asks for more texels than a layout can have"),
            Self::Other(why) => write!(f, "{why}"),
        }
    }
}

/// Cuts patches into charts and lays them out without overlap. The same input gives the same bits.
pub trait Unwrapper {
    /// Charts of all patches, together in as few pages as it can.
    fn unwrap(&self, patches: &[Patch], request: &UnwrapRequest) -> Result<Unwrapped, UnwrapError>;
}
