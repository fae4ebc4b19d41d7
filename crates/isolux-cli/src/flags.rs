//! Arguments as written.

mod budget;
mod daylight;
mod glare;
mod grid;
mod grid_choice;
mod render;
mod report;
mod required;
mod shown;
mod solve;

pub(crate) use budget::{BudgetFlags, InputFlags};
pub(crate) use daylight::{DaylightFlags, YearFlags};
pub(crate) use glare::{GlareFlags, GlareMetric};
pub(crate) use grid::{EmergencyName, GridFlags, QuantityName};
pub(crate) use grid_choice::GridChoice;
pub(crate) use render::{
    EyeFlags, LookFlags, RadianceFlags, RenderFlags, ToneName, with_two_dashes,
};
pub(crate) use report::{LanguageName, ReportFlags};
pub(crate) use required::RequiredFlags;
pub(crate) use shown::{ExportFlags, LayoutFlags, LayoutName, ServerFlags, TargetName, ViewFlags};
pub(crate) use solve::{BakeFlags, MethodName, ProgressStyle, Quality, RadiosityFlags, SolveFlags};

use solve::{FURTHER_HELP, SCENE_HELP};

use crate::dimming::{DimmedMap, dimmed_group};
use crate::quantity;
use clap::{Args, Parser, Subcommand, ValueEnum};
use std::path::{Path, PathBuf};
use std::time::Duration;

/// Illumination maps: lux on every surface of a scene, with a standard error.
#[derive(Debug, Parser)]
#[command(
    name = "isolux",
    version,
    after_help = "Exit codes: 0 done, 1 a check failed, 2 bad input, 3 stopped early with a valid map, \
                  4 refused (memory, space), 130 interrupted with a valid map."
)]
pub(crate) struct Flags {
    /// Print one JSON value on standard output instead of text
    #[arg(long, global = true)]
    pub json: bool,
    /// How materials of other formats are read where their letter would make most coloured surfaces of a file invisible
    #[arg(long, global = true, value_enum, value_name = "HOW", default_value_t = MaterialsName::AsMeant)]
    pub materials: MaterialsName,
    /// Let scenes name files outside of their folders: textures, buffers, includes, photometry. Give it only for scenes that you trust
    #[arg(long, global = true)]
    pub allow_outside: bool,
    /// The sky and the sun of scenes, in place of theirs: a kind and keys of [sky] in scene.toml, as "overcast, horizontal_lx=10000" or
    /// "clear, sun.azimuth_deg=180, sun.elevation_deg=40, sun_normal_lx=80000"; a weather file and a time, as "berlin.epw,
    /// time=2026-06-21T12:00:00"; or a .toml file with these keys
    #[arg(long, global = true, value_name = "SKY")]
    pub sky: Option<String>,
    /// Memory that scenes, light and pictures may take, 64 MiB of the program beside; what needs more is refused: 8GiB, 500MB
    /// [default: 8GiB for a map or a lightmap, else what the machine gives]
    #[arg(long, global = true, value_name = "SIZE", value_parser = quantity::memory_bytes, allow_hyphen_values = true)]
    pub max_memory: Option<u64>,
    /// What to do.
    #[command(subcommand)]
    pub command: Command,
}

/// Names of ways to read materials.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum MaterialsName {
    /// As opaque, with a warning
    AsMeant,
    /// By the letter
    AsWritten,
}

/// The subcommands.
#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Compute the illumination map of a scene
    Solve(SolveFlags),
    /// Say what a scene, a map, a photometric file or a part of a run holds
    Info(InfoFlags),
    /// Read a map, or trace paths, at points
    Probe(ProbeFlags),
    /// Illuminance on calculation grids: mean, least, greatest, uniformity
    Grid(GridFlags),
    /// The unified glare rating (UGR) of observers in a map
    Glare(GlareFlags),
    /// A year of daylight on calculation grids: daylight factor, EN 17037, DA, sDA, ASE, UDI
    Daylight(DaylightFlags),
    /// Write a lighting report: plans, luminaires, figures with intervals, requirements, a year of daylight; as HTML or PDF
    Report(Box<ReportFlags>),
    /// What illuminances on grids may be off by as fluxes and reflectances may be
    Budget(BudgetFlags),
    /// Compute the light of a scene and write it for an engine: solve and export in one
    Bake(BakeFlags),
    /// Draw views from a map, or of a scene
    Render(Box<RenderFlags>),
    /// Walk through a map in a browser
    View(ViewFlags),
    /// Write a map for other software: .wrl, .x3d, .vtu, .ply, .csv; lightmaps as .glb, .exr, .ktx2; .html to walk through in a browser
    Export(ExportFlags),
    /// Add maps of luminaire groups, each dimmed as you like, without a new run
    Mix(MixFlags),
    /// Add the parts of a run that were made apart, on one machine or many, to its map
    Merge(MergeFlags),
    /// Solve on a cluster of Ray, with the package for Python
    Cluster(ClusterFlags),
    /// Audit a scene before a run
    Check(CheckFlags),
    /// Test independently, by complete paths, what a map claims
    Audit(AuditFlags),
    /// Audit photometric files, draw them, convert between IES and EULUMDAT
    Lint(LintFlags),
    /// Run the cases with exact answers
    Validate(ValidateFlags),
    /// Compare the methods by error against time, as the study of 1998 did, in one report
    Compare(CompareFlags),
    /// Write a room with lamps as a scene.toml, to begin with
    New(NewFlags),
    /// Write a scene as files to open and edit
    Scene(SceneFlags),
    /// Solve a real interior and draw it, from nothing
    Demo(DemoFlags),
    /// Print the completions of a shell, to be sourced by it
    Completions(CompletionsFlags),
    /// Write manual pages
    Man(ManFlags),
}

