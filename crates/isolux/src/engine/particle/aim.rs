//! Importance sampling of specular surfaces by particles.
//!
//! Where specular surfaces are few and small, hardly any particle from a luminaire meets one: in the hall one
//! in seventy, and one in six hundred brings a caustic. So most particles are aimed from a luminaire at a
//! place on a specular surface; the pair is drawn by the light expected between them. The others are emitted
//! as luminaires emit, so that no particle has a large weight where the expectation was wrong. The two are
//! weighted by the balance heuristic (Veach and Guibas 1995, "Optimally combining sampling techniques for
//! Monte Carlo rendering"). Light that meets another surface first is direct light, and not counted here.

use crate::engine::light::{Emission, Emitted};
use crate::engine::ray::{Dice, SurfacePoint};
use crate::scene::{Body, Finish, Scene};
use isolux_geometry::{Point, Vector};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

/// One particle in this many is not aimed. No aimed particle so carries more than eight times its share,
/// whatever was expected wrongly (decision 27).
const UNAIMED_DIVISOR: u32 = 8;

/// The largest number of groups of specular triangles.
const MOST_GROUPS: usize = 64;
/// The largest number of pairs of a group and a luminaire.
const MOST_PAIRS: usize = 1 << 20;

/// The share of aimed particles that is distributed as before learning, so that groups without a caustic so
/// far get some.
const UNLEARNED_SHARE: f64 = 0.1;

/// The largest distance from its target at which an aimed particle may arrive, as a share of its path. The
/// reason is single precision.
const OFF_TARGET_SHARE: f64 = 1e-4;

/// The distribution of aimed particles.
#[derive(Serialize, Deserialize)]
pub(crate) struct Aim {
    groups: Vec<Group>,
    /// The group of every triangle of the scene; `None` if it is not specular.
    group_of: Vec<Option<u32>>,
    luminaires: usize,
    /// The running sums of the probabilities of pairs, all luminaires of the first group first.
    sums: Vec<f64>,
}

/// Specular triangles close to each other.
#[derive(Serialize, Deserialize)]
struct Group {
    triangles: Vec<u32>,
    /// The running sums of their areas, m2.
    sums_m2: Vec<f64>,
    low: Point,
    high: Point,
}

/// A particle on its way to a specular surface.
pub(crate) struct Aimed {
    pub(crate) emitted: Emitted,
    /// The place it is aimed at; `None` if it is not aimed.
    target: Option<Point>,
}

impl Aim {
    /// The distribution for a scene; `None` where nothing is specular.
    pub(crate) fn new(scene: &Scene, emission: &Emission) -> Option<Self> {
        let is_specular = specular(scene);
        let specular = |t: &u32| {
            is_specular[scene.material_index(*t) as usize] && scene.triangle(*t).area() > 0.0
        };
        let all: Vec<u32> = (0..scene.triangle_count()).filter(specular).collect();
        if all.is_empty() {
            return None;
        }
        let luminaires = emission.count();
        let most = (MOST_PAIRS / luminaires).clamp(1, MOST_GROUPS);
        let groups = grouped(scene, all, most);
        let mut group_of = vec![None; scene.triangle_count() as usize];
        for (k, group) in groups.iter().enumerate() {
            group.triangles.iter().for_each(|&t| group_of[t as usize] = Some(k as u32));
        }
        let chance = |pair: usize| {
            let group = &groups[pair / luminaires];
            let least_m = 0.5 * (group.high - group.low).length();
            let middle = group.low.lerp(group.high, 0.5);
            group.area_m2() * emission.reach(pair % luminaires, middle, least_m)
        };
        let pairs = 0..groups.len() * luminaires;
        let chances: Vec<f64> = pairs.into_par_iter().with_min_len(256).map(chance).collect();
        Some(Self { groups, group_of, luminaires, sums: running_sums(&chances) })
    }

