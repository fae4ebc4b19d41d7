//! The walls of a room, as if nothing stood before them: a control variate of gathering.
//!
//! What a place gathers from large plane surfaces whose light is a polynomial, with nothing between, has a closed form. What rays
//! find of the same is known, too. Where most of what a place sees are walls, rays are as wrong about both, so that the difference of the two
//! takes most of their noise off what they gather, whatever stands in the room: its mean is zero.

mod lanes;
mod planes;
mod polynomial;

use crate::engine::ray::{ShortRays, SurfacePoint};
use crate::quadrature::GaussRule;
use crate::sampling::Key;
use crate::scene::Scene;
use crate::units::Rgb;
use isolux_geometry::{Direction, Normal, Point};
use planes::Rectangle;
use polynomial::{COUNT, Polynomial, View, powers};
use rayon::prelude::*;
use std::sync::LazyLock;

/// Walls at most: a room has six.
const MOST: usize = 8;
/// Places of a wall each way whose light is asked for.
const PLACES: usize = 16;
/// A polynomial is held as if it were nothing at so many more places, in proportion: where few places are lit.
const HELD: f64 = 1e-6;
/// The share of all surface that has to see mostly walls, for which some places stand.
const CLEAR_SHARE: f64 = 0.3;
pub(crate) const SOME: usize = 64;
/// What polynomials may leave out of direct light on walls: where they leave out more, as pools of many luminaires, they take no noise off.
pub(crate) const LEFT_OUT: f64 = 0.3;
/// Noise that is left of what it is without walls, for which they are worth while.
pub(crate) const WORTH: f64 = 0.7;
/// Rays tell whether something stands before the walls; of so many so many have to come to them.
const TRIED: usize = 16;
const CLEAR: usize = 12;
static RULE: LazyLock<GaussRule> = LazyLock::new(|| GaussRule::new(PLACES));
static DIRECTIONS: LazyLock<ShortRays<TRIED>> = LazyLock::new(|| ShortRays::of(Key::new(0)));
/// How far a ray to a wall may end before or behind it, as a share of its length and the size of the wall.
const BESIDE: f64 = 1e-3;
/// Walls are left out for places farther away from their middle than so many halves of their sides: the closed form loses its
/// digits there.
const FAR: f64 = 24.0;

/// Where rays start, about what they are distributed, and the triangle that they leave.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Stand {
    pub(crate) origin: Point,
    pub(crate) normal: Normal,
    pub(crate) triangle: u32,
}

/// Walls and their light.
#[derive(Debug)]
pub(crate) struct ControlVariate {
    walls: Vec<Wall>,
}

#[derive(Debug)]
struct Wall {
    rectangle: Rectangle,
    /// What it reflects, lx, photometric, and its colour.
    light: Polynomial,
    tint: Rgb,
    /// What it does at the places asked for, lx, photometric: nothing where that is not known.
    lit: Vec<Option<f64>>,
}

/// Integrals over walls: of light, of its square, and of the square of what is left of it.
#[derive(Default)]
struct Moments {
    area_m2: f64,
    light: f64,
    squared: f64,
    left: f64,
}

impl Moments {
    fn add(&mut self, m2: f64, light: f64, left: f64) {
        self.area_m2 += m2;
        self.light += m2 * light;
        self.squared += m2 * light * light;
        self.left += m2 * left * left;
    }

    /// The root mean square of what is left, as a share of that of the differences; all if there are none.
    fn left_out(&self) -> f64 {
        let spread = self.squared - self.light * self.light / self.area_m2;
        if spread > 0.0 { (self.left / spread).sqrt() } else { 1.0 }
    }
}

/// A wall as seen from a place.
pub(crate) struct Seen<'a> {
    wall: &'a Wall,
    view: View,
}

impl ControlVariate {
    /// The walls of a scene that has large plane surfaces, in the dark, if enough of these places, each with the surface that it stands
    /// for, see them.
    pub(crate) fn seen_by(
        scene: &Scene,
        places: impl Iterator<Item = (Stand, f64)>,
    ) -> Option<Self> {
        let places: Vec<_> = places.collect();
        Self::of(scene).filter(|walls| walls.share_of_clear(scene, &places) >= CLEAR_SHARE)
    }