impl Command {
    /// How many threads are asked for.
    pub(crate) fn threads(&self) -> Option<u16> {
        match self {
            Self::Solve(flags) => flags.threads,
            Self::Export(flags) => flags.threads,
            Self::Bake(flags) => flags.threads,
            Self::Merge(flags) => flags.threads,
            Self::Compare(flags) => flags.threads,
            _ => None,
        }
    }

    /// What a command reads, and the files that make up one scene with it.
    pub(crate) fn read_together(&self) -> Option<(&Path, &[PathBuf])> {
        let (first, further) = match self {
            Self::Solve(flags) => (&flags.scene, &flags.further),
            Self::Bake(flags) => (&flags.scene, &flags.further),
            Self::Check(flags) => (&flags.scene, &flags.further),
            Self::Scene(flags) => (&flags.scene, &flags.further),
            Self::Info(flags) => (&flags.file, &flags.further),
            Self::Render(flags) => (&flags.map, &flags.further),
            Self::Grid(flags) => (&flags.source, &flags.further),
            Self::Daylight(flags) => (&flags.source, &flags.further),
            Self::Report(flags) => (&flags.source, &flags.further),
            Self::Budget(flags) => (&flags.source, &flags.further),
            Self::Probe(flags) => (&flags.source, &flags.further),
            _ => return None,
        };
        (!further.is_empty()).then_some((first, further))
    }
}

#[derive(Debug, Args)]
#[command(after_help = "Examples:
  isolux new office --size 6x5x2.8 -o room.toml
  isolux new empty -o room.toml")]
pub(crate) struct NewFlags {
    /// What stands in the room
    #[arg(value_enum)]
    pub kind: RoomKind,
    /// Width, depth and height in metres
    #[arg(long, value_name = "WxDxH", value_parser = quantity::room_m, allow_hyphen_values = true, default_value = "6x5x2.8")]
    pub size: [f64; 3],
    /// Where to write the scene
    #[arg(short, long, value_name = "ROOM.toml")]
    pub output: PathBuf,
    /// Replace a file that is there
    #[arg(long)]
    pub force: bool,
}

/// Rooms to begin with.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum RoomKind {
    /// Desks, a cupboard and as many luminous panels as about 500 lx take; in a small room one panel gives more
    Office,
    /// Luminous panels alone
    Empty,
    /// Desks, a cupboard and a glazed window to the south, below an overcast sky; no lamps
    Daylit,
}

#[derive(Debug, Args)]
#[command(after_help = "Examples:
  isolux completions bash > ~/.local/share/bash-completion/completions/isolux
  isolux completions zsh > ~/.zfunc/_isolux
  isolux completions fish > ~/.config/fish/completions/isolux.fish")]
pub(crate) struct CompletionsFlags {
    /// The shell
    pub shell: clap_complete::Shell,
}

#[derive(Debug, Args)]
#[command(after_help = "Examples:
  isolux man -o ~/.local/share/man/man1
  man isolux-solve")]
pub(crate) struct ManFlags {
    /// Folder for the pages
    #[arg(short, long, value_name = "DIR")]
    pub output: PathBuf,
}

#[derive(Debug, Args)]
#[command(after_help = "Examples:
  isolux info map.glb
  isolux info lamp.ies --json")]
