//! A EULUMDAT file as written.

use std::path::PathBuf;

/// A EULUMDAT file as written: nothing multiplied or mirrored; only lengths are in metres.
#[derive(Clone, Debug, PartialEq)]
pub struct LdtFile {
    /// The file.
    pub file: PathBuf,
    /// Where its lists begin.
    pub lines: RecordLines,
    /// Names and numbers of the luminaire.
    pub header: Header,
    /// What kind of luminaire it is.
    pub kind: LuminaireKind,
    /// Which planes are given.
    pub symmetry: LdtSymmetry,
    /// Step between planes, degrees; 0 for uneven ones.
    pub plane_step_deg: f64,
    /// Step between gamma angles, degrees; 0 for uneven ones.
    pub gamma_step_deg: f64,
    /// Of the luminaire and of its luminous area.
    pub sizes: Sizes,
    /// Share of the flux that goes down, %.
    pub downward_flux_percent: f64,
    /// Flux of the luminaire over that of its lamps, %.
    pub light_output_ratio_percent: f64,
    /// Factor on the intensities.
    pub conversion_factor: f64,
    /// Tilt of the luminaire while it was measured, degrees.
    pub measured_tilt_deg: f64,
    /// The lamps the luminaire may be fitted with, one set at a time; at least one.
    pub lamp_sets: Vec<LampSet>,
    /// Direct ratios for the room indices 0.6 to 5.
    pub direct_ratios: [f64; 10],
    /// All planes, degrees, increasing, also those whose intensities follow from symmetry.
    pub planes_deg: Vec<f64>,
    /// Gamma angles, degrees, increasing.
    pub gammas_deg: Vec<f64>,
    /// Intensities of the planes given, cd per 1000 lm of the lamps, plane by plane.
    pub candela_per_klm: Vec<f64>,
}

/// The lines of text.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Header {
    /// Company, data bank, version.
    pub company: String,
    /// Number of the measurement report.
    pub report: String,
    /// Name of the luminaire.
    pub luminaire: String,
    /// Number of the luminaire.
    pub number: String,
    /// File name.
    pub file_name: String,
    /// Date and user.
    pub date: String,
}

/// Kinds of luminaires (`Ityp`).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LuminaireKind {
    /// 0: a point without symmetry (an extension).
    PointWithoutSymmetry,
    /// 1: a point symmetric about the vertical axis.
    PointAxial,
    /// 2: linear, its length along C90-C270.
    Linear,
    /// 3: a point of any other symmetry.
    PointOther,
}

/// Planes whose intensities are given (`Isym`).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LdtSymmetry {
    /// 0: all.
    None,
    /// 1: the first, which stands for all.
    Axial,
    /// 2: C0 to C180.
    AboutC0C180,
    /// 3: C270 through C0 to C90.
    AboutC90C270,
    /// 4: C0 to C90.
    AboutBoth,
}

/// Sizes, m. A width of 0 makes the length a diameter.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sizes {
    /// Luminaire: length, width, height.
    pub luminaire_m: [f64; 3],
    /// Luminous area: length along C90-C270, width along C0-C180.
    pub luminous_area_m: [f64; 2],
    /// Height of the luminous area seen from C0, C90, C180, C270.
    pub luminous_heights_m: [f64; 4],
}

/// One way to fit the luminaire with lamps.
#[derive(Clone, Debug, PartialEq)]
pub struct LampSet {
    /// Number of lamps.
    pub lamps: u32,
    /// Whether the number was written negative: the flux is that of the luminaire itself.
    pub absolute: bool,
    /// Type of the lamps.
    pub kind: String,
    /// Flux of all lamps of the set, lm.
    pub flux_lm: f64,
    /// Colour or colour temperature.
    pub colour: String,
    /// Colour rendering group or index.
    pub colour_rendering: String,
    /// Power with ballast, W.
    pub watts: f64,
}

/// Lines, from 1, where the lists begin.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct RecordLines {
    /// Lamp sets.
    pub lamps: usize,
    /// Planes.
    pub planes: usize,
    /// Gamma angles.
    pub gammas: usize,
    /// Intensities.
    pub candela: usize,
}
