//! The values of a lightmap.

use super::layout::Layout;
use super::stitch::SeamReport;
use crate::units::Rgb;

/// What a texel stands for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Cover {
    /// No surface, and too far from any to be read.
    #[default]
    Empty,
    /// No surface: filled from its neighbours, because lookups at the border of a chart read it.
    Filled,
    /// A surface of which the map knows nothing; filled from its neighbours.
    Unknown,
    /// A surface with a known value.
    Known,
}

/// One texel with a known value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Texel {
    /// Mean illuminance of the surface that it covers, adjusted at seams, lx.
    pub illuminance_lx: Rgb,
    /// Standard error of its photometric value, lx.
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
    /// Standard errors of known texels, lx; not meant for others.
    pub(super) standard_errors_lx: Vec<f32>,
    /// Shares of texels that known surface covers.
    pub(super) coverage: Vec<f32>,
    /// How well both sides of seams agree.
    pub seams: SeamReport,
    /// Readings of the map behind all texels.
    pub readings: u64,
}

impl Lightmap {
    /// A texel by its number, where its value is known.
    pub fn texel(&self, index: usize) -> Option<Texel> {
        (self.covers[index] == Cover::Known).then(|| Texel {
            illuminance_lx: Rgb(self.shown_lx[index].map(f64::from)),
            standard_error_lx: f64::from(self.standard_errors_lx[index]),
            coverage: f64::from(self.coverage[index]),
        })
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
