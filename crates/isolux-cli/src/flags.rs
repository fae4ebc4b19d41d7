//! Arguments as written.

use crate::appearance::{self, ExposureChoice, ProfileChoice};
use crate::dimming::{DimmedMap, dimmed_group};
use crate::quantity;
use clap::{Args, Parser, Subcommand, ValueEnum};
use isolux_view::WhiteAdaptation;
use std::path::PathBuf;
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
    /// What to do.
    #[command(subcommand)]
    pub command: Command,
}

/// The subcommands.
#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Compute the illumination map of a scene
    Solve(SolveFlags),
    /// Say what a scene, a map or a photometric file holds
    Info(InfoFlags),
    /// Read a map, or trace paths, at points
    Probe(ProbeFlags),
    /// Illuminance on calculation grids: mean, least, greatest, uniformity
    Grid(GridFlags),
    /// Draw a view from a map
    Render(RenderFlags),
    /// Walk through a map in a browser
    View(ViewFlags),
    /// Write a map for other software: .wrl, .x3d, .vtu, .ply, .csv; lightmaps as .glb, .exr, .ktx2; .html to walk through in a browser
    Export(ExportFlags),
    /// Add maps of luminaire groups, each dimmed as you like, without a new run
    Mix(MixFlags),
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
    /// Write a scene as files to open and edit
    Scene(SceneFlags),
    /// Solve a real interior and draw it, from nothing
    Demo(DemoFlags),
}

const SCENE_HELP: &str = "Path of a scene (.gltf, .glb, .obj, .ply, .rad, .stl, .xml, scene.toml), builtin:cube, builtin:sphere, builtin:hall or a \
     variant of it (builtin:hall,triangles=1e6,luminaires=100), builtin:truth-00 to builtin:truth-59";

#[derive(Debug, Args)]
#[command(after_help = "Examples:
  isolux solve room.glb -o map.glb --accuracy 1%
  isolux solve builtin:cube -o cube.glb --quality draft --json
  isolux solve room.glb -o map.glb --time-limit 5min
  isolux solve room.glb -o map.glb --layout texels --texels-per-meter 20")]
pub(crate) struct SolveFlags {
    #[arg(help = SCENE_HELP)]
    pub scene: PathBuf,
    /// Where to write the map (.glb)
    #[arg(short, long, value_name = "MAP.glb", required_unless_present = "dry_run")]
    pub output: Option<PathBuf>,
    #[command(flatten)]
    pub layout: LayoutFlags,
    /// Stop when the whole error of the scene is this small: 1% or 0.01
    #[arg(long, value_name = "SHARE", value_parser = quantity::share, allow_hyphen_values = true, default_value = "1%",
          conflicts_with = "quality")]
    pub accuracy: f64,
    /// Subdivide until the bare interpolated map is this good (best effort)
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
    /// Memory for elements and rays, some 50 MB of the program beside; refuses where it does not do: 8GiB, 500MB
    #[arg(long, value_name = "SIZE", value_parser = quantity::memory_bytes, allow_hyphen_values = true, default_value = "8GiB")]
    pub max_memory: u64,
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

