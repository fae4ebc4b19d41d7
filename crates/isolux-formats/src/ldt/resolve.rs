//! An [`LdtFile`] to the distribution an engine uses.

use super::audit;
use super::{LampSet, LdtFile, LdtSymmetry};
use crate::Problem;
use crate::ies::LuminousOpening;
use isolux::photometry::{IntensityDistribution, PhotometricWeb, Symmetry, WebError};
use std::sync::Arc;

impl LdtSymmetry {
    /// Indices of the planes whose intensities are given, in the order of the file, out of all.
    pub(crate) fn given(self, planes: usize) -> Vec<usize> {
        let (first, count) = match self {
            Self::None => (0, planes),
            Self::Axial => (0, 1),
            Self::AboutC0C180 => (0, planes / 2 + 1),
            Self::AboutC90C270 => (3 * planes / 4, planes / 2 + 1),
            Self::AboutBoth => (0, planes / 4 + 1),
        };
        (first..first + count).map(|k| k % planes).collect()
    }

    /// Whether a circle of planes has those that the symmetry needs where it needs them.
    pub(crate) fn fits(self, planes_deg: &[f64]) -> bool {
        let count = planes_deg.len();
        let at = |quarter: usize| planes_deg.get(quarter * count / 4).copied();
        count.is_multiple_of(self.divides_into())
            && self.corners().iter().all(|&(quarter, angle)| at(quarter) == Some(angle))
    }

    /// What the number of planes of the circle must be a multiple of.
    pub(super) fn divides_into(self) -> usize {
        match self {
            Self::None | Self::Axial => 1,
            Self::AboutC0C180 => 2,
            Self::AboutC90C270 | Self::AboutBoth => 4,
        }
    }

    /// Where the planes at 0, 1/4, 1/2 and 3/4 of the list must lie for the symmetry to hold.
    fn corners(self) -> &'static [(usize, f64)] {
        match self {
            Self::None | Self::Axial => &[],
            Self::AboutC0C180 => &[(0, 0.0), (2, 180.0)],
            Self::AboutC90C270 => &[(0, 0.0), (1, 90.0), (3, 270.0)],
            Self::AboutBoth => &[(0, 0.0), (1, 90.0)],
        }
    }
}

impl LdtFile {
    /// What is odd about its flux, if anything: of no concern to who gives it another.
    pub(crate) fn doubt_of_flux(&self) -> Option<Problem> {
        audit::output_ratio(self)
    }

    /// The intensity distribution with the first lamp set, in candela.
    pub fn resolve(&self) -> Result<IntensityDistribution, Problem> {
        match self.lamp_sets.first() {
            Some(set) => self.resolve_with(set),
            None => Err(self.problem(self.lines.lamps, "there is no lamp set", "add one")),
        }
    }

    /// The intensity distribution with a lamp set, in candela: the table, completed by its
    /// symmetry, times the conversion factor (0 counts as 1) and the thousands of lumens.
    pub fn resolve_with(&self, set: &LampSet) -> Result<IntensityDistribution, Problem> {
        if set.flux_lm <= 0.0 {
            return Err(self.problem(
                self.lines.lamps,
                "the flux of the lamps is 0, so that cd per 1000 lm mean nothing",
                "give the flux of the lamps, or of the luminaire with a negative number of lamps",
            ));
        }
        let conversion = if self.conversion_factor == 0.0 { 1.0 } else { self.conversion_factor };
        let factor = conversion * set.flux_lm / 1000.0;
        let (planes, rows) = self.given_planes()?;
        let candela = rows.concat().iter().map(|cd| cd * factor).collect();
        let symmetry = match self.symmetry {
            LdtSymmetry::None => Symmetry::None,
            LdtSymmetry::Axial => Symmetry::Axial,
            LdtSymmetry::AboutC0C180 => Symmetry::AboutC0C180,
            LdtSymmetry::AboutC90C270 => Symmetry::AboutC90C270,
            LdtSymmetry::AboutBoth => Symmetry::AboutBoth,
        };
        let web = PhotometricWeb::with_symmetry(planes, self.gammas_deg.clone(), candela, symmetry);
        let web = web.map_err(|error| {
            let what = match error {
                WebError::TooFewAngles { planes, gammas, .. } => {
                    format!(
                        "{planes} C planes of {gammas} gamma angles, which span no part of space"
                    )
                }
                other => other.to_string(),
            };
            self.problem(self.lines.planes, what, "correct the table")
        })?;
        Ok(IntensityDistribution::Web(Arc::new(web)))
    }

    /// The luminous area with its greatest height; length along C0-C180, width along C90-C270, as in LM-63.
    pub fn opening(&self) -> LuminousOpening {
        let [along_c90, along_c0] = self.sizes.luminous_area_m;
        let height_m = self.sizes.luminous_heights_m.into_iter().fold(0.0, f64::max);
        if along_c0 == 0.0 && along_c90 > 0.0 {
            LuminousOpening::disc(along_c90, height_m)
        } else {
            LuminousOpening::rectangle([along_c0, along_c90, height_m])
        }
    }

    /// The planes given and their rows, in increasing order.
    fn given_planes(&self) -> Result<(Vec<f64>, Vec<&[f64]>), Problem> {
        for &(quarter, angle) in self.symmetry.corners() {
            let index = quarter * self.planes_deg.len() / 4;
            if self.planes_deg.get(index) != Some(&angle) {
                return Err(self.problem(
                    self.lines.planes + index,
                    format!("plane {} should lie at {angle} degrees", index + 1),
                    "list all planes of the circle, also those that follow from symmetry",
                ));
            }
        }
        let given = self.symmetry.given(self.planes_deg.len());
        let rows = self.candela_per_klm.chunks(self.gammas_deg.len());
        let mut planes: Vec<_> = given.iter().map(|&k| self.planes_deg[k]).zip(rows).collect();
        planes.sort_by(|a, b| a.0.total_cmp(&b.0));
        Ok(planes.into_iter().unzip())
    }

    pub(super) fn problem(&self, line: usize, what: impl Into<String>, remedy: &str) -> Problem {
        Problem::new(&self.file, format!("line {line}"), what, remedy)
    }
}
