//! What is printed of one file.

use super::ratings::Ratings;
use crate::lamp::Contents;
use crate::quantity::significant;
use crate::shown::sentence;
use isolux::photometry::{IntensityDistribution, PhotometricWeb};
use isolux_formats::lint::{Audit, Finding, Severity};
use serde::Serialize;

/// A file and what was found in it.
#[derive(Serialize)]
pub(super) struct Audited {
    file: String,
    usable: bool,
    /// `null` of a file that cannot be used.
    contents: Option<Contents>,
    /// Flux of the luminaire over that of its lamps; `null` in absolute photometry.
    light_output_ratio: Option<f64>,
    /// Flux above the horizontal over all of it; `null` for floodlights, of types A and B.
    upward_share: Option<f64>,
    findings: Vec<Found>,
    /// `null` unless asked for, and of a file that cannot be used.
    ugr: Option<Ratings>,
}

/// One finding.
#[derive(Serialize)]
struct Found {
    severity: &'static str,
    line: Option<usize>,
    column: Option<usize>,
    what: String,
    remedy: String,
}

impl Audited {
    /// With the table of ratings for a spacing to height, where that is asked for.
    pub(super) fn of(audit: &Audit, spacing: Option<f64>) -> Self {
        let usable = audit.usable.as_ref();
        let lamps = usable.and_then(|(file, _)| file.lamp_flux_lm()).filter(|lm| *lm > 0.0);
        let flux = usable.map(|(_, web)| web.luminous_flux_lm());
        Self {
            file: audit.file.display().to_string(),
            usable: audit.is_usable(),
            contents: usable
                .map(|(file, web)| Contents::of(file, &IntensityDistribution::Web(web.clone()))),
            light_output_ratio: flux.zip(lamps).map(|(flux, lamps)| flux / lamps),
            upward_share: usable.and_then(|(_, web)| upward(web)),
            findings: audit.findings.iter().map(Found::of).collect(),
            ugr: usable.zip(spacing).map(|((file, web), spacing)| Ratings::of(file, web, spacing)),
        }
    }

    pub(super) fn text(&self) -> String {
        let mut text = format!("{}\n", self.file);
        if let Some(contents) = &self.contents {
            text += &contents.text();
            let percent = |share: Option<f64>| {
                share.map_or("-".to_owned(), |s| format!("{} %", significant(100.0 * s, 3)))
            };
            text += &crate::console::facts(&[
                ("light output ratio", percent(self.light_output_ratio)),
                ("upward light", percent(self.upward_share)),
            ]);
        }
        for found in &self.findings {
            text += &found.text(&self.file);
        }
        if self.findings.is_empty() {
            text += "nothing found\n";
        }
        if let Some(ratings) = &self.ugr {
            text += &format!("\n{}", ratings.text());
        }
        text + "\n"
    }
}

impl Found {
    fn of(finding: &Finding) -> Self {
        Self {
            severity: match finding.severity {
                Severity::Error => "error",
                Severity::Warning => "warning",
                Severity::Note => "note",
            },
            line: finding.line,
            column: finding.column,
            what: finding.what.clone(),
            remedy: finding.remedy.clone(),
        }
    }

    fn text(&self, file: &str) -> String {
        let place = match (self.line, self.column) {
            (Some(line), Some(column)) => format!("line {line}, column {column}: "),
            (Some(line), None) => format!("line {line}: "),
            (None, _) => String::new(),
        };
        sentence(&format!("{}: {file}: {place}{}; {}", self.severity, self.what, self.remedy))
            + "\n"
    }
}

/// Share of the flux above the horizontal; `None` for floodlights.
fn upward(web: &PhotometricWeb) -> Option<f64> {
    let flux = web.luminous_flux_lm();
    let has_horizon = web.system().is_c() && flux > 0.0;
    // A share below one rounding of the sums is none.
    has_horizon
        .then(|| 1.0 - web.flux_below_lm(90.0) / flux)
        .map(|s| if s < 1e-12 { 0.0 } else { s })
}

/// Flux and greatest intensity in a line.
pub(super) fn in_short(web: &PhotometricWeb) -> String {
    let [flux, most] = [web.luminous_flux_lm(), web.max_intensity_cd()].map(|v| significant(v, 4));
    format!("{flux} lm, at most {most} cd")
}
