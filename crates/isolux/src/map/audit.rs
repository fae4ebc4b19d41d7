//! What an independent test has found of a map.

use serde::{Deserialize, Serialize};

/// An audit of a map: places drawn on its surfaces, independent of its elements, are read as users read them and
/// estimated afresh by complete paths, which know no map. Squared differences less the variance of the paths estimate
/// the true error without bias.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Audit {
    /// Which audit of its run this is, counted from one; each has places and paths of its own.
    pub number: u32,
    /// Places that were compared, drawn by area.
    pub places: u64,
    /// Places drawn by area of which the map knows nothing; they are not compared.
    pub unknown_places: u64,
    /// Complete paths traced, those of all places together.
    pub paths: u64,
    /// Rays of readings and paths, about.
    pub rays: u64,
    /// The error of the scene that the map tells, relative.
    pub told: f64,
    /// The error of the scene found, relative to the same light as the one told.
    pub error: AuditedError,
    /// The same of the bare interpolated map.
    pub interpolated: AuditedError,
    /// The error is larger than this, relative; wrongly so in one of [`Audit::FALSE_ALARMS`] runs with a true claim. Zero
    /// where paths tell too little.
    pub at_least: f64,
    /// An error as large as this would have contradicted the claim with a probability of 95 %, relative, however it is spread.
    pub would_find: f64,
    /// The same of an error that is alike everywhere, as of light that is lost.
    pub would_find_alike: f64,
    /// Mean of what the map reads beyond what paths find, relative.
    pub mean_error: f64,
    /// Its standard error.
    pub mean_error_standard_error: f64,
    /// Readings at the places drawn by area.
    pub readings: AuditedReadings,
    /// Readings where trouble is likely: small surfaces, edges and corners, beside things, near luminaires, dim places.
    pub hard_readings: AuditedReadings,
    /// The share of all light that was not tested, as no path can find it: caustics of luminaires without surface.
    pub untested: f64,
    /// Whether these figures may be believed.
    pub trust: AuditTrust,
    /// Whether the claim is withdrawn.
    pub contradicts: bool,
    /// Surfaces on which the map is wrong in the mean, worst first.
    pub surfaces: Vec<AuditedSurface>,
    /// Places where reading and paths differ by more than [`Audit::FAR`] of their errors together, worst first.
    pub worst: Vec<AuditedPlace>,
}

impl Audit {
    /// A true claim is contradicted in no more than one of so many runs, all audits of a run together.
    pub const FALSE_ALARMS: f64 = 1000.0;

    /// A reading that differs by so many errors is told: of sixteen replicates, Student's distribution lets one in 40,000 that are right differ by
    /// more.
    pub const FAR: f64 = 6.0;

    /// The standard errors of readings are wrong where the true ones are more than this many times as large: intervals of 95 % hold the truth in 81 %
    /// of cases then.
    pub const MOST_UNTOLD: f64 = 1.5;
}

/// A root mean square error, relative, with an interval of 95 %.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct AuditedError {
    /// Most likely.
    pub value: f64,
    /// Not less.
    pub low: f64,
    /// Not more.
    pub high: f64,
}

/// Standard errors of readings beside what these truly err by.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct AuditedReadings {
    /// How many readings.
    pub places: u64,
    /// The true error over the one told, root mean squares; `None` where no error is told, or where paths tell too little.
    pub true_over_told: Option<f64>,
    /// The ratio is larger than this, with the same certainty as [`Audit::at_least`].
    pub at_least: f64,
    /// The share of readings that differ from paths by more than 1.96 of both errors together.
    pub outside: f64,
}

/// Signs that figures made of few samples are not to be believed, in the manner of the tables of fluctuations
/// of Monte Carlo transport codes (MCNP manual, 2.6).
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct AuditTrust {
    /// Relative variance of the variance of the squared error found; above 0.1 its interval is not to be believed.
    pub variance_of_variance: f64,
    /// Index of the power law that the brightest paths follow (Hill 1975); below 2 their variance is not finite. `None` where they
    /// are too few, or end sooner than any power law.
    pub tail_index: Option<f64>,
    /// The power of the number of increments that the noise of the map falls with, which is -0.5 of independent ones. `None` where the
    /// run had fewer than three doublings of those that are believed.
    pub trend: Option<f64>,
}

impl AuditTrust {
    /// The most that the variance of the variance may be.
    pub const MOST_VARIANCE: f64 = 0.1;
    /// The least index of a tail of finite variance.
    pub const LEAST_INDEX: f64 = 2.0;
    /// Noise that falls more slowly than this, half of the power of independent increments, does not fall as it is told to.
    pub const MOST_TREND: f64 = -0.25;

    /// Whether all is well.
    pub fn passes(&self) -> bool {
        self.variance_of_variance <= Self::MOST_VARIANCE
            && self.tail_index.is_none_or(|index| index >= Self::LEAST_INDEX)
            && self.trend.is_none_or(|trend| trend <= Self::MOST_TREND)
    }
}

/// What was found on a surface as a whole.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct AuditedSurface {
    /// Its shape.
    pub shape: String,
    /// Places on it.
    pub places: u64,
    /// Mean of what was read, lx.
    pub read_lx: f64,
    /// Mean of what paths have found, lx.
    pub traced_lx: f64,
    /// Standard error of the difference, lx.
    pub standard_error_lx: f64,
}

/// A place where a reading and paths differ.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct AuditedPlace {
    /// The shape that it lies on.
    pub shape: String,
    /// Where, m.
    pub position: [f64; 3],
    /// What was read, lx.
    pub read_lx: f64,
    /// The standard error told, lx.
    pub standard_error_lx: f64,
    /// What paths have found, lx.
    pub traced_lx: f64,
    /// Its standard error, lx.
    pub traced_standard_error_lx: f64,
}
