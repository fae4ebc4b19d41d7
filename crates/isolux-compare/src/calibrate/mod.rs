//! Calibration: whether errors as reported are the errors that are made.
//!
//! A case with exact answers is run from many seeds. At stages of every run the map is read, and three
//! promises are compared with the truth: intervals of single readings (their coverage), the error of
//! the scene (over the true one), and that stopping where the error looks small does not bias it. A
//! fourth, the predicted finishing time, is judged on whole runs ([`predict_scene`]).
//!
//! Seeds are independent; readings of one map are not. So uncertainties come from the spread over seeds.

mod coverage;
mod error;
mod observe;
mod places;
mod prediction;
mod scene_figure;
mod settings;
mod table;

pub use coverage::{CONFIDENCES, Coverage, Judgement};
pub use error::CalibrateError;
pub use observe::{Interval, Observation, Observed, Stage};
pub use places::Place;
pub use prediction::{Decile, PredictionTable, predict_scene};
pub use scene_figure::SceneFigure;
pub use settings::CalibrateSettings;
pub use table::{
    Calibrated, CalibratedCase, CalibratedReceiver, CalibratedStage, StoppingBias, Trial,
    calibrate, calibrate_observed, trial,
};

/// Cases of the table unless one is named: each another way for light to go, and not dear.
pub const CALIBRATED_CASES: [&str; 9] = [
    "cube",
    "coloured_cube",
    "sphere",
    "full_sphere_off_centre_50",
    "furnace",
    "emitter_rectangle",
    "spots_cosine",
    "mirror_image",
    "luminaires_1024",
];
