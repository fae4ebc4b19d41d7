//! Where lit sides lie in the pages of a lightmap.

use serde::{Deserialize, Serialize};

/// Densities differ by no more than this share if they are the same: coordinates of charts are `f32`.
pub(super) const ROUNDING: f64 = 1e-3;

/// The charts of all lit sides. Pages are of one size; texel row 0 is at `v` = 0, the upper edge of a picture.
#[derive(Clone, Debug, PartialEq)]
pub struct Layout {
    /// Texels across.
    pub width: u32,
    /// Texels down.
    pub height: u32,
    /// Number of pages.
    pub pages: u32,
    /// Density in the mean over all surfaces, texels a metre.
    pub texels_per_m: f64,
    /// Density of the chart that has the least of those laid out anew: less than others where it is larger than a page.
    pub least_texels_per_m: f64,
    /// Density that was asked for, or comes of the size of the scene: where places are kept, they decide.
    pub asked_texels_per_m: f64,
    /// Texels around each chart that belong to no other.
    pub padding: u32,
    /// Number of charts.
    pub charts: u32,
    /// What became of the places in a lightmap that the file has.
    pub own_places: OwnPlaces,
    /// The sides that carry the map, in the order of the triangles of the scene, the front before the back.
    pub sides: Vec<Side>,
}

/// Whether surfaces lie where their file puts them.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum OwnPlaces {
    /// The file has no places in a lightmap.
    #[default]
    None,
    /// They are kept: the first page is that of the file.
    Kept,
    /// They cannot be used, and why; surfaces are laid out anew.
    Refused(String),
}

/// One side of a triangle of the scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Side {
    /// The triangle.
    pub triangle: u32,
    /// Whether it is the back of it.
    pub back: bool,
    /// The page it lies on.
    pub page: u32,
    /// Coordinates of its corners, in their order in the scene, 0 to 1 over the page.
    pub uvs: [[f32; 2]; 3],
}

impl Side {
    /// Whether all of it lies at one place: of dark sides, and of triangles too thin to be laid out.
    pub fn is_point(&self) -> bool {
        self.uvs == [self.uvs[0]; 3]
    }

    /// The share of its page that it covers.
    pub(super) fn share(&self) -> f64 {
        let [a, b, c] = self.uvs.map(|uv| uv.map(f64::from));
        0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])).abs()
    }
}

impl Layout {
    /// Texels that surfaces cover.
    pub(super) fn covered(&self) -> f64 {
        let page = f64::from(self.width) * f64::from(self.height);
        page * self.sides.iter().map(Side::share).sum::<f64>()
    }

    /// Whether some surfaces have fewer texels than were asked for: pages end before their charts do.
    pub fn is_short(&self) -> bool {
        self.least_texels_per_m < self.asked_texels_per_m * (1.0 - ROUNDING)
    }

    /// Texels of all pages.
    pub fn texel_count(&self) -> usize {
        self.width as usize * self.height as usize * self.pages as usize
    }

    /// The number of a texel: row by row, page by page.
    pub fn index(&self, page: u32, x: u32, y: u32) -> usize {
        (page as usize * self.height as usize + y as usize) * self.width as usize + x as usize
    }

    /// Corners of a side in texels; texel (x, y) reaches from there to (x + 1, y + 1).
    pub fn corners(&self, side: &Side) -> [[f64; 2]; 3] {
        let size = [f64::from(self.width), f64::from(self.height)];
        side.uvs.map(|uv| [f64::from(uv[0]) * size[0], f64::from(uv[1]) * size[1]])
    }

    /// The four texels that a bilinear lookup at a place in texels reads, with their weights. Coordinates beyond the
    /// page read its border.
    pub fn bilinear(&self, page: u32, [x, y]: [f64; 2]) -> [(usize, f64); 4] {
        let (x, y) = (x - 0.5, y - 0.5);
        let (x0, y0) = (x.floor(), y.floor());
        let (fx, fy) = (x - x0, y - y0);
        let inside = |at: f64, size: u32| at.clamp(0.0, f64::from(size - 1)) as u32;
        let at = |dx: f64, dy: f64| {
            self.index(page, inside(x0 + dx, self.width), inside(y0 + dy, self.height))
        };
        [
            (at(0.0, 0.0), (1.0 - fx) * (1.0 - fy)),
            (at(1.0, 0.0), fx * (1.0 - fy)),
            (at(0.0, 1.0), (1.0 - fx) * fy),
            (at(1.0, 1.0), fx * fy),
        ]
    }
}