    /// The same, whoever sees them.
    pub(crate) fn of(scene: &Scene) -> Option<Self> {
        let dark = |rectangle: Rectangle| {
            let light = Polynomial([0.0; COUNT]);
            Wall { rectangle, light, tint: Rgb::BLACK, lit: Vec::new() }
        };
        let largest = planes::largest(scene).into_iter();
        let faced = largest.filter(|rectangle| rectangle.faces_something(scene));
        let walls: Vec<Wall> = faced.take(MOST).map(dark).collect();
        (!walls.is_empty()).then_some(Self { walls })
    }

    /// Takes down their light: `light_at` tells what comes to a place of them, if that is known. Returns what of its differences from
    /// place to place that leaves out, root mean square.
    pub(crate) fn see(
        &mut self,
        scene: &Scene,
        light_at: impl Fn(&SurfacePoint) -> Option<Rgb> + Sync,
    ) -> f64 {
        let of_walls = self.walls.par_iter_mut().map(|wall| wall.see(scene, &light_at));
        let of_walls: Vec<Moments> = of_walls.collect();
        let all = of_walls.iter().fold(Moments::default(), |all, of| Moments {
            area_m2: all.area_m2 + of.area_m2,
            light: all.light + of.light,
            squared: all.squared + of.squared,
            left: all.left + of.left,
        });
        all.left_out()
    }

    /// What it leaves out of the differences between some places, likewise: of each, its surface, m2, and what is reflected there, lx.
    /// Those that do not lie on walls do not count.
    pub(crate) fn leaves_out(&self, places: impl Iterator<Item = (Stand, f64, f64)>) -> f64 {
        let mut all = Moments::default();
        for (of, m2, light) in places {
            if let Some(told) = self.walls.iter().find_map(|wall| wall.tells(&of)) {
                all.add(m2, light, light - told);
            }
        }
        all.left_out()
    }

    /// Of the surface that some places stand for, the share that sees mostly walls.
    fn share_of_clear(&self, scene: &Scene, places: &[(Stand, f64)]) -> f64 {
        let is_clear = |(of, _): &(Stand, f64)| Self::is_clear(scene, of, &self.seen_from(of));
        let clear: Vec<bool> = places.par_iter().map(is_clear).collect();
        let all_m2: f64 = places.iter().map(|(_, m2)| m2).sum();
        let of_clear = places.iter().zip(clear).filter(|(_, is_clear)| *is_clear);
        let clear_m2: f64 = of_clear.map(|((_, m2), _)| m2).sum();
        if all_m2 > 0.0 { clear_m2 / all_m2 } else { 0.0 }
    }

    /// What a place gets from it if nothing is between; nothing where too much is.
    pub(crate) fn behind(&self, scene: &Scene, of: &Stand) -> Option<Rgb> {
        let seen = self.seen_from(of);
        if seen.is_empty() || !Self::is_clear(scene, of, &seen) {
            return None;
        }
        Some(seen.iter().map(Seen::illuminance).sum())
    }

