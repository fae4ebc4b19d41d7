//! What a photometric file holds.

use crate::console::{facts, print, print_json};
use crate::failure::Failure;
use crate::quantity::significant;
use crate::source::{bad_file, show_warnings};
use isolux_formats::ies::{self, Edition, IesFile};
use isolux_formats::ldt::{self, LdtFile};
use serde::Serialize;
use std::path::Path;

/// Prints an LM-63 file.
pub(super) fn show_ies(path: &Path, json: bool) -> Result<(), Failure> {
    let loaded = ies::read(path).map_err(bad_file)?;
    show_warnings(&loaded.warnings);
    let contents = Contents::of_ies(&loaded.value)?;
    if json { print_json(&contents) } else { print(&contents.text()) }
}

/// Prints a EULUMDAT file.
pub(super) fn show_ldt(path: &Path, json: bool) -> Result<(), Failure> {
    let loaded = ldt::read(path).map_err(bad_file)?;
    show_warnings(&loaded.warnings);
    let contents = Contents::of_ldt(&loaded.value)?;
    if json { print_json(&contents) } else { print(&contents.text()) }
}

/// What `info --json` prints of a photometric file.
#[derive(Serialize)]
struct Contents {
    kind: &'static str,
    format: String,
    manufacturer: Option<String>,
    luminaire: Option<String>,
    lamps: u32,
    /// As declared; `null` for absolute photometry.
    lamp_flux_lm: Option<f64>,
    /// Integral of the intensities.
    luminous_flux_lm: f64,
    max_intensity_cd: f64,
    input_watts: f64,
    planes: usize,
    gammas: usize,
}

impl Contents {
    fn of_ies(file: &IesFile) -> Result<Self, Failure> {
        let distribution = file.resolve().map_err(Failure::bad_input)?;
        Ok(Self {
            kind: "photometric file",
            format: format!("{}, type {:?}", edition(file.edition), file.photometric_type),
            manufacturer: file.keyword("MANUFAC").map(str::to_owned),
            luminaire: file.keyword("LUMINAIRE").map(str::to_owned),
            lamps: file.lamps,
            lamp_flux_lm: file.lamp_lumens(),
            luminous_flux_lm: distribution.luminous_flux_lm(),
            max_intensity_cd: distribution.max_intensity_cd(),
            input_watts: file.input_watts,
            planes: file.horizontal_deg.len(),
            gammas: file.vertical_deg.len(),
        })
    }

    /// With the first of its sets of lamps.
    fn of_ldt(file: &LdtFile) -> Result<Self, Failure> {
        let distribution = file.resolve().map_err(Failure::bad_input)?;
        let lamps = file.lamp_sets.first();
        let said = |text: &String| Some(text.clone()).filter(|text| !text.is_empty());
        Ok(Self {
            kind: "photometric file",
            format: "EULUMDAT".to_owned(),
            manufacturer: said(&file.header.company),
            luminaire: said(&file.header.luminaire),
            lamps: lamps.map_or(0, |set| set.lamps),
            lamp_flux_lm: lamps.filter(|set| !set.absolute).map(|set| set.flux_lm),
            luminous_flux_lm: distribution.luminous_flux_lm(),
            max_intensity_cd: distribution.max_intensity_cd(),
            input_watts: lamps.map_or(0.0, |set| set.watts),
            planes: file.planes_deg.len(),
            gammas: file.gammas_deg.len(),
        })
    }

    fn text(&self) -> String {
        let named = |name: &Option<String>| name.clone().unwrap_or_else(|| "not said".to_owned());
        let lumen = |lm: f64| format!("{} lm", significant(lm, 4));
        let efficacy = match self.input_watts {
            w if w > 0.0 => format!("{w} W, {} lm/W", significant(self.luminous_flux_lm / w, 3)),
            w => format!("{w} W"),
        };
        facts(&[
            ("file", self.format.clone()),
            ("manufacturer", named(&self.manufacturer)),
            ("luminaire", named(&self.luminaire)),
            ("lamps", self.lamps.to_string()),
            ("flux of the lamps", self.lamp_flux_lm.map_or("absolute photometry".into(), lumen)),
            ("flux of the luminaire", lumen(self.luminous_flux_lm)),
            ("greatest intensity", format!("{} cd", significant(self.max_intensity_cd, 4))),
            ("input", efficacy),
            ("table", format!("{} planes of {} angles", self.planes, self.gammas)),
        ])
    }
}

fn edition(edition: Edition) -> &'static str {
    match edition {
        Edition::E1986 => "LM-63-1986",
        Edition::E1991 => "LM-63-1991",
        Edition::E1995 => "LM-63-1995",
        Edition::E2002 => "LM-63-2002",
        Edition::E2019 => "LM-63-2019",
    }
}