/// How the light is shown in a `.glb`.
#[derive(Debug, Args)]
pub(crate) struct LayoutFlags {
    /// Light at vertices, or in a lightmap (MAP.exr is written beside it, with every digit)
    #[arg(long, value_enum, default_value = "vertices")]
    pub layout: LayoutName,
    /// Density of a lightmap [default: that of the map, if it has texels already, or some 130 000 texels over all surfaces]
    #[arg(long, value_name = "N", value_parser = quantity::density, allow_hyphen_values = true)]
    pub texels_per_meter: Option<f64>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum LayoutName {
    /// At the vertices of the elements
    Vertices,
    /// As texels of a lightmap over the geometry of the scene
    Texels,
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

#[derive(Debug, Args)]
#[command(after_help = "Examples:
  isolux info map.glb
  isolux info lamp.ies --json")]
pub(crate) struct InfoFlags {
    /// A map (.glb), a scene (.gltf, .glb, .obj, .ply, .rad, .stl, .xml, scene.toml, builtin:NAME), a photometric file (.ies, .ldt) or a cache
    /// of samples
    pub file: PathBuf,
}

#[derive(Debug, Args)]
#[command(after_help = "Examples:
  isolux probe map.glb --points desk.pts
  echo '1 2 0.75  0 0 1' | isolux probe map.glb --points - --exact --json
  isolux probe map.glb --points desk.pts --exact -o desk.res
  isolux probe builtin:hall --points desk.pts --paths 65536

Points are `x y z nx ny nz`, one a line, in metres and in the axes of the scene as written; # starts a comment. \
A point on no surface with a known value has empty fields (null in JSON), unless --exact is given.

Of a scene instead of a map, paths are traced at every point: slow, but without the bias of a map and on \
no surface, too. It leaves out the light that glass, gloss and curved mirrors throw on surfaces (caustics).")]
pub(crate) struct ProbeFlags {
    /// The map (.glb), or a scene, which needs no map but time
    #[arg(value_name = "MAP|SCENE")]
    pub source: PathBuf,
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
    /// Interpolate direct light, too: what a viewer of the bare map shows
    #[arg(long)]
    pub interpolated: bool,
    /// Paths to trace at every point of a scene, at least 32 [default: 16384]; four times as many
    /// halve the standard error
    #[arg(long, value_name = "N", value_parser = quantity::paths, allow_hyphen_values = true)]
    pub paths: Option<u32>,
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
map. Squared differences, less the noise of the paths, tell the true error with an interval of 95 %. Exit code 1 where the error \
that the map tells is contradicted, which happens to a true one once in a thousand times at most.")]
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
#[command(after_help = "Examples:
  isolux grid map.glb
  isolux grid map.glb --height 0.75 --maintenance-factor 0.8 --picture desk-height.png
  isolux grid room.toml --accuracy 2% --name desk --csv desk.csv
  isolux grid map.glb --corner 0,0,0.75 --u 2,0,0 --v 0,1,0 --spacing 0.25

Grids are those of the scene ([[grid]] in scene.toml), or one given here. Points lie in the middles of cells as \
EN 12464-1 spaces them and face the way of u cross v. Values are maintained illuminance: the initial one times \
the maintenance factor. Intervals are of 95 %. A scene is solved first; to keep its map, solve it yourself.")]
pub(crate) struct GridFlags {
    /// The map (.glb), or a scene
    #[arg(value_name = "MAP|SCENE")]
    pub source: PathBuf,
    /// One grid of the scene only
    #[arg(long, value_name = "NAME", conflicts_with_all = ["height", "corner"])]
    pub name: Option<String>,
    /// A working plane at this height, m, over all of the floor plan
    #[arg(long, value_name = "M", value_parser = quantity::metres, allow_hyphen_values = true, conflicts_with = "corner")]
    pub height: Option<f64>,
    /// A corner of a grid, x,y,z, in metres and in the axes of the scene as written
    #[arg(long, value_name = "X,Y,Z", value_parser = quantity::triple, allow_hyphen_values = true, requires = "u", requires = "v")]
    pub corner: Option<[f64; 3]>,
    /// One side of it
    #[arg(long, value_name = "X,Y,Z", value_parser = quantity::triple, allow_hyphen_values = true, requires = "corner")]
    pub u: Option<[f64; 3]>,
    /// The other side, at right angles
    #[arg(long, value_name = "X,Y,Z", value_parser = quantity::triple, allow_hyphen_values = true, requires = "corner")]
    pub v: Option<[f64; 3]>,
    /// Distance of points, m [default: that of EN 12464-1]
    #[arg(long, value_name = "M", value_parser = quantity::metres, allow_hyphen_values = true)]
    pub spacing: Option<f64>,
    /// Width of the band along the sides that is left out, m [default: with --height half a metre or 15 % of the
    /// shorter side, whichever is less; else none]
    #[arg(long, value_name = "M", value_parser = quantity::metres, allow_hyphen_values = true)]
    pub border: Option<f64>,
    /// The share of the initial light that is left when maintained: 0.8 or 80%; 1 is all of it [default: the grid's, else 1]
    #[arg(long, value_name = "SHARE", value_parser = quantity::maintenance_factor, allow_hyphen_values = true)]
    pub maintenance_factor: Option<f64>,
    /// Of a scene: solve it to this accuracy [default: 1%]
    #[arg(long, value_name = "SHARE", value_parser = quantity::share, allow_hyphen_values = true)]
    pub accuracy: Option<f64>,
    /// Write all points with their values
    #[arg(long, value_name = "FILE.csv")]
    pub csv: Option<PathBuf>,
    /// Draw the one grid in false colour with isolux lines, u to the right and v up
    #[arg(long, value_name = "FILE.png")]
    pub picture: Option<PathBuf>,
}

#[derive(Debug, Args)]
#[command(after_help = "Examples:
  isolux render map.glb --camera door -o door.png
  isolux render map.glb --camera door -o lux.png --false-colour --limits 0:500 --contours
  isolux render map.glb --camera door -o door.png --exposure ev9 --tone linear --brightness 0.1 --contrast 1.2
  isolux render map.glb --camera door -o door.png --tone ward --display-white 250cd/m2 --profile monitor.icc
  isolux render map.glb --camera door -o door.png --exposure map --white 2700K --profile display-p3
  isolux render builtin:hall --cache hall.cache --camera entrance -o entrance.png

With --cache no map is read: indirect light comes from the samples in the file, and what the view still \
needs is computed and added to it. A later view of the same scene computes only what is new.")]
pub(crate) struct RenderFlags {
    /// The map (.glb); with --cache a scene will do
    #[arg(value_name = "MAP|SCENE")]
    pub map: PathBuf,
    /// Name of a camera of the scene
    #[arg(long, value_name = "NAME")]
    pub camera: Option<String>,
    /// Where to write the picture (.png)
    #[arg(short, long, value_name = "V.png")]
    pub output: PathBuf,
    /// Pixels across and down, without the legend of false colours
    #[arg(long, value_name = "WxH", value_parser = quantity::pixels, default_value = "1280x720")]
    pub size: (u32, u32),
    /// Read the bare map, all light interpolated: fast, and what a viewer of it shows
    #[arg(long)]
    pub interpolated: bool,
    /// With --interpolated: time to look for finer shadows first, as `view` and `export` of .html do
    #[arg(long, value_name = "TIME", value_parser = quantity::duration, allow_hyphen_values = true, requires = "interpolated")]
    pub finer: Option<Duration>,
    /// Take indirect light from this cache of samples, and add those that are missing
    #[arg(long, value_name = "FILE", conflicts_with = "interpolated")]
    pub cache: Option<PathBuf>,
    /// With --cache: how good a map those samples would make (best effort)
    #[arg(long, value_name = "SHARE", value_parser = quantity::share, allow_hyphen_values = true, default_value = "1%",
          requires = "cache")]
    pub accuracy: f64,
    #[command(flatten)]
    pub look: LookFlags,
}

/// How luminance becomes a picture.
#[derive(Debug, Args)]
pub(crate) struct LookFlags {
    /// auto, map (alike for all cameras), an exposure value (ev8), the luminance shown as white (500cd/m2) or as middle
    /// grey (grey 90cd/m2), or the share of lit pixels no brighter than white (99%)
    #[arg(long, value_name = "EXPOSURE", value_parser = appearance::exposure, default_value = "auto",
          conflicts_with = "false_colour", allow_hyphen_values = true)]
    pub exposure: ExposureChoice,
    /// How luminance is fitted to the display
    #[arg(long, value_enum, default_value = "reinhard", conflicts_with = "false_colour")]
    pub tone: ToneName,
    /// With --tone linear: what is added to the signal, -1 to 1 [default: 0]
    #[arg(long, value_name = "N", value_parser = appearance::brightness, conflicts_with = "false_colour",
          allow_hyphen_values = true)]
    pub brightness: Option<f64>,
    /// With --tone linear: a factor on the signal about its middle, 0 to 100 [default: 1]
    #[arg(long, value_name = "N", value_parser = appearance::contrast, conflicts_with = "false_colour",
          allow_hyphen_values = true)]
    pub contrast: Option<f64>,
    /// With --tone ward or tumblin-rushmeier: the luminance of the white of the display [default: 100cd/m2]
    #[arg(long, value_name = "LUMINANCE", value_parser = appearance::display_white, conflicts_with = "false_colour",
          allow_hyphen_values = true)]
    pub display_white: Option<f64>,
    /// Light that is to look white: a colour temperature (2700K), or scene, the mean of the surfaces seen [default: D65, as in sRGB]
    #[arg(long, value_name = "WHITE", value_parser = appearance::white, conflicts_with = "false_colour",
          allow_hyphen_values = true)]
    pub white: Option<WhiteAdaptation>,
    /// The display: srgb, display-p3, or an ICC file of one; the picture says which
    #[arg(long, value_name = "PROFILE", value_parser = appearance::profile, default_value = "srgb",
          conflicts_with = "false_colour")]
    pub profile: ProfileChoice,
    /// Colours that stand for lux, with a legend
    #[arg(long, visible_alias = "false-color")]
    pub false_colour: bool,
    /// With --false-colour: lux of the first and the last colour [default: from the picture]
    #[arg(long, visible_alias = "scale", value_name = "LOW:HIGH", value_parser = quantity::range, allow_hyphen_values = true,
          requires = "false_colour")]
    pub limits: Option<(f64, f64)>,
    /// With --false-colour: spread the colours evenly over the logarithm
    #[arg(long, requires = "false_colour")]
    pub logarithmic: bool,
    /// With --false-colour: draw lines of equal illuminance
    #[arg(long, requires = "false_colour")]
    pub contours: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum ToneName {
    /// Proportional, cut off at white: the picture can be measured
    Linear,
    /// Reinhard's photographic curve
    Reinhard,
    /// Hable's filmic curve
    Hable,
    /// Ward's scale factor: what can just be seen there can just be seen here
    Ward,
    /// Tumblin and Rushmeier's power: as bright here as there
    TumblinRushmeier,
}

