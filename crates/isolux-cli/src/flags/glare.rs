//! Arguments of `isolux glare`.

use crate::glare_threshold::{Threshold, glare_threshold};
use crate::quantity;
use clap::{Args, ValueEnum};
use std::path::PathBuf;

/// How glare is rated.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum GlareMetric {
    /// The unified glare rating of luminaires (CIE 117)
    Ugr,
    /// The daylight glare probability
    Dgp,
}

#[derive(Debug, Args)]
#[command(after_help = "Examples:
  isolux glare map.glb
  isolux glare map.glb --eye 1,2,1.2 --target 5,2,1.2 --json
  isolux glare map.glb --grid desks --limit 19
  isolux glare map.glb --all-grids --direction 0,1,0 --csv glare.csv
  isolux glare noon.glb --metric dgp --eye 2,3,1.2 --target 2,0,1.2

The rating is that of CIE 117:1995, with the position index of Guth and the indirect light at the eye. Luminaires shine from their luminous area. \
Without --eye the cameras of the scene look. It is made for artificial light: for windows it says little, \
and --metric dgp gives the daylight glare probability.")]
#[command(group(clap::ArgGroup::new("grids").args(["grid", "all_grids"]).multiple(true)))]
pub(crate) struct GlareFlags {
    /// The map (.glb)
    #[arg(value_name = "MAP.glb")]
    pub map: PathBuf,
    /// A camera of the scene as the observer; several: --camera again
    #[arg(long, value_name = "NAME")]
    pub camera: Vec<String>,
    /// Where an observer's eye is, x,y,z, in metres and in the axes of the scene as written
    #[arg(long, value_name = "X,Y,Z", value_parser = quantity::triple, allow_hyphen_values = true, conflicts_with = "camera")]
    pub eye: Option<[f64; 3]>,
    /// What it looks at
    #[arg(long, value_name = "X,Y,Z", value_parser = quantity::triple, allow_hyphen_values = true, requires = "eye")]
    pub target: Option<[f64; 3]>,
    /// Which rating
    #[arg(long, value_enum, default_value_t = GlareMetric::Ugr)]
    pub metric: GlareMetric,
    /// What glares in daylight (--metric dgp): a luminance in cd/m2, or as 5x a multiple of the mean of the view
    /// [default: 2000]
    #[arg(long, value_name = "CD/M2|FACTORx", value_parser = glare_threshold, allow_hyphen_values = true)]
    pub threshold: Option<Threshold>,
    /// Observers at all points of a calculation grid; several: --grid again
    #[arg(long, value_name = "NAME", conflicts_with_all = ["camera", "eye"])]
    pub grid: Vec<String>,
    /// Observers at all points of all grids
    #[arg(long, conflicts_with_all = ["camera", "eye", "grid"])]
    pub all_grids: bool,
    /// A way to look, level; several: --direction again, of which the worst counts [default: along the sides of the grid, to and fro]
    #[arg(long, value_name = "X,Y,Z", value_parser = quantity::triple, allow_hyphen_values = true, requires = "grids")]
    pub direction: Vec<[f64; 3]>,
    /// Height of the eyes of a grid above its floor, m; 1.6 of people who stand
    #[arg(long, value_name = "M", value_parser = quantity::metres, allow_hyphen_values = true, requires = "grids", default_value = "1.2")]
    pub eye_height: f64,
    /// The rating that points are to keep within
    #[arg(long, value_name = "UGR", value_parser = quantity::rating, allow_hyphen_values = true, requires = "grids", default_value = "19")]
    pub limit: f64,
    /// Write all views of the grids to this file (.csv)
    #[arg(long, value_name = "FILE.csv", requires = "grids")]
    pub csv: Option<PathBuf>,
}