pub(crate) struct InfoFlags {
    /// A map (.glb), a scene (.gltf, .glb, .obj, .ply, .rad, .stl, .xml, scene.toml, builtin:NAME), a photometric file (.ies, .ldt), a
    /// weather file (.epw), a cache of samples, or what is kept of a run (.part, .pilot, .checkpoint)
    pub file: PathBuf,
    #[arg(value_name = "MORE.rad", help = FURTHER_HELP)]
    pub further: Vec<PathBuf>,
}

#[derive(Debug, Args)]
#[command(after_help = "Examples:
  isolux probe map.glb --points desk.pts
  echo '1 2 0.75  0 0 1' | isolux probe map.glb --points - --exact --json
  isolux probe map.glb --points desk.pts --exact -o desk.res
  isolux probe builtin:hall --points desk.pts --paths 65536

Points are `x y z nx ny nz`, one a line, in metres and in the axes of the scene as written; # starts a comment. \
A point on no surface with a known value has empty fields (null in JSON), unless --exact is given; 0 is a place in the \
open that no light reaches.

Of a scene instead of a map, paths are traced at every point: slow, but without the bias of a map and on \
no surface, too. It leaves out the light that glass, gloss and curved mirrors throw on surfaces (caustics).")]
pub(crate) struct ProbeFlags {
    /// The map (.glb), or a scene, which needs no map but time
    #[arg(value_name = "MAP|SCENE")]
    pub source: PathBuf,
    #[arg(value_name = "MORE.rad", help = FURTHER_HELP)]
    pub further: Vec<PathBuf>,
    /// File of points, - for standard input
    #[arg(long, value_name = "P.pts")]
    pub points: PathBuf,
    /// Write irradiances as Radiance's `rtrace -I -h` does, instead of the table: `red green blue` in W/m2,
    /// of which 179 (0.265 red + 0.670 green + 0.065 blue) is the illuminance in lx
    #[arg(short, long, value_name = "FILE.res")]
    pub output: Option<PathBuf>,
    /// Estimate each point afresh instead of interpolating the indirect light of the map
    #[arg(long, conflicts_with = "interpolated")]
    pub exact: bool,
    /// Interpolate direct light, too: the interpolated map, as a viewer shows it
    #[arg(long)]
    pub interpolated: bool,
    /// Paths to trace at every point of a scene, at least 32 [default: 16384]; four times as many
    /// halve the standard error
    #[arg(long, value_name = "N", value_parser = quantity::paths, allow_hyphen_values = true)]
    pub paths: Option<u32>,
    /// Significant digits of illuminances in the table [default: two below the first digit of the standard error]
    #[arg(long, value_name = "N", value_parser = quantity::digits, allow_hyphen_values = true, conflicts_with = "output")]
    pub digits: Option<u8>,
    /// Seed of the random numbers of paths [default: 1]
    #[arg(long, value_name = "N", value_parser = quantity::seed, allow_hyphen_values = true)]
    pub seed: Option<u64>,
}

#[derive(Debug, Args)]
#[command(after_help = "Examples:
  isolux audit map.glb
  isolux audit map.glb --places 4000 --paths 256 --json

Places are drawn on the surfaces, a quarter of them where trouble is likely (small surfaces, edges, beside things, near \
luminaires, dim places). The map is read there as `probe` reads it, and the illuminance is estimated afresh by complete paths, which know no \
map. Squared differences, less the noise of the paths, give the true error with an interval of 95 %. Exit code 1 where the \
reported error is contradicted, which happens to a right one once in a thousand times at most.")]
pub(crate) struct AuditFlags {
    /// The map (.glb)
    #[arg(value_name = "MAP")]
    pub map: PathBuf,
    /// Places to compare [default: 1024]; four times as many halve the error that goes unnoticed
    #[arg(long, value_name = "N", value_parser = quantity::places, allow_hyphen_values = true)]
    pub places: Option<u64>,
    /// Paths to trace at every place, at least 32 [default: 64]
    #[arg(long, value_name = "N", value_parser = quantity::paths, allow_hyphen_values = true)]
    pub paths: Option<u32>,
    /// Seed of places and paths [default: that of the map]
    #[arg(long, value_name = "N", value_parser = quantity::seed, allow_hyphen_values = true)]
    pub seed: Option<u64>,
}

#[derive(Debug, Args)]
#[command(disable_help_flag = true)]
pub(crate) struct ClusterFlags {
    /// `solve`, and its flags
    #[arg(
        trailing_var_arg = true,
        allow_hyphen_values = true,
        value_name = "solve SCENE -o MAP.glb"
    )]
    pub words: Vec<std::ffi::OsString>,
}

#[derive(Debug, Args)]
#[command(after_help = "Examples:
  isolux solve room.toml -o room.pilot
  isolux solve room.toml --pilot room.pilot --increments 0..8 -o a.part
  isolux solve room.toml --pilot room.pilot --increments 8..16 -o b.part
  isolux merge b.part a.part --pilot room.pilot -o map.glb

