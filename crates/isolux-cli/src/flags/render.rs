//! Arguments of `render`.

use super::solve::FURTHER_HELP;
use crate::appearance::{self, ExposureChoice, ProfileChoice, WhiteChoice};
use crate::quantity;
use clap::{Args, ValueEnum};
use std::ffi::OsString;
use std::path::PathBuf;
use std::time::Duration;

/// Options of views that Radiance writes with one dash.
const OF_RADIANCE: [&str; 10] =
    ["-vf", "-vp", "-vd", "-vu", "-vh", "-vv", "-vo", "-va", "-vs", "-vl"];

/// A word of the command line, with two dashes where Radiance writes one: `-vp` is `--vp`, and `-vtl` is `--vt=l`.
pub(crate) fn with_two_dashes(word: OsString) -> OsString {
    let Some(text) = word.to_str() else { return word };
    if OF_RADIANCE.contains(&text) {
        return format!("-{text}").into();
    }
    match text.strip_prefix("-vt") {
        Some(kind) if kind.len() == 1 => format!("--vt={kind}").into(),
        _ => word,
    }
}

#[derive(Debug, Args)]
#[command(after_help = "Examples:
  isolux render map.glb --camera door -o door.png
  isolux render room.toml -o room.png
  isolux render map.glb --all-cameras -o 'view-{camera}.png'
  isolux render map.glb --camera door -o door.png -o door.exr --false-colour-output door-lux.png --contours
  isolux render map.glb --eye 1,2,1.6 --target 4,2,1 --fov 60 -o desk.png
  isolux render map.glb --eye 3,2,1.6 --panorama -o around.png
  isolux render map.glb -vth -vp 2 2 1.2 -vd 0 0 1 -vu 0 1 0 -vh 180 -vv 180 -o ceiling.hdr
  isolux render map.glb --vf nave.vf -o nave.png
  isolux render map.glb --camera door -o lux.png --false-colour --limits 0:500 --contours
  isolux render map.glb --camera door -o door.png --exposure ev9 --tone linear --brightness 0.1 --contrast 1.2
  isolux render map.glb --camera door -o door.png --tone ward --display-white 250cd/m2 --profile monitor.icc
  isolux render map.glb --camera door -o door.png --exposure map --white 2700K --profile display-p3
  isolux render builtin:hall --cache hall.cache --camera nave -o nave.png

Without a camera, and if the scene has none, the view is from eye height inside, where most lit space is seen.

A scene is solved first, to the error of --accuracy, and its map is not kept: to draw several views, solve it and draw them from \
the map.

With --cache no map is read: indirect light comes from the samples in the file, and what the view still \
needs is computed and added to it. A later view of the same scene computes only what is new.

A view in which nothing is lit ends with exit code 2, without a picture.")]
pub(crate) struct RenderFlags {
    /// The map (.glb), or a scene
    #[arg(value_name = "MAP|SCENE")]
    pub map: PathBuf,
    #[arg(value_name = "MORE.rad", help = FURTHER_HELP)]
    pub further: Vec<PathBuf>,
    #[command(flatten)]
    pub eye: EyeFlags,
    /// Where to write: a picture (.png), or luminance in cd/m2 (.exr, .hdr). Several files of one view: -o again. With several
    /// cameras each name holds `{camera}`
    #[arg(short, long, value_name = "FILE", required = true)]
    pub output: Vec<PathBuf>,
    /// Pixels across and down, without the legend of false colours. Panoramas and the views of Radiance but -vtv get the largest
    /// picture of their own shape that fits in
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
    /// Of a scene: the error that it is solved to first [default: 5%]. With --cache: how good a map the samples would make (best
    /// effort) [default: 1%]
    #[arg(long, value_name = "SHARE", value_parser = quantity::share, allow_hyphen_values = true)]
    pub accuracy: Option<f64>,
    /// The noise that the picture may have: the mean difference of colours from those without noise, CIE94 (1 is just seen where
    /// two areas meet). The picture is written when it is complete, and again as it gets better [default: 0.5]
    #[arg(long, value_name = "CIE94", value_parser = quantity::colour_difference, allow_hyphen_values = true,
          conflicts_with_all = ["interpolated", "cache"])]
    pub picture_accuracy: Option<f64>,
    #[command(flatten)]
    pub look: LookFlags,
}

/// Where views are from.
#[derive(Debug, Args)]
pub(crate) struct EyeFlags {
    /// Name of a camera of the scene; several cameras: --camera again
    #[arg(long, value_name = "NAME")]
    pub camera: Vec<String>,
    /// A picture by each camera of the scene
    #[arg(long, conflicts_with = "camera")]
    pub all_cameras: bool,
    /// Where the eye is, in the axes of the scene: 1,2,1.6
    #[arg(long, value_name = "X,Y,Z", value_parser = quantity::triple, allow_hyphen_values = true,
          conflicts_with_all = ["camera", "all_cameras"])]
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
    /// All that is around the eye, twice as wide as high (equirectangular), its middle where the eye looks
    #[arg(long, conflicts_with_all = ["fov", "vt"])]
    pub panorama: bool,
    #[command(flatten)]
    pub radiance: RadianceFlags,
}

