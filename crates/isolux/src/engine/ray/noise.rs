//! Allowance for noise in an estimated error.

/// The error that is reported for an estimate with noise.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Noise {
    /// A safe value: squared errors are one standard error larger.
    Counted,
    /// The estimate, from which noise has been subtracted.
    TakenOff,
    /// A lower bound: squared errors are two standard errors smaller. A positive rest is hardly noise.
    RuledOut,
}

impl Noise {
    /// A squared error, from its estimate and the standard error of that.
    pub(crate) fn of_squared(self, squared: f64, standard_error: f64) -> f64 {
        match self {
            Self::Counted => squared.max(0.0) + standard_error,
            Self::TakenOff => squared.max(0.0),
            Self::RuledOut => (squared - 2.0 * standard_error).max(0.0),
        }
    }

    /// A mean error, from its estimate and the standard error of that: unchanged if noise is counted, else
    /// two standard errors nearer to zero.
    pub(crate) fn of_mean(self, mean: f64, standard_error: f64) -> f64 {
        match self {
            Self::Counted => mean,
            Self::TakenOff | Self::RuledOut => {
                (mean.abs() - 2.0 * standard_error).max(0.0).copysign(mean)
            }
        }
    }
}
