//! What a photometric file holds.

use crate::console::facts;
use crate::quantity::significant;
use crate::shown::name;
use isolux::photometry::IntensityDistribution;
use isolux_formats::counted;
use isolux_formats::ies::{Edition, IesFile};
use isolux_formats::ldt::LdtFile;
use isolux_formats::photometric_file::PhotometricFile;
use serde::Serialize;

/// What is printed of a photometric file.
#[derive(Serialize)]
pub(crate) struct Contents {
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
    /// Of a file and its distribution; of EULUMDAT with the first of its sets of lamps.
    pub(crate) fn of(file: &PhotometricFile, distribution: &IntensityDistribution) -> Self {
        let luminous_flux_lm = distribution.luminous_flux_lm();
        let max_intensity_cd = distribution.max_intensity_cd();
        match file {
            PhotometricFile::Ies(file) => {
                Self { luminous_flux_lm, max_intensity_cd, ..Self::of_ies(file) }
            }
            PhotometricFile::Ldt(file) => {
                Self { luminous_flux_lm, max_intensity_cd, ..Self::of_ldt(file) }
            }
        }
    }

    fn of_ies(file: &IesFile) -> Self {
        Self {
            kind: "photometric file",
            format: format!("{}, type {:?}", edition(file.edition), file.photometric_type),
            manufacturer: file.keyword("MANUFAC").map(str::to_owned),
            luminaire: file.keyword("LUMINAIRE").map(str::to_owned),
            lamps: file.lamps,
            lamp_flux_lm: file.lamp_lumens(),
            luminous_flux_lm: 0.0,
            max_intensity_cd: 0.0,
            input_watts: file.input_watts,
            planes: file.horizontal_deg.len(),
            gammas: file.vertical_deg.len(),
        }
    }

    fn of_ldt(file: &LdtFile) -> Self {
        let lamps = file.lamp_sets.first();
        let said = |text: &String| Some(text.clone()).filter(|text| !text.is_empty());
        Self {
            kind: "photometric file",
            format: "EULUMDAT".to_owned(),
            manufacturer: said(&file.header.company),
            luminaire: said(&file.header.luminaire),
            lamps: lamps.map_or(0, |set| set.lamps),
            lamp_flux_lm: lamps.filter(|set| !set.absolute).map(|set| set.flux_lm),
            luminous_flux_lm: 0.0,
            max_intensity_cd: 0.0,
            input_watts: lamps.map_or(0.0, |set| set.watts),
            planes: file.planes_deg.len(),
            gammas: file.gammas_deg.len(),
        }
    }

    /// For people.
    pub(crate) fn text(&self) -> String {
        let named = |said: &Option<String>| said.as_deref().map_or("not said".to_owned(), name);
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
            (
                "table",
                format!("{} of {} angles", counted(self.planes, "plane", "planes"), self.gammas),
            ),
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
