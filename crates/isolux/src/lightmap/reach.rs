//! How far stitching may move texels.

use super::seam_report::SeamReport;
use super::texels::{Cover, Lightmap};
use crate::units::Rgb;

/// Known texels move by no more than so many of their standard errors: within the interval of 95 %.
const MOST_ERRORS: f64 = 2.0;

/// How far a texel may move.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Reach {
    /// A known one, by a few of its standard errors, lx.
    Known {
        /// The standard error.
        give_lx: f64,
    },
    /// One beside a chart, by so much down and up, lx: no further than to what the known texels reach that it is
    /// looked up with, on either side of the seam. Both sides can be made to agree so, and no surface shows more
    /// light than there is.
    Filled {
        /// At most downwards, none above zero.
        down_lx: [f64; 3],
        /// At most upwards, none below zero.
        up_lx: [f64; 3],
    },
}

impl Reach {
    /// Of a texel with a standard error; it may stay where it is.
    pub(super) fn new(lightmap: &Lightmap, texel: usize, give_lx: f64) -> Self {
        match lightmap.covers[texel] {
            Cover::Known => Self::Known { give_lx },
            _ => Self::Filled { down_lx: [0.0; 3], up_lx: [0.0; 3] },
        }
    }

    /// Lets a filled texel come up to what another differs from it by, lx.
    pub(super) fn admit(&mut self, differs_lx: [f64; 3]) {
        let Self::Filled { down_lx, up_lx } = self else { return };
        for ((down, up), differs) in down_lx.iter_mut().zip(up_lx).zip(differs_lx) {
            *down = down.min(differs);
            *up = up.max(differs);
        }
    }

    /// A change that goes too far, cut to what is allowed; nothing where it does not.
    pub(super) fn cut(&self, change_lx: [f64; 3]) -> Option<[f64; 3]> {
        match self {
            Self::Known { give_lx } => {
                let errors = moved_lx(change_lx) / give_lx;
                (errors > MOST_ERRORS).then(|| change_lx.map(|c| c * MOST_ERRORS / errors))
            }
            Self::Filled { down_lx, up_lx } => {
                let cut = [0, 1, 2].map(|c| change_lx[c].clamp(down_lx[c], up_lx[c]));
                (cut != change_lx).then_some(cut)
            }
        }
    }
}

/// How far known texels were moved, in a report.
pub(super) fn tell(report: &mut SeamReport, moved: impl Iterator<Item = (Reach, [f64; 3])>) {
    let (mut squared, mut known, mut stopped) = (0.0, 0_usize, 0_usize);
    for (reach, change_lx) in moved {
        let Reach::Known { give_lx } = reach else { continue };
        let moved_lx = moved_lx(change_lx);
        let errors = moved_lx / give_lx;
        squared += errors * errors;
        known += 1;
        stopped += usize::from(errors >= MOST_ERRORS * (1.0 - 1e-9));
        report.largest_change_lx = report.largest_change_lx.max(moved_lx);
    }
    report.rms_change_errors = (squared / known.max(1) as f64).sqrt();
    report.stopped = stopped as f64 / known.max(1) as f64;
}

fn moved_lx(change_lx: [f64; 3]) -> f64 {
    Rgb(change_lx).luminance().abs()
}