/// A view as Radiance writes it.
#[derive(Debug, Args)]
#[group(id = "radiance", multiple = true, conflicts_with_all = ["eye", "camera", "all_cameras"])]
pub(crate) struct RadianceFlags {
    /// A view file of Radiance (-vf); the options below count before it
    #[arg(long, visible_alias = "vf", value_name = "FILE")]
    pub radiance_view: Option<PathBuf>,
    /// Radiance's type of view (-vtv): v perspective, l parallel, h hemispherical and a angular fisheye, c cylindrical
    #[arg(long, value_name = "TYPE", value_parser = ["v", "l", "h", "a", "c"])]
    pub vt: Option<String>,
    /// Where the eye is (-vp)
    #[arg(long, value_names = ["X", "Y", "Z"], num_args = 3, value_parser = quantity::coordinate, allow_hyphen_values = true)]
    pub vp: Option<Vec<f64>>,
    /// The direction of the view (-vd)
    #[arg(long, value_names = ["X", "Y", "Z"], num_args = 3, value_parser = quantity::coordinate, allow_hyphen_values = true)]
    pub vd: Option<Vec<f64>>,
    /// What is up in the picture (-vu)
    #[arg(long, value_names = ["X", "Y", "Z"], num_args = 3, value_parser = quantity::coordinate, allow_hyphen_values = true)]
    pub vu: Option<Vec<f64>>,
    /// Angle from the left to the right edge in degrees, of -vtl the length (-vh); the width of -vtv follows from --size
    #[arg(long, value_name = "DEGREES", value_parser = quantity::coordinate, allow_hyphen_values = true)]
    pub vh: Option<f64>,
    /// Angle from the lower to the upper edge in degrees, of -vtl the length (-vv)
    #[arg(long, value_name = "DEGREES", value_parser = quantity::coordinate, allow_hyphen_values = true)]
    pub vv: Option<f64>,
    /// Clipping planes and shifts (-vo, -va, -vs, -vl): zero, as Radiance writes where there are none
    #[arg(long, value_name = "0", value_parser = zero, allow_hyphen_values = true, hide = true)]
    pub vo: Option<f64>,
    #[arg(long, value_name = "0", value_parser = zero, allow_hyphen_values = true, hide = true)]
    pub va: Option<f64>,
    #[arg(long, value_name = "0", value_parser = zero, allow_hyphen_values = true, hide = true)]
    pub vs: Option<f64>,
    #[arg(long, value_name = "0", value_parser = zero, allow_hyphen_values = true, hide = true)]
    pub vl: Option<f64>,
}

/// What clipping planes and shifts of views can be.
fn zero(text: &str) -> Result<f64, String> {
    match text.parse() {
        Ok(0.0) => Ok(0.0),
        _ => Err("can only be 0; leave it out".to_owned()),
    }
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
    #[arg(long, value_enum, default_value = "filmic", conflicts_with = "false_colour")]
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
    /// Light that is to look white: auto (nearly, the light of the luminaires, as eyes adapt), none (colours as they are), a colour
    /// temperature (2700K), or scene, the mean of the surfaces seen
    #[arg(long, value_name = "WHITE", value_parser = appearance::white, default_value = "auto",
          conflicts_with = "false_colour", allow_hyphen_values = true)]
    pub white: WhiteChoice,
    /// The display: srgb, display-p3, or an ICC file of one; the picture says which
    #[arg(long, value_name = "PROFILE", value_parser = appearance::profile, default_value = "srgb",
          conflicts_with = "false_colour")]
    pub profile: ProfileChoice,
    /// Colours that stand for lux, with a legend, in place of a picture
    #[arg(long, visible_alias = "false-color", group = "chart")]
    pub false_colour: bool,
    /// Write a false colour image of the same view, too
    #[arg(long, visible_alias = "false-color-output", value_name = "LUX.png", group = "chart")]
    pub false_colour_output: Option<PathBuf>,
    /// With false colours: lux of the first and the last colour [default: from the picture]
    #[arg(long, visible_alias = "scale", value_name = "LOW:HIGH", value_parser = quantity::range, allow_hyphen_values = true,
          requires = "chart")]
    pub limits: Option<(f64, f64)>,
    /// With false colours: spread the colours evenly over the logarithm
    #[arg(long, requires = "chart")]
    pub logarithmic: bool,
    /// With false colours: draw lines of equal illuminance
    #[arg(long, requires = "chart")]
    pub contours: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum ToneName {
    /// Proportional, with a shoulder for what is bright: as a photograph of a room
    Filmic,
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
