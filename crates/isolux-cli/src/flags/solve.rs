//! Arguments of `solve`.

use super::shown::{LayoutFlags, LayoutName, ServerFlags, TargetName};
use crate::quantity::{self, Increments};
use clap::{Args, ValueEnum};
use std::path::PathBuf;
use std::time::Duration;

/// What further files are.
pub(super) const FURTHER_HELP: &str =
    "Further Radiance files of the same scene, read in this order, as oconv does";

/// What a scene can be.
pub(super) const SCENE_HELP: &str = "Path of a scene (.gltf, .glb, .obj, .ply, .rad, .stl, .xml, scene.toml), builtin:cube, builtin:sphere, builtin:hall or a \
     variant of it (builtin:hall,triangles=1e6,luminaires=100), builtin:truth-00 to builtin:truth-59";

#[derive(Debug, Args)]
#[command(after_help = "Examples:
  isolux solve room.glb -o map.glb --accuracy 1%
  isolux solve builtin:cube -o cube.glb --quality draft --json
  isolux solve room.glb -o map.glb --time-limit 5min
  isolux solve room.glb -o map.glb --layout texels --texels-per-meter 20
  isolux solve room.glb -o room.pilot
  isolux solve room.glb --pilot room.pilot --increments 0..8 -o first.part; isolux merge first.part second.part -o map.glb")]
pub(crate) struct SolveFlags {
    #[arg(help = SCENE_HELP)]
    pub scene: PathBuf,
    #[arg(value_name = "MORE.rad", help = FURTHER_HELP)]
    pub further: Vec<PathBuf>,
    /// Where to write the map (.glb), the result of the pilot alone (.pilot), or with --increments a part of the run (.part)
    #[arg(short, long, value_name = "MAP.glb", required_unless_present_any = ["dry_run", "increments"])]
    pub output: Option<PathBuf>,
    /// Make these increments alone, from number A to B - 1, for `merge`: 0..8
    #[arg(long, value_name = "A..B", value_parser = quantity::increments, allow_hyphen_values = true,
          conflicts_with_all = ["resume", "live", "group", "dry_run", "cache"])]
    pub increments: Option<Increments>,
    /// With --increments: begin with the result of this pilot instead of making the same one again
    #[arg(long, value_name = "FILE.pilot", requires = "increments")]
    pub pilot: Option<PathBuf>,
    #[command(flatten)]
    pub layout: LayoutFlags,
    /// Stop when the whole error of the scene is this small: 1% or 0.01
    #[arg(long, value_name = "SHARE", value_parser = quantity::share, allow_hyphen_values = true, default_value = "1%",
          conflicts_with = "quality")]
    pub accuracy: f64,
    /// Subdivide until the interpolated map is this good (best effort)
    #[arg(long, value_name = "SHARE", value_parser = quantity::share, allow_hyphen_values = true, default_value = "5%")]
    pub mesh_accuracy: f64,
    /// A name for an accuracy
    #[arg(long, value_enum)]
    pub quality: Option<Quality>,
    /// Stop after this time with a valid map: 60s, 5min; with --layout texels baking is counted, and what of it is left by then
    /// is read coarsely
    #[arg(long, value_name = "TIME", value_parser = quantity::duration, allow_hyphen_values = true)]
    pub time_limit: Option<Duration>,
    /// How to compute
    #[arg(long, value_enum, default_value = "hybrid")]
    pub method: MethodName,
    /// Seed of the random numbers: the same seed gives the same bits
    #[arg(long, value_name = "N", value_parser = quantity::seed, default_value = "1", allow_hyphen_values = true)]
    pub seed: u64,
    /// Threads to use, at most 1024 [default: all there are]; the result does not depend on it
    #[arg(long, value_name = "N", value_parser = quantity::threads, allow_hyphen_values = true)]
    pub threads: Option<u16>,
    /// Leave the noise in: without it, single receivers are as far off as their standard errors say
    #[arg(long)]
    pub no_filter: bool,
    /// Leave out the independent test of the map by complete paths, which takes about a tenth of the run
    #[arg(long)]
    pub no_audit: bool,
    /// Go on from where an earlier run with the same flags stopped, be it in baking: its state is kept beside the
    /// map, as MAP.checkpoint
    #[arg(long)]
    pub resume: bool,
    /// Show the run in a browser while it computes: its light as it becomes right, its error, when it will be done; it can be paused,
    /// stopped and given another accuracy there
    #[arg(long, conflicts_with_all = ["dry_run", "group"])]
    pub live: bool,
    #[command(flatten)]
    pub server: ServerFlags,
    /// With --method cache: reuse the samples in this file, and add those that are missing
    #[arg(long, value_name = "FILE", conflicts_with = "resume")]
    pub cache: Option<PathBuf>,
    /// Solve every group of luminaires by itself, as MAP.GROUP.glb, and write their sum; see `mix`
    #[arg(long, conflicts_with = "cache")]
    pub group: bool,
    /// Predict memory, receivers and time, with --layout texels that of baking, too, and compute nothing
    #[arg(long)]
    pub dry_run: bool,
    /// Say on standard error what will be done and why
    #[arg(long)]
    pub explain: bool,
    /// How to report progress on standard error [default: bar on a terminal, else lines]
    #[arg(long, value_enum)]
    pub progress: Option<ProgressStyle>,
    // The last: its heading stands above all that follow.
    #[command(flatten)]
    pub radiosity: RadiosityFlags,
}

