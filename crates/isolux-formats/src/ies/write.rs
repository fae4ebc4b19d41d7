//! Photometric files written: LM-63-2019.

use super::{PhotometricType, across};
use isolux::photometry::{AngleSystem, PhotometricWeb};
use std::fmt::Write;

/// Longest line, characters.
const LINE: usize = 80;
/// File generation type of a computer simulation (LM-63-19, table 2).
pub const SIMULATED: f64 = 1.0001;
/// File generation type where none is known.
pub const UNDEFINED: f64 = 1.00001;

/// What a file is written from.
#[derive(Clone, Debug, PartialEq)]
pub struct Photometry {
    /// Keyword lines: name without brackets, value of one line.
    pub keywords: Vec<(String, String)>,
    /// Number and rated flux, lm, of the lamps; `None` for absolute photometry.
    pub rated_lamps: Option<(u32, f64)>,
    /// How the file came about, a code of LM-63-19.
    pub generation_type: f64,
    /// Input power, W.
    pub input_watts: f64,
    /// How the angles are to be understood.
    pub photometric_type: PhotometricType,
    /// Width, length and height of the luminous opening, m; a negative size is round.
    pub opening_m: [f64; 3],
    /// Horizontal angles, degrees; of type C half-planes from 0 to 0, 90, 180 or 360 degrees: the rest
    /// follows by symmetry.
    pub planes_deg: Vec<f64>,
    /// Vertical angles, degrees; of type C from 0 or 90 to 90 or 180.
    pub gammas_deg: Vec<f64>,
    /// Intensities, cd: `candela[plane * gammas + gamma]`.
    pub candela: Vec<f64>,
}

impl Default for Photometry {
    /// A point of type C in absolute photometry without a table.
    fn default() -> Self {
        Self {
            keywords: Vec::new(),
            rated_lamps: None,
            generation_type: SIMULATED,
            input_watts: 0.0,
            photometric_type: PhotometricType::C,
            opening_m: [0.0; 3],
            planes_deg: Vec::new(),
            gammas_deg: Vec::new(),
            candela: Vec::new(),
        }
    }
}

impl Photometry {
    /// The table of a web; all else as by default.
    pub fn of_web(web: &PhotometricWeb) -> Self {
        let photometric_type = match web.system() {
            AngleSystem::C => PhotometricType::C,
            AngleSystem::B => PhotometricType::B,
            AngleSystem::A => PhotometricType::A,
        };
        let (planes_deg, gammas_deg, candela) = match photometric_type {
            PhotometricType::C => {
                (web.planes_deg().to_vec(), web.gammas_deg().to_vec(), web.candela().to_vec())
            }
            PhotometricType::A | PhotometricType::B => across::table(web),
        };
        Self { photometric_type, planes_deg, gammas_deg, candela, ..Self::default() }
    }
}

/// The text of the file; numbers come back to the last bit.
pub fn write(photometry: &Photometry) -> String {
    let Photometry { input_watts, opening_m: [width, length, height], .. } = photometry;
    let (planes, gammas) = (&photometry.planes_deg, &photometry.gammas_deg);
    let mut text = String::from("IES:LM-63-2019\n");
    for (name, value) in &photometry.keywords {
        let value = value.replace(['\n', '\r'], " ");
        let _ = writeln!(text, "[{name}] {value}");
    }
    let _ = writeln!(text, "TILT=NONE");
    let (verticals, horizontals) = (gammas.len(), planes.len());
    let (lamps, lumens) = photometry.rated_lamps.unwrap_or((1, -1.0));
    let kind = match photometry.photometric_type {
        PhotometricType::C => 1,
        PhotometricType::B => 2,
        PhotometricType::A => 3,
    };
    let _ = writeln!(
        text,
        "{lamps} {lumens} 1 {verticals} {horizontals} {kind} 2 {width} {length} {height}"
    );
    let _ = writeln!(text, "1 {:.5} {input_watts}", photometry.generation_type);
    append_numbers(&mut text, gammas);
    append_numbers(&mut text, planes);
    for row in photometry.candela.chunks(gammas.len().max(1)) {
        append_numbers(&mut text, row);
    }
    text
}

/// Numbers with blanks between them, in lines of bearable length.
fn append_numbers(text: &mut String, numbers: &[f64]) {
    let mut line = String::new();
    for number in numbers {
        let word = number.to_string();
        if !line.is_empty() && line.len() + 1 + word.len() > LINE {
            text.push_str(&line);
            text.push('\n');
            line.clear();
        }
        if !line.is_empty() {
            line.push(' ');
        }
        line.push_str(&word);
    }
    text.push_str(&line);
    text.push('\n');
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ies::{IesFile, parse};
    use std::path::Path;

    fn read_back(text: &str) -> IesFile {
        let mut no_tilt = |_: &str| unreachable!("no tilt file is named");
        let loaded = parse(text.as_bytes(), Path::new("lamp.ies"), &mut no_tilt).unwrap();
        assert_eq!(loaded.warnings, []);
        loaded.value
    }

    #[test]
    fn every_number_comes_back() {
        let photometry = Photometry {
            keywords: vec![("TEST".into(), "a\nb".into()), ("MANUFAC".into(), "m".into())],
            input_watts: 11.5,
            opening_m: [-0.1, -0.1, 0.0],
            planes_deg: (0..=12).map(|k| 7.5 * f64::from(k)).collect(),
            gammas_deg: (0..=36).map(|k| 2.5 * f64::from(k)).collect(),
            candela: (0..13 * 37).map(|k| 1e4 / f64::from(k + 1)).collect(),
            ..Photometry::default()
        };
        let file = read_back(&write(&photometry));
        assert_eq!(file.keyword("TEST"), Some("a b"));
        assert_eq!(file.horizontal_deg, photometry.planes_deg);
        assert_eq!(file.vertical_deg, photometry.gammas_deg);
        assert_eq!(file.candela, photometry.candela);
        assert_eq!(file.intensity_factor(), 1.0);
        assert_eq!((file.input_watts, file.opening.width_m), (11.5, 0.1));
    }
}
