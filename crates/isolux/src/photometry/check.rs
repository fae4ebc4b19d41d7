//! What makes a table a web.

use super::AngleSystem;

/// Values a table may hold: a quarter of a degree in both angles, four times over.
const MAX_VALUES: usize = 1 << 22;

/// Angles closer than this are the same one, degrees: no goniometer tells them apart.
const MIN_STEP_DEG: f64 = 1e-6;

/// Highest intensity accepted, cd; the sun has 3e27. Sums of such numbers stay finite.
pub(super) const MAX_INTENSITY_CD: f64 = 1e30;

/// Why a table is not a distribution.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum WebError {
    /// There is no plane (in the systems A and B, only one), or fewer than two polar angles: they span
    /// no solid angle.
    #[error("{planes} planes and {gammas} polar angles; at least {least} and 2 are needed")]
    TooFewAngles {
        /// Planes given.
        planes: usize,
        /// Polar angles given.
        gammas: usize,
        /// Planes needed.
        least: usize,
    },
    /// More values than any luminaire is measured at.
    #[error("{planes} planes times {gammas} gamma angles are more than {MAX_VALUES} intensities")]
    TooLarge {
        /// Planes given.
        planes: usize,
        /// Gamma angles given.
        gammas: usize,
    },
    /// The number of values is not planes times angles.
    #[error("{found} intensities for {expected} places of the table")]
    WrongCount {
        /// Values given.
        found: usize,
        /// Planes times angles.
        expected: usize,
    },
    /// A plane is not an angle from 0 to 360 degrees; in the systems A and B, to 180.
    #[error("plane {index} lies at {angle_deg} degrees, beyond its range")]
    PlaneOutOfRange {
        /// Which, from 0.
        index: usize,
        /// The angle, degrees.
        angle_deg: f64,
    },
    /// A gamma angle is not from 0 to 180 degrees.
    #[error("gamma angle {index} is {angle_deg} degrees, not within 0 to 180")]
    GammaOutOfRange {
        /// Which, from 0.
        index: usize,
        /// The angle, degrees.
        angle_deg: f64,
    },
    /// A plane does not lie beyond the one before.
    #[error("plane {index} at {angle_deg} degrees does not lie beyond the one before it")]
    PlanesNotIncreasing {
        /// Which, from 0.
        index: usize,
        /// The angle, degrees.
        angle_deg: f64,
    },
    /// A gamma angle is not larger than the one before.
    #[error("gamma angle {index}, {angle_deg} degrees, is not larger than the one before it")]
    GammasNotIncreasing {
        /// Which, from 0.
        index: usize,
        /// The angle, degrees.
        angle_deg: f64,
    },
    /// A value is negative, not a number, or beyond any source of light.
    #[error("{intensity_cd} cd at plane {plane}, gamma angle {gamma} is not from 0 to 1e30")]
    BadIntensity {
        /// Plane, from 0.
        plane: usize,
        /// Gamma angle, from 0.
        gamma: usize,
        /// The value, cd.
        intensity_cd: f64,
    },
}

/// The first reason why a table is no web.
pub(super) fn check(
    system: AngleSystem,
    planes_deg: &[f64],
    gammas_deg: &[f64],
    candela: &[f64],
) -> Result<(), WebError> {
    let (planes, gammas) = (planes_deg.len(), gammas_deg.len());
    let (least, limit) = if system.is_c() { (1, 360.0) } else { (2, 180.0) };
    if planes < least || gammas < 2 {
        return Err(WebError::TooFewAngles { planes, gammas, least });
    }
    let expected = planes.saturating_mul(gammas);
    if expected > MAX_VALUES {
        return Err(WebError::TooLarge { planes, gammas });
    }
    if candela.len() != expected {
        return Err(WebError::WrongCount { found: candela.len(), expected });
    }
    if let Some((index, angle_deg)) = out_of_range(planes_deg, limit) {
        return Err(WebError::PlaneOutOfRange { index, angle_deg });
    }
    if let Some((index, angle_deg)) = out_of_range(gammas_deg, 180.0) {
        return Err(WebError::GammaOutOfRange { index, angle_deg });
    }
    if let Some((index, angle_deg)) = not_increasing(planes_deg) {
        return Err(WebError::PlanesNotIncreasing { index, angle_deg });
    }
    if let Some((index, angle_deg)) = not_increasing(gammas_deg) {
        return Err(WebError::GammasNotIncreasing { index, angle_deg });
    }
    match candela.iter().position(|cd| !(0.0..=MAX_INTENSITY_CD).contains(cd)) {
        None => Ok(()),
        Some(at) => Err(WebError::BadIntensity {
            plane: at / gammas,
            gamma: at % gammas,
            intensity_cd: candela[at],
        }),
    }
}

fn out_of_range(angles: &[f64], limit: f64) -> Option<(usize, f64)> {
    angles.iter().copied().enumerate().find(|(_, angle)| !(0.0..=limit).contains(angle))
}

fn not_increasing(angles: &[f64]) -> Option<(usize, f64)> {
    let index = angles.windows(2).position(|pair| pair[1] < pair[0] + MIN_STEP_DEG)? + 1;
    Some((index, angles[index]))
}