    /// Whether the groups are triangles of a scene, and the luminaires those of its emission.
    pub(crate) fn is_of(&self, scene: &Scene, emission: &Emission) -> bool {
        let triangles = scene.triangle_count();
        let is_group = |group: &Group| {
            !group.triangles.is_empty()
                && group.sums_m2.len() == group.triangles.len()
                && group.triangles.iter().all(|&t| t < triangles)
        };
        !self.groups.is_empty()
            && self.luminaires == emission.count()
            && self.sums.len() == self.groups.len() * self.luminaires
            && self.group_of.len() == triangles as usize
            && self.group_of.iter().flatten().all(|&g| (g as usize) < self.groups.len())
            && self.groups.iter().all(is_group)
    }

    pub(crate) const fn groups(&self) -> usize {
        self.groups.len()
    }

    /// The distribution with more particles to groups that bring more light; `brought` is the root mean
    /// square of the particles to each group.
    pub(crate) fn learned(self, brought: &[f64]) -> Self {
        let whole = self.whole();
        let of_pair = |pair: usize| self.of_pair(pair) / whole;
        let all: f64 =
            (0..self.sums.len()).map(|pair| of_pair(pair) * brought[pair / self.luminaires]).sum();
        if all <= 0.0 {
            return self;
        }
        let chance = |pair: usize| {
            let learned = brought[pair / self.luminaires] / all;
            of_pair(pair) * (UNLEARNED_SHARE + (1.0 - UNLEARNED_SHARE) * learned)
        };
        let chances: Vec<f64> = (0..self.sums.len()).map(chance).collect();
        Self { sums: running_sums(&chances), ..self }
    }

    /// The number of `count` particles that are not aimed, at least one.
    pub(crate) fn unaimed(count: u32) -> u32 {
        count.div_ceil(UNAIMED_DIVISOR)
    }

    /// The group that a particle is aimed at.
    pub(crate) fn group(&self, dice: &mut Dice) -> usize {
        self.pair(dice.pair()[0]).0 / self.luminaires
    }

    /// An aimed particle; `None` if there is no light in that direction.
    pub(crate) fn send(
        &self,
        scene: &Scene,
        emission: &Emission,
        dice: &mut Dice,
    ) -> Option<Aimed> {
        let [pick, of_group] = dice.pair();
        let [a, b] = dice.pair();
        let place = dice.pair();
        let (pair, left) = self.pair(pick);
        let group = &self.groups[pair / self.luminaires];
        let m2 = of_group * group.area_m2();
        let drawn = group.sums_m2.partition_point(|&sum| sum <= m2);
        let triangle = group.triangles[drawn.min(group.triangles.len() - 1)];
        let root = a.sqrt();
        let target = scene.triangle(triangle).point(root * (1.0 - b), root * b);
        let emitted = emission.towards(pair % self.luminaires, target, left, place)?;
        Some(Aimed { emitted, target: Some(target) })
    }

    /// The weight of a particle at the first surface that it meets, if the share `unaimed` of all is not
    /// aimed. `None` if it does not count.
    pub(crate) fn weight(
        &self,
        emission: &Emission,
        aimed: &Aimed,
        at: &SurfacePoint,
        unaimed: f64,
    ) -> Option<f64> {
        let group = self.group_of[at.triangle as usize]? as usize;
        let way_m = (at.point - aimed.emitted.ray.origin).length();
        if aimed.target.is_some_and(|to| (to - at.point).length() > OFF_TARGET_SHARE * way_m) {
            return None;
        }
        let pair = group * self.luminaires + emission.number(aimed.emitted.luminaire);
        let sent = self.of_pair(pair) / self.whole() / self.groups[group].area_m2();
        let let_go = emission.density(&aimed.emitted, at);
        let both = unaimed * let_go + (1.0 - unaimed) * sent;
        (both > 0.0).then(|| let_go / both)
    }

    fn whole(&self) -> f64 {
        self.sums.last().copied().unwrap_or(0.0)
    }

    fn of_pair(&self, pair: usize) -> f64 {
        self.sums[pair] - pair.checked_sub(1).map_or(0.0, |before| self.sums[before])
    }

    /// The pair for a number of [0, 1), and the remainder of that number, uniform again.
    fn pair(&self, pick: f64) -> (usize, f64) {
        let wanted = pick * self.whole();
        let pair = self.sums.partition_point(|&sum| sum <= wanted).min(self.sums.len() - 1);
        let before = pair.checked_sub(1).map_or(0.0, |before| self.sums[before]);
        let left = (wanted - before) / self.of_pair(pair).max(f64::MIN_POSITIVE);
        (pair, left.clamp(0.0, 1.0 - f64::EPSILON))
    }
}

