//! An LM-63 file as written.

use super::{Edition, LuminousOpening, Tilt};
use std::path::PathBuf;

/// A line of the form `[NAME] value`, with the `[MORE]` lines that follow it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Keyword {
    /// What stands between the brackets.
    pub name: String,
    /// What follows them; continuation lines are joined by line feeds.
    pub value: String,
    /// Line of the file, from 1.
    pub line: usize,
}

/// Which way the goniometer turned (IES LM-75).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PhotometricType {
    /// Planes through the vertical axis: indoor and road luminaires.
    C,
    /// Planes through the horizontal axis across the beam: floodlights.
    B,
    /// Planes through the vertical axis across the beam: vehicle lights.
    A,
}

/// Unit of the luminous opening.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LengthUnit {
    /// 0.3048 m.
    Feet,
    /// 1 m.
    Metres,
}

/// The twelfth number of the lamp record, whose meaning changed with the edition.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LampFactor {
    /// Up to 1995: ballast-lamp photometric factor, which multiplies the intensities.
    BallastLamp(f64),
    /// 2002: reserved, to be written as 1.
    Reserved(f64),
    /// 2019: a code that tells how the file came about (1.1 is an accredited laboratory), and
    /// never a factor.
    GenerationType(f64),
}

/// Lines, from 1, where the records begin.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct RecordLines {
    /// Number of lamps and what follows.
    pub lamps: usize,
    /// Vertical angles.
    pub vertical: usize,
    /// Horizontal angles.
    pub horizontal: usize,
    /// Intensities.
    pub candela: usize,
}

/// An LM-63 file as written: nothing multiplied, mirrored or left out; only lengths are in metres.
#[derive(Clone, Debug, PartialEq)]
pub struct IesFile {
    /// The file.
    pub file: PathBuf,
    /// Where its records begin.
    pub lines: RecordLines,
    /// Edition of the standard it follows.
    pub edition: Edition,
    /// Its keyword lines, in order.
    pub keywords: Vec<Keyword>,
    /// Its other lines before `TILT=`, in order.
    pub labels: Vec<String>,
    /// How the lamp's flux depends on tilt.
    pub tilt: Tilt,
    /// Number of lamps.
    pub lamps: u32,
    /// Rated flux of one lamp, lm; `None` for absolute photometry (written as -1).
    pub lumens_per_lamp: Option<f64>,
    /// Factor on all intensities.
    pub multiplier: f64,
    /// How the angles are to be understood.
    pub photometric_type: PhotometricType,
    /// Unit in which the opening was written.
    pub length_unit: LengthUnit,
    /// Size and shape of the luminous opening.
    pub opening: LuminousOpening,
    /// Flux with the luminaire's ballast over flux with the laboratory's.
    pub ballast_factor: f64,
    /// The number after it.
    pub lamp_factor: LampFactor,
    /// Input power, W.
    pub input_watts: f64,
    /// Vertical angles, degrees, increasing.
    pub vertical_deg: Vec<f64>,
    /// Horizontal angles, degrees, increasing.
    pub horizontal_deg: Vec<f64>,
    /// Intensities before any factor: `candela[horizontal * verticals + vertical]`.
    pub candela: Vec<f64>,
    /// Line of each of them, from 1.
    pub intensity_lines: Vec<u32>,
}

impl IesFile {
    /// Value of the first keyword of a name, in any case.
    pub fn keyword(&self, name: &str) -> Option<&str> {
        let found = self.keywords.iter().find(|k| k.name.eq_ignore_ascii_case(name));
        found.map(|k| k.value.as_str())
    }

    /// Flux of all lamps as declared, lm; `None` for absolute photometry.
    pub fn lamp_lumens(&self) -> Option<f64> {
        self.lumens_per_lamp.map(|lumens| lumens * f64::from(self.lamps))
    }

    /// What the intensities are multiplied by to be candela of the luminaire in its base position:
    /// multiplier, ballast factor, up to 1995 the ballast-lamp photometric factor, and the tilt
    /// factor at 0 degrees.
    pub fn intensity_factor(&self) -> f64 {
        let lamp = match self.lamp_factor {
            LampFactor::BallastLamp(factor) => factor,
            LampFactor::Reserved(_) | LampFactor::GenerationType(_) => 1.0,
        };
        self.multiplier * self.ballast_factor * lamp * self.tilt.factor(0.0)
    }
}
