//! What noise may hide, and what it is said to.

/// What errors are said to be that noise may hide.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Noise {
    /// One standard error more, to be on the safe side.
    Counted,
    /// What is seen with noise taken off.
    TakenOff,
    /// Two standard errors less: what is left is hardly noise.
    RuledOut,
}

impl Noise {
    /// A squared error, given the standard error of its estimate.
    pub(crate) fn of_squared(self, squared: f64, standard_error: f64) -> f64 {
        match self {
            Self::Counted => squared.max(0.0) + standard_error,
            Self::TakenOff => squared.max(0.0),
            Self::RuledOut => (squared - 2.0 * standard_error).max(0.0),
        }
    }

    /// A mean, given its standard error.
    pub(crate) fn of_mean(self, mean: f64, standard_error: f64) -> f64 {
        match self {
            Self::Counted => mean,
            Self::TakenOff | Self::RuledOut => {
                (mean.abs() - 2.0 * standard_error).max(0.0).copysign(mean)
            }
        }
    }
}