    /// The walls that a place may see.
    pub(crate) fn seen_from(&self, of: &Stand) -> Vec<Seen<'_>> {
        self.walls.iter().filter_map(|wall| Seen::from(of, wall)).collect()
    }

    /// Whether enough rays come to the walls, and as large a share of their light; and whether polynomials tell the light there. A bright
    /// part that something hides, or one that the polynomial alone has, would add more noise than all others take off; and what
    /// noise makes of light is bounded, which makes light.
    fn is_clear(scene: &Scene, of: &Stand, seen: &[Seen<'_>]) -> bool {
        let ray = |k: usize| DIRECTIONS.ray(k, (of.origin, of.normal, of.triangle));
        let met = DIRECTIONS.met(scene, ray);
        let (mut count, mut light, mut all_light) = (0, 0.0, 0.0);
        let (mut squared, mut left) = (0.0, 0.0);
        for (k, met) in met.iter().enumerate() {
            let direction = DIRECTIONS.direction(k, of.normal);
            let shown = |s: &Seen<'_>| s.light(direction).map_or(0.0, |of| of.luminance().max(0.0));
            let own_light: f64 = seen.iter().map(shown).sum();
            all_light += own_light;
            let far = |s: &Seen<'_>| s.at(direction).map(|(far_m, _)| (far_m, s.size_m()));
            let mut along = seen.iter().filter_map(far);
            let Some((far_m, size_m)) = along.next() else { continue };
            let is_at = |other_m: f64| (other_m - far_m).abs() <= BESIDE * (far_m + size_m);
            // A wall that another stands before is not seen.
            let comes_there = along.all(|(other_m, _)| is_at(other_m))
                && met.is_some_and(|hit| is_at(f64::from(hit.t)));
            if comes_there {
                count += 1;
                light += own_light;
                if let Some([lit, told]) = seen.iter().find_map(|s| s.lit_and_told(direction)) {
                    squared += lit * lit;
                    left += (lit - told) * (lit - told);
                }
            }
        }
        let are_told = left <= WORTH * WORTH * squared;
        are_told && count >= CLEAR && light * TRIED as f64 >= all_light * CLEAR as f64
    }
}

