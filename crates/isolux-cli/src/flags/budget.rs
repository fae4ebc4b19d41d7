//! Arguments of `isolux budget`.

use super::grid_choice::GridChoice;
use super::solve::FURTHER_HELP;
use crate::quantity;
use clap::Args;
use std::path::PathBuf;

#[derive(Debug, Args)]
#[command(after_help = "Examples:
  isolux budget room.toml --flux 5% --reflectance 10%
  isolux budget map.glb --height 0.75 --flux 5% --reflectance 10% --maintenance 10% --json

What an input may be off by is half of its interval of 95 %, relative. Fluxes of one group are off together, those of different groups \
apart; so are reflectances of one material and of different ones. Paths tell how the light depends on each: by its groups it is a sum, and a \
path that was reflected n times by a material depends on its reflectance by the n-th power. Lines are added as squares (JCGM 100, GUM).")]
pub(crate) struct BudgetFlags {
    /// The scene, or a map with its scene
    #[arg(value_name = "SCENE|MAP")]
    pub source: PathBuf,
    #[arg(value_name = "MORE.rad", help = FURTHER_HELP)]
    pub further: Vec<PathBuf>,
    #[command(flatten)]
    pub grid: GridChoice,
    #[command(flatten)]
    pub inputs: InputFlags,
}

/// What inputs may be off by.
#[derive(Debug, Args)]
pub(crate) struct InputFlags {
    /// What luminous fluxes may be off by: 5%
    #[arg(long, value_name = "SHARE", value_parser = quantity::share, allow_hyphen_values = true)]
    pub flux: Option<f64>,
    /// What diffuse reflectances may be off by, of their own value: 10% is 0.45 to 0.55 for 0.5
    #[arg(long, value_name = "SHARE", value_parser = quantity::share, allow_hyphen_values = true)]
    pub reflectance: Option<f64>,
    /// What the maintenance factor may be off by
    #[arg(long, value_name = "SHARE", value_parser = quantity::share, allow_hyphen_values = true)]
    pub maintenance: Option<f64>,
}

impl InputFlags {
    /// Whether no input is uncertain.
    pub(crate) const fn is_empty(&self) -> bool {
        self.flux.is_none() && self.reflectance.is_none() && self.maintenance.is_none()
    }
}
