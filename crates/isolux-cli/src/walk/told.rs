//! What the page is told beside the scene: how `render` would show it.

use crate::{map_facts, traced};
use isolux::map::IlluminationMap;
use isolux::scene::{Camera, Scene};
use isolux::units::Rgb;
use isolux_formats::walk::{ColourMap, Steps, Told, Tone};
use isolux_view::{
    ColourMap as Map, Development, Exposure, Scale, Spaced, ToneOperator, light_of_groups,
    round_limits, tone_table,
};

/// The layer of a map whose light is not known by groups.
pub(crate) const ALL_LIGHT: &str = "all luminaires";

/// The picture by which the first exposure is found, pixels.
const GLIMPSE: (u32, u32) = (96, 54);

/// Everything about a map but its surfaces and its light.
pub(crate) fn told(
    (scene, map): (&Scene, &IlluminationMap),
    camera: &Camera,
    (file, other): (&str, Option<&str>),
    layers: Vec<String>,
) -> Told {
    Told {
        file: file.to_owned(),
        about: about(map),
        white_cd_m2: white_cd_m2((scene, map), camera),
        light_lm: light_lm(scene, &layers),
        tones: tones(),
        colour_maps: colour_maps(),
        scale_lx: limits_lx(map),
        layers,
        other: other.map(str::to_owned),
    }
}

/// Facts of a map.
fn about(map: &IlluminationMap) -> Vec<(String, String)> {
    let unknown = map.values.iter().filter(|value| value.is_none()).count();
    let facts = map_facts::of(&map.provenance, (map.values.len(), unknown));
    facts.map(|(name, value)| (name.to_owned(), value)).into()
}

/// The luminance that automatic exposure shows as 1, by a small picture of the bare map.
fn white_cd_m2((scene, map): (&Scene, &IlluminationMap), camera: &Camera) -> f64 {
    let view = traced::bare(scene, map, camera, GLIMPSE).ok();
    view.and_then(|view| Exposure::Automatic.white_cd_m2(&view).ok()).unwrap_or(1.0)
}

/// The light of the luminaires of each layer, lm: of the group of its name, or of all of them where there is one layer alone.
fn light_lm(scene: &Scene, layers: &[String]) -> Vec<Rgb> {
    let of_groups = light_of_groups(scene);
    let all = || of_groups.iter().copied().sum();
    let of_layer = |name: &String| match scene.groups().iter().position(|group| group == name) {
        Some(group) => of_groups.get(group).copied().unwrap_or(Rgb::BLACK),
        None if layers.len() == 1 => all(),
        None => Rgb::BLACK,
    };
    layers.iter().map(of_layer).collect()
}

/// The tone operators of `render`, its usual one first.
fn tones() -> Vec<Tone> {
    let display_white_cd_m2 = Development::default().display_white_cd_m2;
    let all = [
        ("filmic", "filmic", ToneOperator::Filmic),
        ("reinhard", "Reinhard 2002", ToneOperator::REINHARD),
        ("linear", "linear", ToneOperator::LINEAR),
        ("hable", "Hable 2010", ToneOperator::Hable),
        ("ward", "Ward 1994: visible contrast", ToneOperator::Ward),
        (
            "tumblin-rushmeier",
            "Tumblin, Rushmeier 1999: brightness",
            ToneOperator::TumblinRushmeier,
        ),
    ];
    let tone = |(name, label, operator)| {
        // The operators above have parameters that are allowed.
        let table = tone_table(operator, display_white_cd_m2).ok()?;
        Some(Tone {
            name,
            label,
            on_luminance: table.on_luminance,
            whites: steps(table.whites),
            exposed: steps(table.exposed),
            values: table.values,
        })
    };
    all.into_iter().filter_map(tone).collect()
}

fn steps(Spaced { first, step, count }: Spaced) -> Steps {
    Steps { first, step, count }
}

fn colour_maps() -> Vec<ColourMap> {
    let all = [("viridis", Map::Viridis), ("inferno", Map::Inferno), ("turbo", Map::Turbo)];
    all.map(|(name, map)| (name, map.table().to_vec())).into()
}

/// Round limits about the illuminances at all vertices.
fn limits_lx(map: &IlluminationMap) -> (f64, f64) {
    let values: Vec<Option<f64>> =
        map.values.iter().map(|value| value.map(|value| value.illuminance_lx())).collect();
    round_limits(Scale::Linear, &values).unwrap_or((0.0, 1.0))
}
