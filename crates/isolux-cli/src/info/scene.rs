//! What a scene holds.

use crate::console::{facts, print, print_json, table};
use crate::daylight::Daylight;
use crate::failure::Failure;
use crate::installed::Installed;
use crate::maintained::Maintained;
use crate::quantity::{flux, significant};
use crate::shown::{name, names};
use isolux::geometry::Point;
use isolux::photometry::IntensityDistribution;
use isolux::scene::{Body, Finish, LuminaireKind, Material, Scene, UpAxis};
use isolux_formats::counted;
use serde::Serialize;

/// Materials shown in text; JSON holds all.
const MAX_SHOWN: usize = 30;

/// Light that has an illuminance but no flux.
const FAR: [&str; 2] = ["directional", "sky"];

/// Prints a scene.
pub(super) fn show(scene: &Scene, json: bool) -> Result<(), Failure> {
    let contents = Contents::of(scene);
    if json { print_json(&contents) } else { print(&contents.text()) }
}

/// Names in a row.
pub(super) fn list(all: &[String]) -> String {
    if all.is_empty() { "none".to_owned() } else { names(all.iter().map(String::as_str)) }
}

/// What `info --json` prints of a scene.
#[derive(Serialize)]
pub(super) struct Contents {
    kind: &'static str,
    name: String,
    up: UpAxis,
    low_m: Option<[f64; 3]>,
    high_m: Option<[f64; 3]>,
    triangles: u32,
    shapes: usize,
    textures: usize,
    cameras: Vec<String>,
    groups: Vec<String>,
    luminaires: Vec<Luminaires>,
    luminous_flux_lm: f64,
    #[serde(flatten)]
    installed: Installed,
    #[serde(flatten)]
    daylight: Daylight,
    #[serde(flatten)]
    maintained: Maintained,
    materials: Vec<Surface>,
}

/// Luminaires of one kind.
#[derive(Serialize)]
struct Luminaires {
    kind: &'static str,
    count: usize,
    luminous_flux_lm: f64,
}

/// One material.
#[derive(Serialize)]
struct Surface {
    name: String,
    kind: &'static str,
    diffuse: Option<f64>,
    mirror: Option<f64>,
    luminance_cd_m2: Option<f64>,
}

impl Contents {
    fn of(scene: &Scene) -> Self {
        let bounds = scene.bvh().mesh().bounds();
        let corner = |p: Point| <[f64; 3]>::from(p);
        Self {
            kind: "scene",
            name: scene.name().to_owned(),
            up: scene.up(),
            low_m: bounds.map(|(low, _)| corner(low)),
            high_m: bounds.map(|(_, high)| corner(high)),
            triangles: scene.triangle_count(),
            shapes: scene.shape_names().len(),
            textures: scene.textures().len(),
            cameras: scene.cameras().iter().map(|c| c.name.clone()).collect(),
            groups: scene.groups().to_vec(),
            luminaires: luminaires(scene),
            // A sum of nothing is -0.
            luminous_flux_lm: scene.luminous_flux_lm() + 0.0,
            installed: Installed::of(scene),
            daylight: Daylight::of(scene),
            maintained: Maintained::of(scene),
            materials: scene.materials().iter().map(surface).collect(),
        }
    }

    fn has_parallel(&self) -> bool {
        self.luminaires.iter().any(|l| FAR.contains(&l.kind))
    }