/// What is to be added to what rays find for what they find of the walls.
pub(crate) fn lacking(walls: &[Seen<'_>], directions: &[Direction]) -> Rgb {
    let found = walls.iter().flat_map(|wall| directions.iter().filter_map(|&d| wall.light(d)));
    found.fold(Rgb::BLACK, |lacking, light| lacking - light)
}

impl Wall {
    /// Finds the polynomial that comes nearest to the light of its places.
    fn see(
        &mut self,
        scene: &Scene,
        light_at: &(impl Fn(&SurfacePoint) -> Option<Rgb> + Sync),
    ) -> Moments {
        let rule = &*RULE;
        self.lit.clear();
        let mut sums = Sums::default();
        let mut colour = Rgb::BLACK;
        let mut places = Vec::with_capacity(PLACES * PLACES);
        for (&x, &weight_x) in rule.nodes.iter().zip(&rule.weights) {
            for (&y, &weight_y) in rule.nodes.iter().zip(&rule.weights) {
                let weight = weight_x * weight_y;
                let reflected = self.rectangle.surface(scene, [x, y]).and_then(|at| {
                    let finish = scene.material(at.triangle).finish(at.back)?;
                    let light = light_at(&at)?;
                    Some(light * scene.diffuse_reflectance(finish, at.triangle, at.u, at.v))
                });
                self.lit.push(reflected.map(Rgb::luminance));
                let Some(light) = reflected else { continue };
                colour += light * weight;
                sums.add(&powers([x, y]), light.luminance(), weight);
                places.push(([x, y], light.luminance(), weight));
            }
        }
        let all = colour.luminance();
        if let Some(light) = sums.solved().filter(|_| all > 0.0) {
            (self.light, self.tint) = (Polynomial(light), colour / all);
        }
        let [a, b] = self.rectangle.half_m;
        let mut moments = Moments::default();
        for (at, light, weight) in places {
            moments.add(weight * a * b, light, light - self.light.at(at));
        }
        moments
    }

    /// Its light at a place on it; nothing of one elsewhere.
    fn tells(&self, of: &Stand) -> Option<f64> {
        let Rectangle { middle, axes, half_m } = &self.rectangle;
        let to = of.origin - *middle;
        let before_m = BESIDE * half_m[0].min(half_m[1]);
        let is_on =
            to.dot(axes[2]).abs() < before_m && of.normal.to_vector().dot(axes[2]) > 1.0 - BESIDE;
        let place = [0, 1].map(|k| to.dot(axes[k]) / half_m[k]);
        let is_within = place.iter().all(|c| c.abs() <= 1.0);
        (is_on && is_within).then(|| self.light.at(place))
    }
}

impl<'a> Seen<'a> {
    fn from(of: &Stand, wall: &'a Wall) -> Option<Self> {
        let Rectangle { middle, axes, half_m } = &wall.rectangle;
        let normal = of.normal.to_vector();
        let view = View::new(of.origin - *middle, normal, axes);
        let is_near = |m: f64, half_m: f64| m.abs() < FAR * half_m;
        let least_m = half_m[0].min(half_m[1]);
        let is_before = view.height_m > 0.0
            && is_near(view.height_m, least_m)
            && (0..2).all(|k| is_near(view.foot_m[k], half_m[k]));
        is_before.then_some(Self { wall, view })
    }

    /// Half of the shorter side of the wall.
    fn size_m(&self) -> f64 {
        let [a, b] = self.wall.rectangle.half_m;
        a.min(b)
    }

    fn illuminance(&self) -> Rgb {
        let Wall { light, rectangle, tint, .. } = self.wall;
        *tint * light.illuminance(rectangle.half_m, &self.view)
    }

    /// Where a ray comes to it: how far away, m, and the place.
    fn at(&self, direction: Direction) -> Option<(f64, [f64; 2])> {
        let Rectangle { axes, half_m, .. } = &self.wall.rectangle;
        let direction = direction.to_vector();
        let falls = -direction.dot(axes[2]);
        if falls <= 0.0 {
            return None;
        }
        let far_m = self.view.height_m / falls;
        let place =
            [0, 1].map(|k| (self.view.foot_m[k] + far_m * direction.dot(axes[k])) / half_m[k]);
        (place[0].abs() <= 1.0 && place[1].abs() <= 1.0).then_some((far_m, place))
    }

    /// The least light that is known of the four places asked for about where a ray comes to it, and what is told of that: what stands on
    /// the wall may hide others.
    fn lit_and_told(&self, direction: Direction) -> Option<[f64; 2]> {
        let (_, place) = self.at(direction)?;
        let [x, y] = place.map(|c| {
            let after = RULE.nodes.partition_point(|node| *node < c);
            [after.saturating_sub(1), after.min(PLACES - 1)]
        });
        let about = x.into_iter().flat_map(|x| y.map(|y| [x, y]));
        let known =
            about.filter_map(|[x, y]| Some(((*self.wall.lit.get(PLACES * x + y)?)?, [x, y])));
        let (lit, least) = known.min_by(|a, b| a.0.total_cmp(&b.0))?;
        Some([lit, self.wall.light.at(least.map(|k| RULE.nodes[k]))])
    }

    fn light(&self, direction: Direction) -> Option<Rgb> {
        let (_, place) = self.at(direction)?;
        Some(self.wall.tint * self.wall.light.at(place))
    }
}

/// Normal equations of a polynomial.
struct Sums {
    products: [[f64; COUNT]; COUNT],
    values: [f64; COUNT],
}

impl Default for Sums {
    fn default() -> Self {
        Self { products: [[0.0; COUNT]; COUNT], values: [0.0; COUNT] }
    }
}

impl Sums {
    fn add(&mut self, powers: &[f64; COUNT], value: f64, weight: f64) {
        for (i, row) in self.products.iter_mut().enumerate() {
            for (k, product) in row.iter_mut().enumerate().take(i + 1) {
                *product += weight * powers[i] * powers[k];
            }
            self.values[i] += weight * powers[i] * value;
        }
    }

    /// By Cholesky's method; `None` without any place.
    fn solved(mut self) -> Option<[f64; COUNT]> {
        let held = HELD * self.products[0][0];
        let rows = &mut self.products;
        for i in 0..COUNT {
            rows[i][i] += held;
            for k in 0..=i {
                let known: f64 = (0..k).map(|j| rows[i][j] * rows[k][j]).sum();
                let left = rows[i][k] - known;
                if i == k {
                    if left <= 0.0 {
                        return None;
                    }
                    rows[i][i] = left.sqrt();
                } else {
                    rows[i][k] = left / rows[k][k];
                }
            }
        }
        let mut values = self.values;
        for i in 0..COUNT {
            let known: f64 = (0..i).map(|j| rows[i][j] * values[j]).sum();
            values[i] = (values[i] - known) / rows[i][i];
        }
        for i in (0..COUNT).rev() {
            let known: f64 = (i + 1..COUNT).map(|j| rows[j][i] * values[j]).sum();
            values[i] = (values[i] - known) / rows[i][i];
        }
        Some(values)
    }
}