Parts merge in any order and grouping. If they are the first increments of the run without a gap, their map has the bytes of a run \
that was stopped, or ended, after as many. The map is audited here. Parts of radiosity do not exist: each of its increments continues the one before.")]
pub(crate) struct MergeFlags {
    /// Parts of one run, from `solve --increments`
    #[arg(required = true, value_name = "PART.part")]
    pub parts: Vec<PathBuf>,
    /// Where to write the map (.glb), or a part with all these increments (.part)
    #[arg(short, long, value_name = "OUT.glb|OUT.part")]
    pub output: PathBuf,
    /// The scene, if it is not where it was when the parts were made
    #[arg(long, value_name = "SCENE")]
    pub scene: Option<PathBuf>,
    /// Begin with the result of this pilot instead of making the same one again
    #[arg(long, value_name = "FILE.pilot")]
    pub pilot: Option<PathBuf>,
    /// Leave the noise in, as `solve --no-filter` does
    #[arg(long)]
    pub no_filter: bool,
    /// Threads to use, at most 1024 [default: all there are]; the result does not depend on it
    #[arg(long, value_name = "N", value_parser = quantity::threads, allow_hyphen_values = true)]
    pub threads: Option<u16>,
    /// How to report progress on standard error [default: bar on a terminal, else lines]
    #[arg(long, value_enum)]
    pub progress: Option<ProgressStyle>,
}

#[derive(Debug, Args)]
#[command(after_help = "Examples:
  isolux solve room.toml --group -o map.glb
  isolux mix map.glb --dim spots=30% --dim daylight=0 -o evening.glb
  isolux mix map.spots.glb=30% map.ambient.glb -o evening.glb

The sum is a map like any other. Noise of its parts adds in squares; errors of interpolation and bias are added as they \
are, so that the sum is no worse than it says. The maps of groups are looked for beside the map of their sum.")]
pub(crate) struct MixFlags {
    /// Maps of the same surfaces in different light (.glb), each with what all of it is dimmed to
    #[arg(required = true, value_name = "MAP.glb[=DIMMING]", value_parser = DimmedMap::parse)]
    pub maps: Vec<DimmedMap>,
    /// Dim the luminaires of a group: 30%, 0.3, 0 for off
    #[arg(long, value_name = "GROUP=DIMMING", value_parser = dimmed_group)]
    pub dim: Vec<(String, f64)>,
    /// Where to write the sum (.glb)
    #[arg(short, long, value_name = "OUT.glb")]
    pub output: PathBuf,
}

#[derive(Debug, Args)]
#[command(after_help = "Examples:
  isolux check room.glb
  isolux check builtin:cube --json")]
pub(crate) struct CheckFlags {
    #[arg(help = SCENE_HELP)]
    pub scene: PathBuf,
    #[arg(value_name = "MORE.rad", help = FURTHER_HELP)]
    pub further: Vec<PathBuf>,
}

#[derive(Debug, Args)]
#[command(after_help = "Examples:
  isolux lint lamp.ies
  isolux lint *.ies *.ldt --json
  isolux lint lamp.ies --polar lamp.svg --draw
  isolux lint lamp.ldt --convert lamp.ies
  isolux lint lamp.ldt --ugr

Exit code 2 if a file cannot be used; the others are reported all the same.")]
pub(crate) struct LintFlags {
    /// Photometric files (.ies, .ldt)
    #[arg(required = true, value_name = "FILE")]
    pub files: Vec<PathBuf>,
    /// Draw the polar diagram of the file
    #[arg(long, value_name = "FILE.svg")]
    pub polar: Option<PathBuf>,
    /// Draw the polar diagram of every file in the terminal
    #[arg(long)]
    pub draw: bool,
    /// Convert the file to the other format and say what is lost
    #[arg(long, value_name = "OUT.ies|OUT.ldt")]
    pub convert: Option<PathBuf>,
    /// The table of unified glare ratings in standard rooms, by the tabular method of CIE 190:2010
    #[arg(long)]
    pub ugr: bool,
    /// Distance of the luminaires of the table over their height above the eye: one over a whole number
    #[arg(long, value_name = "S/H", value_parser = quantity::spacing_to_height, allow_hyphen_values = true, requires = "ugr", default_value = "0.25")]
    pub spacing_to_height: f64,
}

#[derive(Debug, Args)]
#[command(after_help = "Examples:
  isolux validate
  isolux validate --case cube --method forward --seeds 5
  isolux validate --calibrate --seeds 50 --method hybrid

