//! The places that an audit compares.

use crate::elements::carries_map;
use crate::engine::light::Emission;
use crate::engine::ray::SurfacePoint;
use crate::map::IlluminationMap;
use crate::sampling::{CosineHemisphere, Key};
use crate::scene::{LuminaireKind, Scene};
use isolux_geometry::{Direction, Ray, Vector};

/// One place in this many is drawn as a hard place.
const HARD_EVERY: u64 = 4;

/// The number of candidates of which the hardest is taken.
const CANDIDATES: u64 = 8;

/// The least distance of places near an edge, as a share of the triangle's height. The logarithm of the
/// distance is uniform.
const NEAREST: f64 = 1e-3;

/// The golden ratio less one. Its multiples fill the unit interval evenly, whatever their number.
const GOLDEN: f64 = 0.618_033_988_749_894_9;

/// The way a place was drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Where {
    /// A place drawn in proportion to area.
    ByArea,
    /// A place where large errors are likely.
    Hard,
}

/// A place and the way it was drawn.
pub(super) struct Drawn {
    pub(super) at: SurfacePoint,
    pub(super) drawn: Where,
}

/// The surfaces that carry a map.
pub(super) struct Places<'a> {
    scene: &'a Scene,
    map: &'a IlluminationMap,
    sides: Vec<(u32, bool)>,
    /// The running sums of their areas, m2.
    sums_m2: Vec<f64>,
    emission: Option<Emission<'a>>,
    key: Key,
}

impl<'a> Places<'a> {
    /// The surfaces of a scene; `None` if none carries a map.
    pub(super) fn new(scene: &'a Scene, map: &'a IlluminationMap, key: Key) -> Option<Self> {
        let all = (0..scene.triangle_count()).flat_map(|t| [(t, false), (t, true)]);
        let sides: Vec<_> = all.filter(|&(t, back)| carries_map(scene, t, back)).collect();
        let mut sum = 0.0;
        let add = |&(triangle, _): &(u32, bool)| {
            sum += scene.triangle(triangle).area();
            sum
        };
        let sums_m2: Vec<f64> = sides.iter().map(add).collect();
        sums_m2.last().is_some_and(|&sum| sum > 0.0).then_some(Self {
            scene,
            map,
            sides,
            sums_m2,
            emission: Emission::new(scene),
            key,
        })
    }

    /// The place with this number.
    pub(super) fn draw(&self, number: u64) -> Drawn {
        let key = self.key.with(number).with(2);
        if number % HARD_EVERY < HARD_EVERY - 1 {
            let start = self.key.with(u64::MAX).uniform();
            let among = number - number / HARD_EVERY;
            let along = (start + among as f64 * GOLDEN).fract();
            return Drawn { at: self.by_area(along, key), drawn: Where::ByArea };
        }
        let at = match number / HARD_EVERY % 5 {
            0 => self.by_count(key),
            1 => self.at_edge(key),
            2 => self.beside_something(key),
            3 => self.near_luminaire(key).unwrap_or_else(|| self.by_count(key)),
            _ => self.dim(key),
        };
        Drawn { at, drawn: Where::Hard }
    }

    /// A place at the share `along` of the running sum of areas.
    fn by_area(&self, along: f64, key: Key) -> SurfacePoint {
        let all_m2 = self.sums_m2[self.sums_m2.len() - 1];
        let side = self.sums_m2.partition_point(|&sum| sum <= along * all_m2);
        self.inside(side.min(self.sides.len() - 1), key)
    }

    fn inside(&self, side: usize, key: Key) -> SurfacePoint {
        let (triangle, back) = self.sides[side];
        let (root, b) = (key.with(0).uniform().sqrt(), key.with(1).uniform());
        SurfacePoint::new(self.scene, triangle, back, root * (1.0 - b), root * b)
    }

    fn anywhere(&self, key: Key) -> SurfacePoint {
        self.by_area(key.with(2).uniform(), key)
    }

