//! Where maps are compared with long paths: places that know nothing of a mesh but the surfaces it stands for.

use isolux::elements::carries_map;
use isolux::engine::ProbePoint;
use isolux::geometry::{Direction, Point, Ray};
use isolux::sampling::Key;
use isolux::scene::{LuminaireKind, Scene};
use std::f64::consts::TAU;

/// A place and how it was drawn.
#[derive(Clone, Debug, PartialEq)]
pub struct TruthPlace {
    /// Where, and the way it faces.
    pub at: ProbePoint,
    /// Name of its shape.
    pub surface: String,
    /// How it was drawn.
    pub stratum: Stratum,
}

/// Ways of drawing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stratum {
    /// By area: means over these places are means over the surface.
    Area,
    /// Near an edge of a triangle, at any distance from it alike in logarithm.
    Edge,
    /// On any triangle, large or small.
    Small,
    /// The surface closest to a luminaire.
    Lamp,
}

impl Stratum {
    /// Its name in tables.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Area => "area",
            Self::Edge => "edge",
            Self::Small => "small",
            Self::Lamp => "lamp",
        }
    }
}

/// Random numbers for one place are so many.
const NUMBERS: usize = 4;
/// Places near edges are no closer to them than this share of the triangle: readings on an edge belong to either side.
const CLOSEST: f64 = 1e-3;
/// Directions that look for the surface closest to a luminaire.
const LOOKS: u64 = 64;

/// `by_area` places by area, then `beside` places in each of the other strata.
pub fn places(scene: &Scene, by_area: u32, beside: u32, seed: u64) -> Vec<TruthPlace> {
    let drawn = Drawing::new(scene, seed);
    let strata = [
        (Stratum::Area, by_area),
        (Stratum::Edge, beside),
        (Stratum::Small, beside),
        (Stratum::Lamp, beside),
    ];
    strata
        .into_iter()
        .flat_map(|(stratum, count)| {
            (0..count).filter_map(|k| drawn.place(stratum, k)).collect::<Vec<_>>()
        })
        .collect()
}

/// The sides of surfaces that carry a map, and sums of their areas.
struct Drawing<'a> {
    scene: &'a Scene,
    key: Key,
    sides: Vec<(u32, bool)>,
    sums_m2: Vec<f64>,
    luminaires: Vec<Point>,
}

impl<'a> Drawing<'a> {
    fn new(scene: &'a Scene, seed: u64) -> Self {
        let both = |triangle| [false, true].map(|back| (triangle, back));
        let carries = |&(triangle, back): &(u32, bool)| carries_map(scene, triangle, back);
        let sides: Vec<_> = (0..scene.triangle_count()).flat_map(both).filter(carries).collect();
        let mut sum_m2 = 0.0;
        let sums_m2 = sides.iter().map(|&(triangle, _)| {
            sum_m2 += scene.triangle(triangle).area();
            sum_m2
        });
        let sums_m2 = sums_m2.collect();
        Self { scene, key: Key::new(seed).with(0x7275), sides, sums_m2, luminaires: centres(scene) }
    }

    fn place(&self, stratum: Stratum, index: u32) -> Option<TruthPlace> {
        let key = self.key.with(stratum as u64).with(u64::from(index));
        let numbers: [f64; NUMBERS] = std::array::from_fn(|k| key.with(k as u64).uniform());
        let (side, [u, v]) = match stratum {
            Stratum::Area => (self.side_by_area(numbers[0])?, inside(numbers[1], numbers[2])),
            Stratum::Edge => (self.any_side(numbers[0])?, near_edge(numbers)),
            Stratum::Small => (self.any_side(numbers[0])?, inside(numbers[1], numbers[2])),
            Stratum::Lamp => self.closest(numbers[0], key)?,
        };
        Some(self.at(stratum, side, [u, v]))
    }

    fn side_by_area(&self, share: f64) -> Option<(u32, bool)> {
        let area_m2 = self.sums_m2.last()?;
        let drawn = self.sums_m2.partition_point(|&sum| sum <= share * area_m2);
        self.sides.get(drawn).copied()
    }

    fn any_side(&self, share: f64) -> Option<(u32, bool)> {
        self.sides.get((share * self.sides.len() as f64) as usize).copied()
    }

    /// What a luminaire comes closest to, by some rays.
    fn closest(&self, share: f64, key: Key) -> Option<((u32, bool), [f64; 2])> {
        let lamp = *self.luminaires.get((share * self.luminaires.len() as f64) as usize)?;
        let look = |k: u64| {
            let [a, b] = [0, 1].map(|d| key.with(NUMBERS as u64 + 2 * k + d).uniform());
            let hit = self.scene.bvh().closest_hit(&Ray::new(lamp, anywhere([a, b])))?;
            let surface = self.scene.hit_point(&hit);
            let above = (lamp - surface).dot(self.scene.geometric_normal(hit.triangle).to_vector());
            let side = (hit.triangle, above < 0.0);
            let found = (side, [f64::from(hit.u), f64::from(hit.v)]);
            self.sides.contains(&side).then(|| ((lamp - surface).length(), found))
        };
        let closest = (0..LOOKS).filter_map(look).min_by(|(a, _), (b, _)| a.total_cmp(b));
        closest.map(|(_, found)| found)
    }

    fn at(&self, stratum: Stratum, (triangle, back): (u32, bool), [u, v]: [f64; 2]) -> TruthPlace {
        let front = self.scene.shading_normal(triangle, u, v);
        let normal = if back { -front } else { front };
        let position = self.scene.triangle(triangle).point(u, v);
        let surface = self.scene.shape_names()[self.scene.shape_of(triangle) as usize].clone();
        TruthPlace { at: ProbePoint { position, normal }, surface, stratum }
    }
}

/// Where luminaires are; of surfaces that shine the middles of their triangles.
fn centres(scene: &Scene) -> Vec<Point> {
    let points = scene.luminaires().iter().filter_map(|luminaire| match luminaire.kind {
        LuminaireKind::Point { position, .. } => Some(position),
        LuminaireKind::Directional { .. } | LuminaireKind::Sky { .. } => None,
    });
    let triangles = scene.area_luminaires().iter().flat_map(|area| &area.triangles);
    points.chain(triangles.map(|&triangle| scene.triangle(triangle).centroid())).collect()
}

/// Uniform in a triangle: folded over the diagonal of the unit square.
fn inside(a: f64, b: f64) -> [f64; 2] {
    if a + b > 1.0 { [1.0 - a, 1.0 - b] } else { [a, b] }
}

/// Near one of three edges, and at times near one of its ends, too.
fn near_edge([_, way, along, edge]: [f64; NUMBERS]) -> [f64; 2] {
    let small = CLOSEST * (0.3 / CLOSEST).powf(way);
    let along = (1.0 - small) * along;
    let weights = [small, along, 1.0 - small - along];
    let first = (3.0 * edge) as usize;
    [weights[first], weights[(first + 1) % 3]]
}

fn anywhere([a, b]: [f64; 2]) -> Direction {
    let z = 1.0 - 2.0 * a;
    let (s, c) = libm::sincos(TAU * b);
    let r = (1.0 - z * z).max(0.0).sqrt();
    isolux::geometry::Vector::new(r * c, r * s, z).direction().unwrap_or(Direction::Z)
}