    fn text(&self) -> String {
        let corner = |c: Option<[f64; 3]>| {
            let [x, y, z] = c.unwrap_or_default().map(|c| significant(c, 3));
            format!("({x}, {y}, {z}) m")
        };
        let up = match self.up {
            UpAxis::Y => "y",
            UpAxis::Z => "z",
        };
        let mut rows = vec![
            ("scene", name(&self.name)),
            ("from", corner(self.low_m)),
            ("to", corner(self.high_m)),
            ("up", up.to_owned()),
            (
                "triangles",
                format!("{} in {}", self.triangles, counted(self.shapes, "shape", "shapes")),
            ),
            ("textures", self.textures.to_string()),
            ("cameras", list(&self.cameras)),
            ("light groups", list(&self.groups)),
            ("luminous flux", flux(self.luminous_flux_lm, self.has_parallel())),
            ("light", self.maintained.text()),
        ];
        rows.extend(self.installed.text().map(|text| ("power", text)));
        rows.extend(self.daylight.rows());
        let mut text = facts(&rows);
        let light = |l: &Luminaires| {
            let lm = match l.kind {
                kind if FAR.contains(&kind) => "-".to_owned(),
                _ => significant(l.luminous_flux_lm, 3),
            };
            vec![l.kind.to_owned(), l.count.to_string(), lm]
        };
        let rows: Vec<Vec<String>> = self.luminaires.iter().map(light).collect();
        text += &format!("\n{}", table(&["light", "count", "lm"], &rows));
        let rows: Vec<Vec<String>> =
            self.materials.iter().take(MAX_SHOWN).map(Surface::row).collect();
        let header = ["material", "kind", "diffuse", "mirror", "cd/m2"];
        text += &format!("\n{}", table(&header, &rows));
        if self.materials.len() > MAX_SHOWN {
            text += &format!("and {} more; --json lists all\n", self.materials.len() - MAX_SHOWN);
        }
        text
    }
}

impl Surface {
    fn row(&self) -> Vec<String> {
        let number = |value: Option<f64>| value.map_or("-".to_owned(), |v| significant(v, 2));
        vec![
            name(&self.name),
            self.kind.to_owned(),
            number(self.diffuse),
            number(self.mirror),
            number(self.luminance_cd_m2),
        ]
    }
}

fn luminaires(scene: &Scene) -> Vec<Luminaires> {
    let mut found: Vec<Luminaires> = Vec::new();
    let mut add = |kind, flux_lm| match found.iter_mut().find(|l| l.kind == kind) {
        Some(known) => {
            known.count += 1;
            known.luminous_flux_lm += flux_lm;
        }
        None => found.push(Luminaires { kind, count: 1, luminous_flux_lm: flux_lm }),
    };
    for luminaire in scene.luminaires() {
        match &luminaire.kind {
            LuminaireKind::Point { intensity, .. } => {
                add(distribution(intensity), intensity.luminous_flux_lm());
            }
            LuminaireKind::Directional { .. } => add(FAR[0], 0.0),
            LuminaireKind::Sky { .. } => add(FAR[1], 0.0),
        }
    }
    scene.area_luminaires().iter().for_each(|area| add("surface", area.luminous_flux_lm()));
    found
}

fn distribution(intensity: &IntensityDistribution) -> &'static str {
    match intensity {
        IntensityDistribution::Isotropic { .. } => "isotropic",
        IntensityDistribution::CosinePower { .. } => "cosine power",
        IntensityDistribution::Spot { .. } => "spot",
        IntensityDistribution::Web(_) => "measured",
    }
}

fn surface(material: &Material) -> Surface {
    let (kind, finish) = match &material.body {
        Body::Opaque { front, back } if front == back => ("two-sided", Some(front)),
        Body::Opaque { front, back } if *back == Finish::BLACK => ("one-sided", Some(front)),
        Body::Opaque { front, .. } => ("different sides", Some(front)),
        Body::Dielectric(glass) if glass.thin => ("pane", None),
        Body::Dielectric(_) => ("solid glass", None),
    };
    Surface {
        name: material.name.clone(),
        kind,
        diffuse: finish.map(|f| f.diffuse.colour.luminance()),
        mirror: finish.map(|f| f.mirror.luminance()),
        luminance_cd_m2: finish.map(|f| f.luminance_cd_m2.luminance()).filter(|l| *l > 0.0),
    }
}