impl Aimed {
    /// A particle as luminaires emit it.
    pub(crate) fn let_go(emission: &Emission, dice: &mut Dice) -> Option<Self> {
        Some(Self { emitted: emission.emit(dice)?, target: None })
    }
}

impl Group {
    fn new(scene: &Scene, triangles: Vec<u32>) -> Self {
        let areas: Vec<f64> = triangles.iter().map(|&t| scene.triangle(t).area()).collect();
        let corners = triangles.iter().flat_map(|&t| scene.triangle(t).corners);
        let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
        for Point { x, y, z } in corners {
            for (axis, value) in [x, y, z].into_iter().enumerate() {
                low[axis] = low[axis].min(value);
                high[axis] = high[axis].max(value);
            }
        }
        let point = |[x, y, z]: [f64; 3]| Point::new(x, y, z);
        Self { sums_m2: running_sums(&areas), triangles, low: point(low), high: point(high) }
    }

    fn area_m2(&self) -> f64 {
        self.sums_m2.last().copied().unwrap_or(0.0)
    }

    fn extent_m2(&self) -> f64 {
        (self.high - self.low).length_squared()
    }

    /// The two halves of the group along the longest side of its bounds.
    fn halves(self, scene: &Scene) -> [Self; 2] {
        let Vector { x, y, z } = self.high - self.low;
        let middle = |triangle: u32| {
            let Point { x: px, y: py, z: pz } =
                scene.triangle(triangle).point(1.0 / 3.0, 1.0 / 3.0);
            if x >= y && x >= z {
                px
            } else if y >= z {
                py
            } else {
                pz
            }
        };
        let mut keyed: Vec<(f64, u32)> =
            self.triangles.into_iter().map(|t| (middle(t), t)).collect();
        let half = keyed.len() / 2;
        keyed.select_nth_unstable_by(half, |a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        // The order of centroids decides the half; within it, triangles are ordered by number.
        let sorted = |some: &[(f64, u32)]| {
            let mut triangles: Vec<u32> = some.iter().map(|&(_, t)| t).collect();
            triangles.sort_unstable();
            Self::new(scene, triangles)
        };
        [sorted(&keyed[..half]), sorted(&keyed[half..])]
    }
}

/// The specular materials.
pub(crate) fn specular(scene: &Scene) -> Vec<bool> {
    scene.materials().iter().map(|material| sends_on(&material.body)).collect()
}

/// Whether a body passes on light other than by diffuse reflection.
fn sends_on(body: &Body) -> bool {
    let finish = |finish: &Finish| finish.is_glossy() || !finish.mirror.is_black();
    match body {
        Body::Dielectric(_) => true,
        Body::Opaque { front, back } => finish(front) || finish(back),
    }
}

/// Groups of triangles by material; then the widest group is halved until there are `most`.
fn grouped(scene: &Scene, all: Vec<u32>, most: usize) -> Vec<Group> {
    let mut by_material: Vec<Vec<u32>> = vec![Vec::new(); scene.materials().len()];
    all.iter().for_each(|&t| by_material[scene.material_index(t) as usize].push(t));
    by_material.retain(|triangles| !triangles.is_empty());
    if by_material.len() > most {
        by_material = vec![all];
    }
    let mut groups: Vec<Group> =
        by_material.into_iter().map(|triangles| Group::new(scene, triangles)).collect();
    while groups.len() < most {
        let can_be = |group: &&(usize, &Group)| group.1.triangles.len() > 1;
        let widest = groups
            .iter()
            .enumerate()
            .filter(|of| can_be(&of))
            .max_by(|a, b| a.1.extent_m2().total_cmp(&b.1.extent_m2()));
        let Some((widest, _)) = widest else { break };
        let halves = groups.swap_remove(widest).halves(scene);
        groups.extend(halves);
    }
    groups
}

fn running_sums(values: &[f64]) -> Vec<f64> {
    let mut sum = 0.0;
    let add = |value: &f64| {
        sum += value;
        sum
    };
    values.iter().map(add).collect()
}
