//! Is it right, and by how much: scenes with exact answers, the practical scene, measures of error, and
//! the table of all cases through all engines.
//!
//! [`case::cases`] is the closed list; [`validate`] runs one case through one engine and gives a row
//! of plain values; [`validate_all`] makes the table. Writing it is left to others.

mod builtin;
pub mod calibrate;
pub mod case;
mod expectation;
pub mod hall;
pub mod lambert;
mod measure;
pub mod metric;
pub mod model;
pub mod peers;
pub mod report;
pub mod statistics;
pub mod study;
pub mod tolerance;
pub mod truth;
mod validate;

pub use builtin::{BUILTIN_NAMES, BuiltinError, builtin};
pub use expectation::{Bound, Case, Expectation, Quantity};
pub use measure::{MeasureError, MeasuredPoint, Readings, cube_grid, places, sphere_grid};
pub use validate::{
    Calibration, OnRow, Reading, ValidateError, ValidateRow, ValidateSettings, ValidateTable,
    Verdict, validate, validate_all,
};
