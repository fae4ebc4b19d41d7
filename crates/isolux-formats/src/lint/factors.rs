//! What intensities are multiplied by.

use super::finding::Finding;
use crate::ies::{IesFile, LampFactor};
use crate::ldt::LdtFile;

/// Ballast factors of real ballasts lie in between.
const BALLAST: std::ops::RangeInclusive<f64> = 0.3..=1.4;
/// Line of the conversion factor of EULUMDAT.
const CONVERSION_LINE: usize = 24;

pub(super) fn of_ies(file: &IesFile) -> Vec<Finding> {
    let line = file.lines.lamps;
    let mut found = Vec::new();
    if file.multiplier != 1.0 {
        let what = format!("all intensities are multiplied by {}", file.multiplier);
        let remedy = "nothing, if it was meant; some programs ignore the multiplier";
        found.push(Finding::note(line, what, remedy));
    }
    let lamp = match file.lamp_factor {
        LampFactor::BallastLamp(factor) => factor,
        LampFactor::Reserved(_) | LampFactor::GenerationType(_) => 1.0,
    };
    for (name, factor) in
        [("ballast factor", file.ballast_factor), ("ballast-lamp photometric factor", lamp)]
    {
        if factor == 1.0 {
            continue;
        }
        let what = format!("the {name} {factor} is applied");
        found.push(if BALLAST.contains(&factor) {
            Finding::note(line, what, "nothing, if it was meant")
        } else {
            Finding::warning(line, format!("{what}; no ballast has it"), "write 1, or correct it")
        });
    }
    found
}

pub(super) fn of_ldt(file: &LdtFile) -> Vec<Finding> {
    let factor = file.conversion_factor;
    if [0.0, 1.0].contains(&factor) {
        return Vec::new();
    }
    let what = format!("all intensities are multiplied by the conversion factor {factor}");
    let remedy = "nothing, if it was meant; some programs ignore it";
    vec![Finding::note(CONVERSION_LINE, what, remedy)]
}
