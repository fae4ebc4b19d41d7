//! What is printed of a conversion.

use crate::failure::Failure;
use crate::output::OutputPath;
use crate::quantity::significant;
use isolux::photometry::PhotometricWeb;
use isolux_formats::photometric_file::{Conversion, Target};
use serde::Serialize;
use std::path::Path;

/// A file converted, and how much it differs.
#[derive(Serialize)]
pub(super) struct Converted {
    file: String,
    /// What the other format cannot say.
    losses: Vec<String>,
    /// Largest difference of intensity, and its root mean square over directions.
    largest_difference_cd: f64,
    rms_difference_cd: f64,
    /// Greatest intensity, for comparison.
    max_intensity_cd: f64,
    /// Flux of the new file less that of the old one.
    flux_difference_lm: f64,
}

/// The path of the new file, and the format that its extension names.
pub(super) fn target(path: &Path) -> Result<(OutputPath, Target), Failure> {
    let is_ies = path.extension().is_some_and(|e| e.eq_ignore_ascii_case("ies"));
    let is_ldt = path.extension().is_some_and(|e| e.eq_ignore_ascii_case("ldt"));
    if !is_ies && !is_ldt {
        let path = path.display();
        return Err(Failure::bad_input(format!(
            "{path}: cannot write this kind of file; end its name in .ies or .ldt"
        )));
    }
    let (extension, target) = if is_ies { ("ies", Target::Ies) } else { ("ldt", Target::Ldt) };
    Ok((OutputPath::check(path, extension)?, target))
}

impl Converted {
    pub(super) fn of(conversion: &Conversion, output: &OutputPath, web: &PhotometricWeb) -> Self {
        let difference = conversion.difference;
        Self {
            file: output.path().display().to_string(),
            losses: conversion.losses.clone(),
            largest_difference_cd: difference.largest_cd,
            rms_difference_cd: difference.rms_cd,
            max_intensity_cd: web.max_intensity_cd(),
            flux_difference_lm: difference.flux_lm,
        }
    }

    pub(super) fn text(&self) -> String {
        let number = |value: f64| significant(value, 2);
        let mut text = format!("converted to {}\n", self.file);
        for loss in &self.losses {
            text += &format!("lost: {loss}\n");
        }
        text += &format!(
            "read back: intensities differ by at most {} cd, {} cd rms, of {} cd; the flux by {} lm\n",
            number(self.largest_difference_cd),
            number(self.rms_difference_cd),
            significant(self.max_intensity_cd, 4),
            number(self.flux_difference_lm),
        );
        text
    }
}