Exit code 1 if a case fails; with --calibrate if a promise is broken beyond doubt: fewer than 93 % in \
intervals of 95 %, a wrong value without error, stopping that makes errors look small, or fewer \
than nine in ten predicted finishing times within 20 %, from 10 % of the time and 0.25 s on.")]
pub(crate) struct ValidateFlags {
    /// One case only
    #[arg(long, value_name = "NAME")]
    pub case: Option<String>,
    /// One engine only
    #[arg(long, value_enum)]
    pub method: Option<MethodName>,
    /// Repetitions with different seeds [default: 1, 200 with --calibrate]
    #[arg(long, value_name = "N", value_parser = quantity::repetitions, allow_hyphen_values = true)]
    pub seeds: Option<u32>,
    /// Judge the errors that maps report, and the predicted finishing times, over many seeds
    #[arg(long)]
    pub calibrate: bool,
    /// Stop runs of --calibrate when the error is this small [default: 2%]
    #[arg(long, value_name = "SHARE", value_parser = quantity::share, allow_hyphen_values = true, requires = "calibrate")]
    pub accuracy: Option<f64>,
}

#[derive(Debug, Args)]
#[command(after_help = "Examples:
  isolux scene builtin:hall -o hall
  isolux scene builtin:hall,triangles=1e5,luminaires=500 -o hall-fine
  isolux scene builtin:truth-07 -o rooms

The folder gets scene.toml, scene.gltf with scene.bin, and photometric files. Reading scene.toml gives \
the scene again, with the same hash if its geometry is flat.")]
pub(crate) struct SceneFlags {
    #[arg(help = SCENE_HELP)]
    pub scene: PathBuf,
    #[arg(value_name = "MORE.rad", help = FURTHER_HELP)]
    pub further: Vec<PathBuf>,
    /// Folder for the files
    #[arg(short, long, value_name = "DIR")]
    pub output: PathBuf,
    /// Replace files that are there
    #[arg(long)]
    pub force: bool,
}

#[derive(Debug, Args)]
#[command(after_help = "Example:
  cargo run --release -- demo")]
pub(crate) struct DemoFlags {
    /// Folder for the results
    #[arg(short, long, value_name = "DIR", default_value = "out/demo")]
    pub output: PathBuf,
    /// Stop when the whole error of the scene is this small: 1% or 0.01
    #[arg(long, value_name = "SHARE", value_parser = quantity::share, allow_hyphen_values = true, default_value = "5%")]
    pub accuracy: f64,
}

#[derive(Debug, Args)]
#[command(after_help = "Examples:
  isolux compare all -o study
  isolux compare cube sphere -o study --quick
  isolux compare room.toml -o study --systems hybrid,forward --limit 1min

Every system makes a map at times that double up to the limit: CUBE and SPHERE, whose right values are known, from an eighth of a second on, \
others from a second on. Maps and pictures are kept in the folder, and a comparison that was interrupted goes on where it stopped. \
report.html holds graphs, tables and pictures in one file; report.md, study.csv and study.json hold the same.")]
pub(crate) struct CompareFlags {
    /// cube, sphere, hall, demo, cie171 (the analytic cases of CIE 171:2006), all of these, or a scene
    #[arg(value_name = "CASE", required = true)]
    pub cases: Vec<PathBuf>,
    /// Folder to keep everything in
    #[arg(short, long, value_name = "DIR")]
    pub output: PathBuf,
    /// The longest time that a map should take [default: 8 s]
    #[arg(long, value_name = "TIME", value_parser = quantity::duration, allow_hyphen_values = true, conflicts_with = "quick")]
    pub limit: Option<Duration>,
    /// Within two minutes: maps of half a second, or of as little as there can be
    #[arg(long)]
    pub quick: bool,
    /// Some of hybrid, forward, forward-unfiltered, radiosity, radiosity-without-ambient, radiosity-diffuse, cache, radiance, mitsuba, luxcore [default: all]
    #[arg(long, value_name = "NAMES", value_delimiter = ',')]
    pub systems: Vec<String>,
    /// Width and height of pictures [default: 640x360, with --quick 320x180]
    #[arg(long, value_name = "WxH", value_parser = quantity::pixels)]
    pub size: Option<(u32, u32)>,
    /// Seed of the random numbers
    #[arg(long, value_name = "N", value_parser = quantity::seed, default_value = "1", allow_hyphen_values = true)]
    pub seed: u64,
    /// Threads of every system [default: all there are]
    #[arg(long, value_name = "N", value_parser = quantity::threads, allow_hyphen_values = true)]
    pub threads: Option<u16>,
}
