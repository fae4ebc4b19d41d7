//! The study of Kopylov, Khodulev and Volevich (GraphiCon'98) made anew: what is run, what is measured of it, and what follows.
//!
//! A [`Study`] is a plain value: cases, in each of them systems, and of each system a point for every time. It is filled by who can run
//! engines and make pictures; [`conclusions`] and reports are functions of it.

mod analytic;
mod asked;
mod conclusions;
mod convergence;
mod errors;
mod measured;
mod record;
mod system;

pub use analytic::{
    Analytic, AnalyticCase, Found, LitPlace, analytic_cases, found_in_map, lit_places,
};
pub use asked::accuracy_for;
pub use conclusions::{Answer, Conclusion, ERROR_OF_LVS, conclusions};
pub use convergence::{Convergence, time_to_error_s};
pub use errors::{Errors, limit};
pub use measured::{Measured, right_landing};
pub use record::{
    Audited, CaseStudy, Cost, Distances, Machine, Point, Prediction, Reference, Reported, Series,
    Settings, Study, Varied, Version,
};
pub use system::{System, times_s};
