//! What is odd about a file that can be read.

use super::{LdtFile, LdtSymmetry};
use crate::Problem;

/// Flux and light output ratio agree in real files to rounding and quadrature; this share apart,
/// one of them is wrong.
const DISAGREEMENT: f64 = 0.05;

/// Steps are written with a digit or two, degrees.
const STEP_ROUNDING_DEG: f64 = 0.01;

/// All that should be shown to whoever uses the file.
pub(super) fn warnings(record: &LdtFile) -> Vec<Problem> {
    [alternatives(record), tilted(record), no_factor(record), output_ratio(record)]
        .into_iter()
        .chain([
            uneven(record, 5, "planes", record.plane_step_deg, record.stepped_planes()),
            uneven(record, 7, "gamma angles", record.gamma_step_deg, &record.gammas_deg),
        ])
        .flatten()
        .collect()
}

impl LdtFile {
    /// Planes whose step means anything: those of an axial table need not be listed.
    fn stepped_planes(&self) -> &[f64] {
        if self.symmetry == LdtSymmetry::Axial { &[] } else { &self.planes_deg }
    }
}

fn alternatives(record: &LdtFile) -> Option<Problem> {
    let sets = record.lamp_sets.len();
    (sets > 1).then(|| {
        record.problem(
            record.lines.lamps,
            format!("{sets} lamp sets; the first is used unless another is asked for"),
            "put the set that is meant first, or give its number as `lamp_set`",
        )
    })
}

fn tilted(record: &LdtFile) -> Option<Problem> {
    let tilt = record.measured_tilt_deg;
    (tilt != 0.0).then(|| {
        record.problem(
            25,
            format!("measured at a tilt of {tilt} degrees; the table is used as it stands"),
            "aim the luminaire so that the table's nadir is vertical",
        )
    })
}

fn no_factor(record: &LdtFile) -> Option<Problem> {
    (record.conversion_factor == 0.0)
        .then(|| record.problem(24, "the conversion factor is 0 or missing; 1 is used", "write 1"))
}

pub(super) fn output_ratio(record: &LdtFile) -> Option<Problem> {
    let set = record.lamp_sets.first()?;
    let flux = record.resolve().ok()?.luminous_flux_lm();
    let stated = set.flux_lm * record.light_output_ratio_percent / 100.0;
    let apart = (flux - stated).abs() > DISAGREEMENT * stated;
    (stated > 0.0 && apart).then(|| {
        record.problem(
            23,
            format!(
                "the table holds {flux:.0} lm, but the light output ratio makes {stated:.0} lm"
            ),
            "check the ratio, the flux of the lamps and the conversion factor",
        )
    })
}

fn uneven(record: &LdtFile, line: usize, what: &str, step: f64, angles: &[f64]) -> Option<Problem> {
    let even = |pair: &[f64]| (pair[1] - pair[0] - step).abs() <= STEP_ROUNDING_DEG;
    (step > 0.0 && !angles.windows(2).all(even)).then(|| {
        record.problem(
            line,
            format!("the {what} listed are not {step} degrees apart; the list is used"),
            "write 0 for uneven steps",
        )
    })
}
