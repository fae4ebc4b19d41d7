//! The study as plain values.

use super::analytic::Analytic;
use super::measured::Measured;
use super::system::System;
use crate::metric::{ColourDifference, PictureDistance};
use serde::{Deserialize, Serialize};

/// All of it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Study {
    /// Version of isolux.
    pub isolux: String,
    /// What it ran on.
    pub machine: Machine,
    /// What was asked for.
    pub settings: Settings,
    /// What was compared.
    pub cases: Vec<CaseStudy>,
    /// The analytic cases of CIE 171:2006.
    pub analytic: Vec<Analytic>,
    /// What larger scenes cost.
    pub costs: Vec<Cost>,
    /// Whether it was stopped before its end.
    #[serde(default)]
    pub is_unfinished: bool,
    /// Renderers beside isolux.
    pub versions: Vec<Version>,
    /// Renderers beside isolux that were asked for and are not installed, each with how to install it.
    pub missing: Vec<String>,
}

/// A renderer beside isolux.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Version {
    /// Which.
    pub system: System,
    /// The version of its Python package.
    pub version: String,
}

/// What a study ran on.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Machine {
    /// Name of the processor.
    pub processor: String,
    /// Cores that may be used.
    pub cores: usize,
    /// Operating system.
    pub system: String,
}

/// What is asked of a study.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Settings {
    /// The longest time of a point, s; those before double up to it.
    pub limit_s: f64,
    /// Seed of all random numbers.
    pub seed: u64,
    /// Threads of every system.
    pub threads: usize,
    /// Width and height of pictures, pixels.
    pub picture: [u32; 2],
}

/// One scene through all systems.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CaseStudy {
    /// As the command line names it: `cube`, `sphere`, `hall`, `demo`, or the path of a scene.
    pub name: String,
    /// Hash of everything that light depends on in the scene, hexadecimal.
    pub scene_hash: String,
    /// Number of triangles.
    pub triangles: u32,
    /// Number of luminaires and emitting surfaces.
    pub luminaires: usize,
    /// The picture that those of all systems are compared with, by file name, and how it was made.
    pub reference: Option<Reference>,
    /// [`Point::landing`] as it should be, where that is known.
    pub landing: Option<f64>,
    /// The relative error that pictures of errors show in full colour.
    pub error_limit: Option<f64>,
    /// One a system, in the order of [`System::ALL`], those of other renderers after.
    pub series: Vec<Series>,
}

/// What a map of a variant of HALL takes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Cost {
    /// Which of both was varied.
    pub varied: Varied,
    /// Number of triangles.
    pub triangles: u32,
    /// Number of luminaires.
    pub luminaires: usize,
    /// The accuracy asked for, relative.
    pub accuracy: f64,
    /// The error told, relative.
    pub told: Option<f64>,
    /// What the map took, without reading the scene, s.
    pub time_s: f64,
}

/// What larger scenes have more of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Varied {
    /// Triangles of the same surfaces, divided.
    Triangles,
    /// Luminaires that share the same flux.
    Luminaires,
}

/// A picture that others are compared with.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Reference {
    /// Name of its file.
    pub picture: String,
    /// The error that its map tells, relative.
    pub told: Option<f64>,
    /// What its map took, s.
    pub time_s: f64,
    /// The accuracy that it was asked for, relative, and no time limit.
    pub accuracy: f64,
    /// When it said that it would be done, each time it said so.
    pub predictions: Vec<Prediction>,
    /// [`Point::landing`] of its map.
    pub landing: Option<f64>,
}

/// One system on one scene.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Series {
    /// Which.
    pub system: System,
    /// By the time aimed at, shortest first.
    pub points: Vec<Point>,
    /// Name of the file that shows where its last map errs, where there is one.
    pub error_picture: Option<String>,
}

/// One map.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Point {
    /// The time that it should take about, s.
    pub asked_s: f64,
    /// The accuracy asked for, relative; `None` of a renderer that cannot be asked.
    pub accuracy: Option<f64>,
    /// What a renderer that cannot be asked for an accuracy was asked for, in words of its script.
    pub effort: Option<String>,
    /// The time it took, s.
    pub time_s: f64,
    /// Rays traced, if it tells.
    pub rays: Option<u64>,
    /// Vertices of its elements, if it has any.
    pub receivers: Option<u64>,
    /// Luminous flux that lands on surfaces which carry a map, over that which luminaires emit; light that is reflected lands again.
    pub landing: Option<f64>,
    /// What it tells of itself.
    pub reported: Reported,
    /// When the system said that it would be done, each time it said so.
    pub predictions: Vec<Prediction>,
    /// What an independent test found; `None` where there was none.
    pub audited: Option<Audited>,
    /// By how much it is wrong, where the answer is known.
    pub measured: Option<Measured>,
    /// Name of the file of its picture, where there is one.
    pub picture: Option<String>,
    /// How far that is from the last picture of the same system, as the study has it.
    pub from_last: Option<Distances>,
    /// The same from the reference of the case.
    pub from_reference: Option<Distances>,
}

/// What a map tells of itself; `None` where it cannot tell.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Reported {
    /// Error of readings, relative.
    pub error: Option<f64>,
    /// The part of it that comes from noise.
    pub noise: Option<f64>,
    /// Error of the bare map, all light interpolated.
    pub bare: Option<f64>,
    /// The share of all light that radiosity has not shot.
    pub unshot: Option<f64>,
    /// The share of the surface where the filter takes most of the detail for noise.
    pub filtered: Option<f64>,
}

/// A finishing time as it was foreseen.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Prediction {
    /// When it was said, s since the start.
    pub at_s: f64,
    /// The error then, relative, where it was known.
    pub error: Option<f64>,
    /// Most likely, s since the start.
    pub finish_s: f64,
    /// Not before.
    pub earliest_s: f64,
    /// Not after.
    pub latest_s: f64,
}

/// The error of a map by complete paths that know nothing of it, relative, with its interval of 95 %.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Audited {
    /// Most likely.
    pub error: f64,
    /// Lower end.
    pub low: f64,
    /// Upper end.
    pub high: f64,
    /// Whether what the map tells is contradicted.
    pub contradicts: bool,
}

/// How far a picture is from another.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Distances {
    /// Relative L2 distance in codes of the frame buffer (3.3 of the study).
    pub rgb: PictureDistance,
    /// CIE 1976 L*a*b* difference.
    pub cie1976: ColourDifference,
    /// CIE94, which the study calls CIE 1995.
    pub cie1994: ColourDifference,
    /// CIEDE2000.
    pub ciede2000: ColourDifference,
}