#[derive(Debug, Args)]
#[command(after_help = "Examples:
  isolux view map.glb
  isolux view before.glb after.glb
  isolux view map.glb --no-open --port 8080
  isolux view map.glb --address 0.0.0.0

The page shows the map as a walk-through, in false colour, with lux and standard error under the pointer, as `probe` reads them. \
If the map is a sum of groups (solve --group), they can be dimmed there. Two maps are compared side by side. The command \
serves the page until it is stopped by Ctrl-C. Nothing leaves this machine, unless --address says so: then \
the address that is printed has a token, without which nothing is answered.")]
pub(crate) struct ViewFlags {
    /// The map (.glb)
    #[arg(value_name = "MAP.glb")]
    pub map: PathBuf,
    /// Another map (.glb), compared with the first
    #[arg(value_name = "OTHER.glb")]
    pub other: Option<PathBuf>,
    #[command(flatten)]
    pub server: ServerFlags,
}

/// Where a page is served.
#[derive(Debug, Args)]
pub(crate) struct ServerFlags {
    /// Print the address and open no browser
    #[arg(long)]
    pub no_open: bool,
    /// Port of the page [default: any that is free]
    #[arg(long, value_name = "PORT", default_value = "0", hide_default_value = true)]
    pub port: u16,
    /// Address to listen at: another than one of this machine alone makes a token
    #[arg(long, value_name = "IP", default_value = "127.0.0.1")]
    pub address: std::net::IpAddr,
}

