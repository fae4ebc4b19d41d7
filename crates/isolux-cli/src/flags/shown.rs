//! Arguments of what shows maps: `view`, `export`.

use crate::quantity;
use clap::{Args, ValueEnum};
use std::path::PathBuf;
use std::time::Duration;

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
    /// Lux and standard error beside the colours of vertices, those of each group, too: for the loaders of three.js and Bevy
    #[arg(long)]
    pub lux: bool,
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