#[derive(Debug, Args)]
#[command(after_help = "Examples:
  isolux bake scene.glb -o baked.glb --target bevy
  isolux bake scene.glb -o baked.glb --target three --texels-per-meter 20
  isolux bake scene.toml -o baked.glb --layout vertices --target godot
  isolux bake scene.glb -o lightmap.exr

This is `solve` and `export` in one, and no map is kept: for long runs that may be resumed, for other methods and for groups, use these. If the scene is glTF and the target is three or bevy, the scene is written again with its lightmap, and all else as it is.")]
pub(crate) struct BakeFlags {
    #[arg(help = SCENE_HELP)]
    pub scene: PathBuf,
    #[arg(value_name = "MORE.rad", help = FURTHER_HELP)]
    pub further: Vec<PathBuf>,
    /// Where to write: .glb, or the lightmap alone as .exr, .ktx2
    #[arg(short, long, value_name = "FILE")]
    pub output: PathBuf,
    /// Who will show the light
    #[arg(long, value_enum, default_value = "viewer")]
    pub target: TargetName,
    /// Light in a lightmap, or at vertices
    #[arg(long, value_enum, default_value = "texels")]
    pub layout: LayoutName,
    /// Density of the lightmap [default: some 130 000 texels over all surfaces]
    #[arg(long, value_name = "N", value_parser = quantity::density, allow_hyphen_values = true)]
    pub texels_per_meter: Option<f64>,
    /// Stop when the whole error of the scene is this small: 1% or 0.01
    #[arg(long, value_name = "SHARE", value_parser = quantity::share, allow_hyphen_values = true, default_value = "1%")]
    pub accuracy: f64,
    /// Leave out the luminaires of a glTF scene, as their light is in the lightmap
    #[arg(long)]
    pub without_lights: bool,
    /// Stop computing light after this time: 60s, 5min; baking comes on top
    #[arg(long, value_name = "TIME", value_parser = quantity::duration, allow_hyphen_values = true)]
    pub time_limit: Option<Duration>,
    /// Seed of the random numbers: the same seed gives the same bits
    #[arg(long, value_name = "N", value_parser = quantity::seed, default_value = "1", allow_hyphen_values = true)]
    pub seed: u64,
    /// Threads to use, at most 1024 [default: all there are]; the result does not depend on it
    #[arg(long, value_name = "N", value_parser = quantity::threads, allow_hyphen_values = true)]
    pub threads: Option<u16>,
}

/// What a quality or accuracy sets for radiosity, by hand.
#[derive(Debug, Args)]
#[command(
    next_help_heading = "Options of --method radiosity [default: what the accuracy asks for, see --explain]"
)]
pub(crate) struct RadiosityFlags {
    /// What taking a source as simple may change at a receiver, a share of the scene's light
    #[arg(long, value_name = "SHARE", value_parser = quantity::share, allow_hyphen_values = true)]
    pub form_factor_tolerance: Option<f64>,
    /// Stop shooting when this share of all light is unshot
    #[arg(long, value_name = "SHARE", value_parser = quantity::share, allow_hyphen_values = true)]
    pub unshot: Option<f64>,
    /// Subdivide for indirect light up to so many receivers
    #[arg(long, value_name = "N", value_parser = quantity::receivers, allow_hyphen_values = true)]
    pub max_receivers: Option<u32>,
    /// Do not bisect elements below this edge: 5cm, 0.1m
    #[arg(long, value_name = "LENGTH", value_parser = quantity::length_m, allow_hyphen_values = true)]
    pub min_element: Option<f64>,
    /// Leave light that is unshot dark instead of spreading it evenly
    #[arg(long)]
    pub no_ambient: bool,
    /// Leave mirrors, gloss and refraction out, as the radiosity system of the study did
    #[arg(long)]
    pub diffuse_only: bool,
}

/// Aliases of accuracies.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Quality {
    /// 5 %
    Draft,
    /// 1 %
    Medium,
    /// 0.3 %
    High,
    /// 0.1 %
    Production,
}

/// The engines by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum MethodName {
    /// Exact direct light, gathered indirect light, particles for caustics
    Hybrid,
    /// Particles from the luminaires
    Forward,
    /// Samples of indirect light with gradients, made where they are asked for (an irradiance cache)
    Cache,
    /// Shots from the patches with most light to send, over form factors
    Radiosity,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum ProgressStyle {
    /// One line that changes
    Bar,
    /// One JSON object a line, warnings and errors, too
    Json,
    /// Nothing
    None,
}
