//! Arguments of `isolux daylight`.

use super::grid_choice::GridChoice;
use super::solve::FURTHER_HELP;
use crate::quantity;
use clap::Args;
use std::path::PathBuf;

#[derive(Debug, Args)]
#[command(after_help = "Examples:
  isolux daylight office.toml --weather berlin.epw --height 0.8
  isolux daylight office.toml --weather berlin.epw --name desks --csv points.csv --json

Daylight coefficients are traced once for every point; every hour of the weather file is then a sum. Skies are those of Perez, the sun's \
direct light is traced to where it is. Luminaires are switched off, blinds are not drawn. Intervals hold the noise of paths at 95 %.")]
pub(crate) struct DaylightFlags {
    /// The scene, with calculation grids or a --height; its own sky only tells where north is
    #[arg(value_name = "SCENE")]
    pub source: PathBuf,
    #[arg(value_name = "MORE.rad", help = FURTHER_HELP)]
    pub further: Vec<PathBuf>,
    /// A year of weather (EnergyPlus)
    #[arg(long, value_name = "FILE.epw")]
    pub weather: PathBuf,
    #[command(flatten)]
    pub grid: GridChoice,
    #[command(flatten)]
    pub year: YearFlags,
    /// Write all points with their figures
    #[arg(long, value_name = "FILE.csv")]
    pub csv: Option<PathBuf>,
}

/// How a year of daylight is computed.
#[derive(Debug, Args)]
pub(crate) struct YearFlags {
    /// Hours of use of every day by standard time, from and to
    #[arg(long, value_name = "FROM..TO", value_parser = quantity::hours_of_day, default_value = "8..18", requires = "weather")]
    pub hours: (u32, u32),
    /// Reflectance of the ground beyond the scene
    #[arg(long, value_name = "SHARE", value_parser = quantity::reflectance, default_value = "0.2", allow_hyphen_values = true, requires = "weather")]
    pub ground_reflectance: f64,
    /// Paths of daylight from every point; more make intervals narrower
    #[arg(long, value_name = "N", default_value_t = 16_384, value_parser = clap::value_parser!(u32).range(256..=16_777_216), requires = "weather")]
    pub paths: u32,
    /// Seed of random numbers of daylight
    #[arg(long, default_value_t = 1, requires = "weather")]
    pub seed: u64,
}
