//! Arguments of `isolux grid`.

use super::grid_choice::GridChoice;
use super::required::RequiredFlags;
use super::solve::FURTHER_HELP;
use crate::quantity;
use clap::{Args, ValueEnum};
use std::path::PathBuf;

#[derive(Debug, Args)]
#[command(after_help = "Examples:
  isolux grid map.glb
  isolux grid map.glb --height 0.75 --maintenance-factor 0.8 -o plan.png
  isolux grid room.toml --accuracy 2% --name desk --csv desk.csv
  isolux grid map.glb --corner 0,0,0.75 --u 2,0,0 --v 0,1,0 --spacing 0.25
  isolux grid map.glb --height 1.2 --quantity cylindrical --require \"Em >= 50, U0 >= 0.1\"
  isolux grid map.glb --height 1.2 --quantity modelling -o modelling.png
  isolux grid map.glb --height 1.6 --quantity semi-cylindrical --facing 90
  isolux grid map.glb --name board --quantity luminance --eye 2,5,1.2
  isolux grid room.toml --name corridor --emergency escape-route
  isolux grid room.toml --emergency as-marked

Grids are those of the scene ([[grid]] in scene.toml), or one given here. Points lie in the middles of cells as \
EN 12464-1 spaces them and face the way of u cross v. Values are maintained illuminance: the initial one times \
the maintenance factor. Intervals are of 95 %. A scene is solved first; to keep its map, solve it yourself.")]
pub(crate) struct GridFlags {
    /// The map (.glb), or a scene
    #[arg(value_name = "MAP|SCENE")]
    pub source: PathBuf,
    #[arg(value_name = "MORE.rad", help = FURTHER_HELP)]
    pub further: Vec<PathBuf>,
    #[command(flatten)]
    pub grid: GridChoice,
    #[command(flatten)]
    pub required: RequiredFlags,
    /// Judge emergency lighting by EN 1838:2013: direct light of the luminaires marked `emergency` in scene.toml alone. Exit code 1
    /// unless all is surely met
    #[arg(long, value_enum, value_name = "KIND", conflicts_with_all = ["csv", "picture", "require", "quantity", "accuracy"])]
    pub emergency: Option<EmergencyName>,
    /// With --emergency high-risk: the illuminance that the task requires, lx
    #[arg(long, value_name = "LX", value_parser = quantity::task_lx, allow_hyphen_values = true, requires = "emergency")]
    pub task: Option<f64>,
    /// What is read at the points: of planes, or of sensors that see all round; modelling is cylindrical over horizontal illuminance
    #[arg(long, value_enum, value_name = "QUANTITY", default_value_t = QuantityName::Illuminance)]
    pub quantity: QuantityName,
    /// The way that semi-cylindrical illuminance faces in plan, degrees: 0 for +x, 90 for +y (-z where y is up)
    #[arg(long, value_name = "DEG", value_parser = quantity::azimuth_deg, allow_hyphen_values = true)]
    pub facing: Option<f64>,
    /// The eye that sees luminances, x,y,z, in metres and in the axes of the scene as written
    #[arg(long, value_name = "X,Y,Z", value_parser = quantity::triple, allow_hyphen_values = true)]
    pub eye: Option<[f64; 3]>,
    /// Write all points with their values
    #[arg(long, value_name = "FILE.csv")]
    pub csv: Option<PathBuf>,
    /// Significant digits of illuminances in the CSV [default: two below the first digit of the standard error]
    #[arg(long, value_name = "N", value_parser = quantity::digits, allow_hyphen_values = true, requires = "csv")]
    pub digits: Option<u8>,
    /// Draw the one grid as a plan: the room cut at its height, luminaires, values, isolux lines; u to the right and v up
    #[arg(short = 'o', long, value_name = "FILE.png|FILE.svg")]
    pub picture: Option<PathBuf>,
}

/// Areas of emergency lighting.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum, serde::Serialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum EmergencyName {
    /// What each grid is marked as in scene.toml (`emergency`); others are left out
    AsMarked,
    /// A strip of at most 2 m: 1 lx on the centre line, 0.5 lx in the middle half, 40:1 along the line
    EscapeRoute,
    /// 0.5 lx and 40:1 without the outer 0.5 m (anti-panic lighting)
    OpenArea,
    /// 10 % of the task's illuminance, at least 15 lx, and a uniformity of 0.1
    HighRisk,
}

/// What is read at the points of a grid.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum QuantityName {
    /// Of planes that face the way of the grid
    Illuminance,
    /// Mean of vertical illuminances over all azimuths, Ez
    Cylindrical,
    /// Mean over the half circle about --facing, Esc
    SemiCylindrical,
    /// Mean over a half sphere that faces up, Ehs
    Hemispherical,
    /// Ez over horizontal illuminance
    Modelling,
    /// Of the surface that the grid lies on, as --eye sees it, cd/m2
    Luminance,
}
