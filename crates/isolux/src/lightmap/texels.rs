//! The values of a lightmap.

use super::cover;
use super::layout::{Layout, Side};
use super::seam_report::SeamReport;
use crate::units::Rgb;

/// What a texel stands for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Cover {
    /// No surface, and too far from any to be read.
    #[default]
    Empty,
    /// No surface: filled from its neighbours, because lookups at the border of a chart read it.
    Filled,
    /// A surface of which the map knows nothing: filled from its neighbours within the padding of what is known, else black.
    Unknown,
    /// A surface with a known value.
    Known,
}

/// The standard error, lx, of texels of a map whose error is not known.
pub(super) const UNKNOWN_ERROR: f32 = f32::MAX;

/// One texel with a known value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Texel {
    /// Mean illuminance of the surface that it covers, adjusted at seams, lx.
    pub illuminance_lx: Rgb,
    /// Standard error of its photometric value, lx; infinite where it is not known.
    pub standard_error_lx: f64,
    /// Share of the texel that known surface covers.
    pub coverage: f64,
}

/// Illuminance as texels.
#[derive(Clone, Debug, PartialEq)]
pub struct Lightmap {
    /// Where surfaces lie.
    pub layout: Layout,
    /// Illuminance of every texel as lookups read it, row by row and page by page, lx; zero where empty.
    pub shown_lx: Vec<[f32; 3]>,
    /// What every texel stands for.
    pub covers: Vec<Cover>,
    /// Index of the side that covers most of a texel, or that it was filled beside; not meant for empty ones.
    pub(super) owners: Vec<u32>,
    /// Standard errors of known texels, lx; not meant for others.
    pub(super) standard_errors_lx: Vec<f32>,
    /// Shares of texels that known surface covers.
    pub(super) coverage: Vec<f32>,
    /// How well both sides of seams agree.
    pub seams: SeamReport,
    /// Readings of the map behind all texels.
    pub readings: u64,
    /// Texels that were read in a cheaper way than the map allows, as time ran out.
    pub coarse: u64,
}

impl Lightmap {
    /// The values of a page as lookups read them, row by row.
    pub fn page(&self, page: u32) -> &[[f32; 3]] {
        let first = self.layout.index(page, 0, 0);
        &self.shown_lx[first..first + self.layout.width as usize * self.layout.height as usize]
    }

    /// A texel by its number, where its value is known.
    pub fn texel(&self, index: usize) -> Option<Texel> {
        (self.covers[index] == Cover::Known).then(|| Texel {
            illuminance_lx: Rgb(self.shown_lx[index].map(f64::from)),
            standard_error_lx: match self.standard_errors_lx[index] {
                UNKNOWN_ERROR => f64::INFINITY,
                known => f64::from(known),
            },
            coverage: f64::from(self.coverage[index]),
        })
    }

    /// The side that covers most of a texel, or beside which it lies, and the barycentric weights (u, v) of its centre
    /// on the triangle, or of the nearest place there. `None` where it is empty.
    pub fn place(&self, index: usize) -> Option<(&Side, [f64; 2])> {
        if self.covers[index] == Cover::Empty {
            return None;
        }
        let (width, height) = (self.layout.width as usize, self.layout.height as usize);
        let centre = [index % width, index / width % height].map(|at| at as f64 + 0.5);
        let side = self.owners[index];
        Some((&self.layout.sides[side as usize], cover::weights(&self.layout, side, centre)))
    }

    /// What a bilinear lookup at a place in texels gives, lx.
    pub fn lookup(&self, page: u32, at: [f64; 2]) -> Rgb {
        let parts = self.layout.bilinear(page, at);
        parts.into_iter().map(|(texel, weight)| self.rgb(texel) * weight).sum()
    }

    /// Number of texels that stand for the same.
    pub fn count(&self, cover: Cover) -> usize {
        self.covers.iter().filter(|&&found| found == cover).count()
    }

    fn rgb(&self, index: usize) -> Rgb {
        Rgb(self.shown_lx[index].map(f64::from))
    }
}
