//! Arguments of `isolux report`.

use super::budget::InputFlags;
use super::daylight::YearFlags;
use super::grid_choice::GridChoice;
use super::required::RequiredFlags;
use super::solve::FURTHER_HELP;
use clap::{Args, ValueEnum};
use std::path::PathBuf;

#[derive(Debug, Args)]
#[command(after_help = "Examples:
  isolux report map.glb -o report.html
  isolux report room.toml -o report.pdf --title \"Office 2.14\" --client \"Example AG\" --date 2026-11-29
  isolux report room.toml -o bericht.html --language de --require \"EN 12464-1 34.2\" --maintenance-factor 0.8
  isolux report room.toml -o daylight.html --weather berlin.epw

What is required of calculation grids is in the scene ([[requirement]] in scene.toml) or given by --require; a scene is solved until that is \
decided. Every figure has its interval of 95 %. Exit code 1 unless all requirements are surely met. One file of HTML holds everything, and \
prints as pages; .pdf needs an isolux built with PDF.")]
pub(crate) struct ReportFlags {
    /// The map (.glb), or a scene, which is solved first
    #[arg(value_name = "MAP|SCENE")]
    pub source: PathBuf,
    #[arg(value_name = "MORE.rad", help = FURTHER_HELP)]
    pub further: Vec<PathBuf>,
    /// Where to write the report
    #[arg(short, long, value_name = "REPORT.html|.pdf")]
    pub output: PathBuf,
    /// Its language
    #[arg(long, value_enum, default_value_t = LanguageName::En)]
    pub language: LanguageName,
    /// The title [default: the name of the scene]
    #[arg(long)]
    pub title: Option<String>,
    /// Who it is made for
    #[arg(long, value_name = "NAME")]
    pub client: Option<String>,
    /// Who has made it
    #[arg(long, value_name = "NAME")]
    pub author: Option<String>,
    /// The day, written as it is given
    #[arg(long)]
    pub date: Option<String>,
    /// Remarks for the cover
    #[arg(long, value_name = "TEXT")]
    pub remarks: Option<String>,
    /// A camera whose picture it shows; several: --camera again [default: all]
    #[arg(long, value_name = "NAME")]
    pub camera: Vec<String>,
    #[command(flatten)]
    pub grid: GridChoice,
    #[command(flatten)]
    pub required: RequiredFlags,
    #[command(flatten)]
    pub inputs: InputFlags,
    /// Add a year of daylight, by this year of weather (EnergyPlus)
    #[arg(long, value_name = "FILE.epw")]
    pub weather: Option<PathBuf>,
    #[command(flatten)]
    pub year: YearFlags,
}

/// Languages of reports.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum LanguageName {
    /// English
    En,
    /// German
    De,
}
