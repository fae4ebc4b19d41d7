//! How well grids are computed, and what has to hold on them.

use crate::quantity;
use clap::Args;

#[derive(Debug, Args)]
pub(crate) struct RequiredFlags {
    /// The share of the initial light that is left when maintained: 0.8 or 80%; 1 is all of it [default: the grid's, else 1]
    #[arg(long, value_name = "SHARE", value_parser = quantity::maintenance_factor, allow_hyphen_values = true)]
    pub maintenance_factor: Option<f64>,
    /// Of a scene: solve it to this accuracy [default: 1%, or what requirements need]
    #[arg(long, value_name = "SHARE", value_parser = quantity::share, allow_hyphen_values = true)]
    pub accuracy: Option<f64>,
    /// What has to hold on a grid, or on all, beside what the scene requires: "desks: Em >= 500, U0 >= 0.6", or "desks: EN 12464-1 34.2";
    /// may be repeated. Exit code 1 unless it is surely met; a scene is solved until that is decided
    #[arg(long, value_name = "WHAT")]
    pub require: Vec<String>,
}
