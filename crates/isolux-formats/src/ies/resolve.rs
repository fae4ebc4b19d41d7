//! An [`IesFile`] to the distribution an engine uses.

use super::audit;
use super::{IesFile, PhotometricType, across};
use crate::{Problem, counted};
use isolux::photometry::{IntensityDistribution, PhotometricWeb, Symmetry, WebError};
use std::sync::Arc;

impl IesFile {
    /// What is odd about its flux, if anything: of no concern to who gives it another.
    pub(crate) fn doubt_of_flux(&self) -> Option<Problem> {
        audit::too_bright(self)
    }

    /// The intensity distribution of the luminaire in its base position, in candela: the table
    /// completed by its symmetry, times [`Self::intensity_factor`].
    ///
    /// LM-63 counts horizontal angles counterclockwise as seen from above with the 0 degree plane
    /// along the length: C90 is +y in the luminaire's frame. Tables of types A and B keep their own
    /// system of angles, see [`isolux::photometry::AngleSystem`]; angles given from 0 on are mirrored.
    pub fn resolve(&self) -> Result<IntensityDistribution, Problem> {
        let factor = self.intensity_factor();
        let web = if self.photometric_type == PhotometricType::C {
            let symmetry = self.symmetry()?;
            let candela = self.candela.iter().map(|cd| cd * factor).collect();
            let (planes, gammas) = (self.horizontal_deg.clone(), self.vertical_deg.clone());
            PhotometricWeb::with_symmetry(planes, gammas, candela, symmetry)
        } else {
            across::web(self, factor)
        };
        let web = web.map_err(|error| self.no_web(&error))?;
        Ok(IntensityDistribution::Web(Arc::new(web)))
    }

    /// Why the table is no distribution, in the words of the standard.
    fn no_web(&self, error: &WebError) -> Problem {
        let WebError::TooFewAngles { .. } = error else {
            return self.problem(self.lines.vertical, error.to_string(), "correct the table");
        };
        let [horizontal, vertical] = [self.horizontal_deg.len(), self.vertical_deg.len()];
        let what = format!(
            "{} beside {} vertical in a table of type {:?}, which spans no part of space",
            counted(horizontal, "horizontal angle", "horizontal angles"),
            vertical,
            self.photometric_type
        );
        let remedy = match self.photometric_type {
            PhotometricType::C => "give at least two vertical angles",
            PhotometricType::A | PhotometricType::B => {
                "give at least two of each; one horizontal angle alone is for type C"
            }
        };
        self.problem(self.lines.horizontal, what, remedy)
    }

    /// Which part of the circle the horizontal angles of type C give.
    pub fn symmetry(&self) -> Result<Symmetry, Problem> {
        let angles = &self.horizontal_deg;
        let ends = (angles.first().copied(), angles.last().copied());
        let (Some(first), Some(last)) = ends else { return Ok(Symmetry::None) };
        match (first, last) {
            _ if angles.len() == 1 => Ok(Symmetry::Axial),
            (0.0, 90.0) => Ok(Symmetry::AboutBoth),
            (0.0, 180.0) => Ok(Symmetry::AboutC0C180),
            (90.0, 270.0) => Ok(Symmetry::AboutC90C270),
            (0.0, 360.0) => Ok(Symmetry::None),
            // The closing plane left out, as many programs do.
            (0.0, last) if 360.0 - last <= 1.5 * (last - angles[angles.len() - 2]) => {
                Ok(Symmetry::None)
            }
            _ => Err(self.problem(
                self.lines.horizontal,
                format!("horizontal angles from {first} to {last} degrees cover no known part"),
                "give 0 alone, 0 to 90, 0 to 180, 90 to 270 or 0 to 360 degrees",
            )),
        }
    }

    pub(super) fn problem(
        &self,
        line: usize,
        what: impl Into<String>,
        remedy: impl Into<String>,
    ) -> Problem {
        Problem::new(&self.file, format!("line {line}"), what, remedy)
    }
}