    /// A place on a random triangle, whatever its size.
    fn by_count(&self, key: Key) -> SurfacePoint {
        let side = (key.with(2).uniform() * self.sides.len() as f64) as usize;
        self.inside(side.min(self.sides.len() - 1), key)
    }

    /// A place near an edge or a corner.
    fn at_edge(&self, key: Key) -> SurfacePoint {
        let at = self.anywhere(key);
        let near = |k: u64| libm::pow(NEAREST, key.with(k).uniform()) / 3.0;
        let (first, second) = (near(3), near(4));
        let along = key.with(5).uniform();
        let weights = if key.with(6).uniform() < 0.5 {
            [first, (1.0 - first) * along, (1.0 - first) * (1.0 - along)]
        } else {
            [first, second, 1.0 - first - second]
        };
        let turn = (key.with(7).uniform() * 3.0) as usize;
        let [u, v] = [weights[turn % 3], weights[(turn + 1) % 3]];
        SurfacePoint::new(self.scene, at.triangle, at.back, u, v)
    }

    /// The candidate with the nearest obstacle along a random ray.
    fn beside_something(&self, key: Key) -> SurfacePoint {
        let candidate = |k: u64| {
            let key = key.with(8 + k);
            let at = self.anywhere(key);
            let square = [key.with(3).uniform(), key.with(4).uniform()];
            let direction =
                at.geometric.to_direction().from_local(CosineHemisphere::sample(square));
            let hit = self.scene.bvh().closest_hit(&at.leave(direction));
            (hit.map_or(f64::INFINITY, |hit| f64::from(hit.t)), at)
        };
        self.least(candidate)
    }

    /// The candidate with the least light in the map.
    fn dim(&self, key: Key) -> SurfacePoint {
        let candidate = |k: u64| {
            let at = self.anywhere(key.with(8 + k));
            let told = self.map.interpolate(at.triangle, at.back, at.u, at.v);
            (told.map_or(f64::INFINITY, |told| told.illuminance_lx()), at)
        };
        self.least(candidate)
    }

    fn least(&self, candidate: impl Fn(u64) -> (f64, SurfacePoint)) -> SurfacePoint {
        let first = candidate(0);
        let nearer = |best: (f64, SurfacePoint), other: (f64, SurfacePoint)| {
            if other.0 < best.0 { other } else { best }
        };
        (1..CANDIDATES).map(candidate).fold(first, nearer).1
    }

    /// The place where a random ray from a luminaire arrives; most such places are near it.
    fn near_luminaire(&self, key: Key) -> Option<SurfacePoint> {
        let scene = self.scene;
        let count = scene.luminaires().len() + scene.area_luminaires().len();
        let square = |k: u64| [key.with(k).uniform(), key.with(k + 1).uniform()];
        let drawn = ((key.with(2).uniform() * count as f64) as usize).min(count.checked_sub(1)?);
        let ray = match scene.luminaires().get(drawn) {
            Some(luminaire) => match &luminaire.kind {
                LuminaireKind::Point { position, .. } => Ray::new(*position, any_way(square(3))?),
                LuminaireKind::Directional { .. } | LuminaireKind::Sky { .. } => return None,
            },
            None => self.emission.as_ref()?.leaving(
                drawn,
                key.with(5).uniform(),
                square(6),
                square(3),
            )?,
        };
        let hit = scene.bvh().closest_hit(&ray)?;
        let at = SurfacePoint::from_hit(scene, &hit);
        carries_map(scene, at.triangle, at.back).then_some(at)
    }
}

/// A direction uniform over the sphere.
fn any_way([a, b]: [f64; 2]) -> Option<Direction> {
    let z = 1.0 - 2.0 * a;
    let (s, c) = libm::sincos(std::f64::consts::TAU * b);
    let r = (1.0 - z * z).max(0.0).sqrt();
    Vector::new(r * c, r * s, z).direction()
}