#[derive(Debug, Args)]
#[command(after_help = "Examples:
  isolux export map.glb -o room.html
  isolux export map.glb -o room.wrl
  isolux export map.glb -o room.vtu
  isolux export map.glb -o baked.glb --target bevy
  isolux export map.glb -o baked.glb --layout texels --target three --texels-per-meter 20
  isolux export map.glb -o baked.glb --layout texels --target three --onto scene.glb
  isolux export map.glb -o lightmap.exr

The extension tells the kind: .html is the walk-through of `view` in one file, which opens without a server and without a network; .wrl (VRML97) and .x3d to walk through, colours unlit; .vtu for ParaView; .ply; .csv with a row \
a vertex. Values are those of the bare map at its vertices. The map itself is a .glb that viewers of glTF open.

A .glb has colours of vertices under unlit materials, without the map: luminance in proportion, as an engine shows it, with the \
luminance of white printed and noted in the file (--target viewer: tone mapped).

Lightmaps (.glb with --layout texels, .exr, .ktx2) are baked from the map: direct light afresh, over all of each texel; or taken from it, if `solve --layout texels` baked them. --target \
says for whom: it decides unit, side of pi and how the .glb refers to the light, all of which is printed. Beside a .glb its \
lightmap is written as .exr, for three and bevy as .ktx2, too. Further pages are named lightmap-1.exr and so on.")]
pub(crate) struct ExportFlags {
    /// The map (.glb)
    pub map: PathBuf,
    /// Where to write, with the extension of the kind
    #[arg(short, long, value_name = "FILE")]
    pub output: PathBuf,
    #[command(flatten)]
    pub layout: LayoutFlags,
    /// Who will show the light of a .glb or of a lightmap
    #[arg(long, value_enum, default_value = "viewer")]
    pub target: TargetName,
    /// Give surfaces that no light of this map reaches no texels: lightmaps of other light no longer lie alike
    #[arg(long)]
    pub without_dark: bool,
    /// The glTF scene of the map (.glb, .gltf): write it again with the lightmap, and all else as it is
    #[arg(long, value_name = "SCENE")]
    pub onto: Option<PathBuf>,
    /// Leave out the luminaires of --onto, as their light is in the lightmap
    #[arg(long)]
    pub without_lights: bool,
    /// With .html: another map (.glb) to be compared with this one
    #[arg(long, value_name = "MAP.glb")]
    pub beside: Option<PathBuf>,
    /// With .html: time to look for finer shadows than the map has
    #[arg(long, value_name = "TIME", value_parser = quantity::duration, allow_hyphen_values = true, default_value = "20s")]
    pub finer: Duration,
    /// Luminance that colours of vertices show as white: 500cd/m2 [default: what 99 % of all surfaces stay below]
    #[arg(long, value_name = "LUMINANCE", value_parser = quantity::luminance_cd_m2, allow_hyphen_values = true)]
    pub white: Option<f64>,
    /// Refuse to need more memory than this for a lightmap: 8GiB, 500MB
    #[arg(long, value_name = "SIZE", value_parser = quantity::memory_bytes, allow_hyphen_values = true, default_value = "8GiB")]
    pub max_memory: u64,
    /// Threads to use, at most 1024 [default: all there are]; the result does not depend on it
    #[arg(long, value_name = "N", value_parser = quantity::threads, allow_hyphen_values = true)]
    pub threads: Option<u16>,
}

/// Consumers of light at vertices or in lightmaps.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum TargetName {
    /// Any viewer of glTF: finished colours
    Viewer,
    /// three.js: colours; lightmaps of illuminance, MOZ_lightmap
    Three,
    /// Godot 4: colours, of which it keeps 8 bits; lightmaps: luminance as emission
    Godot,
    /// Unity with glTFast: colours; lightmaps: luminance as emission
    Unity,
    /// Blender: colours; lightmaps: luminance as emission
    Blender,
    /// Bevy: colours; lightmaps of illuminance over pi, MOZ_lightmap
    Bevy,
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
}

#[derive(Debug, Args)]
#[command(after_help = "Examples:
  isolux lint lamp.ies
  isolux lint *.ies *.ldt --json
  isolux lint lamp.ies --polar lamp.svg --draw
  isolux lint lamp.ldt --convert lamp.ies

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
