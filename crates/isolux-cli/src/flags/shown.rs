//! Arguments of what shows maps: `render`, `view`, `export`.

use crate::appearance::{self, ExposureChoice, ProfileChoice};
use crate::quantity;
use clap::{Args, ValueEnum};
use isolux_view::WhiteAdaptation;
use std::path::PathBuf;
use std::time::Duration;

#[derive(Debug, Args)]
#[command(after_help = "Examples:
  isolux render map.glb --camera door -o door.png
  isolux render map.glb --eye 1,2,1.6 --target 4,2,1 --fov 60 -o desk.png
  isolux render map.glb --vf nave.vf -o nave.png
  isolux render map.glb --camera door -o lux.png --false-colour --limits 0:500 --contours
  isolux render map.glb --camera door -o door.png --exposure ev9 --tone linear --brightness 0.1 --contrast 1.2
  isolux render map.glb --camera door -o door.png --tone ward --display-white 250cd/m2 --profile monitor.icc
  isolux render map.glb --camera door -o door.png --exposure map --white 2700K --profile display-p3
  isolux render builtin:hall --cache hall.cache --camera entrance -o entrance.png

Without a camera, and if the scene has none, the view is from eye height inside, where most lit space is seen.

With --cache no map is read: indirect light comes from the samples in the file, and what the view still \
needs is computed and added to it. A later view of the same scene computes only what is new.")]
pub(crate) struct RenderFlags {
    /// The map (.glb); with --cache a scene will do
    #[arg(value_name = "MAP|SCENE")]
    pub map: PathBuf,
    /// Name of a camera of the scene
    #[arg(long, value_name = "NAME")]
    pub camera: Option<String>,
    #[command(flatten)]
    pub eye: EyeFlags,
    /// Where to write the picture (.png)
    #[arg(short, long, value_name = "V.png")]
    pub output: PathBuf,
    /// Pixels across and down, without the legend of false colours
    #[arg(long, value_name = "WxH", value_parser = quantity::pixels, default_value = "1280x720")]
    pub size: (u32, u32),
    /// Read the interpolated map: fast, and what a viewer shows
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

/// The eye of a view that is no camera of the scene.
#[derive(Debug, Args)]
pub(crate) struct EyeFlags {
    /// Where the eye is, in the axes of the scene: 1,2,1.6
    #[arg(long, value_name = "X,Y,Z", value_parser = quantity::triple, allow_hyphen_values = true, conflicts_with = "camera")]
    pub eye: Option<[f64; 3]>,
    /// What it looks at [default: the middle of the scene]
    #[arg(long, value_name = "X,Y,Z", value_parser = quantity::triple, allow_hyphen_values = true, requires = "eye")]
    pub target: Option<[f64; 3]>,
    /// What is up in the picture [default: up of the scene]
    #[arg(long, value_name = "X,Y,Z", value_parser = quantity::triple, allow_hyphen_values = true, requires = "eye")]
    pub up: Option<[f64; 3]>,
    /// Angle from the lower to the upper edge, in degrees [default: 66]
    #[arg(long, value_name = "DEGREES", value_parser = quantity::angle_deg, allow_hyphen_values = true, requires = "eye")]
    pub fov: Option<f64>,
    /// A view file of Radiance (-vf); of its angles the vertical one counts, --size says how wide the picture is
    #[arg(long, visible_alias = "vf", value_name = "FILE", conflicts_with_all = ["eye", "camera"])]
    pub radiance_view: Option<PathBuf>,
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
a vertex. Values are those of the interpolated map at its vertices. The map itself is a .glb that viewers of glTF open.

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
    /// With .csv: significant digits of illuminances [default: two below the first digit of the standard error]
    #[arg(long, value_name = "N", value_parser = quantity::digits, allow_hyphen_values = true)]
    pub digits: Option<u8>,
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
