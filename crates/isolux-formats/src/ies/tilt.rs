//! How a lamp's flux depends on the tilt of the luminaire.

use super::numbers::Numbers;
use crate::Problem;

/// Angles a tilt table may have; the standard's own examples have a dozen.
const MAX_TILT_ANGLES: u32 = 1000;

/// What `TILT=` says.
#[derive(Clone, Debug, PartialEq)]
pub enum Tilt {
    /// `TILT=NONE`: the flux does not change.
    None,
    /// `TILT=INCLUDE`: a table in the file itself.
    Included(TiltTable),
    /// `TILT=name`: a table in a file beside it.
    File(String, TiltTable),
}

/// Factors on the flux by angle.
#[derive(Clone, Debug, PartialEq)]
pub struct TiltTable {
    /// How the lamp sits in the luminaire.
    pub geometry: LampGeometry,
    /// Angles, degrees, increasing, within 0 to 180.
    pub angles_deg: Vec<f64>,
    /// Factor at each angle.
    pub factors: Vec<f64>,
}

/// Position of the lamp in a luminaire aimed straight down.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LampGeometry {
    /// Upright, base up or down.
    Vertical,
    /// Level, and level still when the luminaire is tilted.
    HorizontalFixed,
    /// Level, and tilting with the luminaire.
    HorizontalTilting,
}

impl Tilt {
    /// Factor on the flux when the luminaire is tilted by an angle from its base position:
    /// linear between the angles given, constant beyond them.
    pub fn factor(&self, angle_deg: f64) -> f64 {
        match self {
            Self::None => 1.0,
            Self::Included(table) | Self::File(_, table) => table.factor(angle_deg),
        }
    }
}

impl TiltTable {
    fn factor(&self, angle_deg: f64) -> f64 {
        let above = self.angles_deg.partition_point(|&a| a <= angle_deg);
        let low = above.saturating_sub(1);
        let high = above.min(self.angles_deg.len() - 1);
        let span = self.angles_deg[high] - self.angles_deg[low];
        let weight = if span > 0.0 { (angle_deg - self.angles_deg[low]) / span } else { 0.0 };
        self.factors[low] + (self.factors[high] - self.factors[low]) * weight
    }

    /// Geometry, count, angles, factors.
    pub(super) fn parse(numbers: &mut Numbers) -> Result<Self, Problem> {
        let geometry = match numbers.count("the lamp-to-luminaire geometry", 1, 3)? {
            1 => LampGeometry::Vertical,
            2 => LampGeometry::HorizontalFixed,
            _ => LampGeometry::HorizontalTilting,
        };
        let count = numbers.count("the number of tilt angles", 1, MAX_TILT_ANGLES)?;
        let angles_deg = numbers.angles("tilt angle", count, [0.0, 180.0])?;
        let mut factors = Vec::new();
        for index in 1..=count {
            let name = || format!("tilt factor {index} of {count}");
            factors.push(numbers.number_that(name, "zero or more", |f| f >= 0.0)?);
        }
        Ok(Self { geometry, angles_deg, factors })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn factors_are_linear_between_angles_and_constant_beyond() {
        let table = TiltTable {
            geometry: LampGeometry::Vertical,
            angles_deg: vec![10.0, 30.0, 90.0],
            factors: vec![1.0, 0.5, 0.8],
        };
        for (angle, factor) in [(0.0, 1.0), (10.0, 1.0), (20.0, 0.75), (60.0, 0.65), (170.0, 0.8)] {
            // Two roundings.
            assert!((table.factor(angle) - factor).abs() < 1e-15, "{angle}");
        }
    }
}
