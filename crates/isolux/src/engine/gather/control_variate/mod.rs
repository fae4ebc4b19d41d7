//! The walls of a room without obstacles: a control variate of gathering.
//!
//! The illuminance from large plane surfaces whose light is a polynomial, without obstacles, has a closed form. The
//! estimate of this value by rays is known, too. Where a place mostly sees walls, both estimates of the rays have
//! about the same error. Adding the difference of closed form and estimate removes most of the noise of gathering,
//! whatever stands in the room: the mean of this difference is zero.

mod lanes;
mod planes;
mod polynomial;

use crate::engine::ray::{ShortRays, Stand, SurfacePoint};
use crate::quadrature::GaussRule;
use crate::sampling::Key;
use crate::scene::Scene;
use crate::units::Rgb;
use isolux_geometry::Direction;
use planes::{BESIDE_WALL_SHARE, Rectangle};
use polynomial::{COEFFICIENTS, Polynomial, View, powers};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use std::sync::LazyLock;

/// The largest number of walls: a room has six.
const MOST_WALLS: usize = 8;
/// The number of places of a wall along each side whose light is evaluated.
const PLACES_A_SIDE: usize = 16;
/// The ridge term of the fit, relative to the weight of all places. It matters where few places are lit.
const RIDGE_WEIGHT: f64 = 1e-6;
/// The least share of the surface that has to see mostly walls.
const LEAST_CLEAR_SHARE: f64 = 0.3;
/// The number of places that stand for the surface in this test.
pub(crate) const SOME: usize = 64;
/// The largest share of the variation of direct light on walls that polynomials may leave out. Where they leave out
/// more, as with pools of many luminaires, they remove no noise.
pub(crate) const LEFT_OUT: f64 = 0.3;
/// The largest share of the noise that walls may leave to be worth their cost.
pub(crate) const WORTH: f64 = 0.7;
/// The number of rays that test whether something stands before the walls.
const TEST_RAYS: usize = 16;
/// The number of these rays that have to reach the walls.
const FEWEST_CLEAR_RAYS: usize = 12;
/// The Gauss rule for places along a side of a wall.
static RULE: LazyLock<GaussRule> = LazyLock::new(|| GaussRule::new(PLACES_A_SIDE));
/// The directions of the test rays.
static DIRECTIONS: LazyLock<ShortRays<TEST_RAYS>> = LazyLock::new(|| ShortRays::of(Key::new(0)));
/// The distance from the middle of a wall, in half sides, beyond which the wall is left out. The closed form loses
/// its digits there.
const MOST_HALF_SIDES: f64 = 24.0;

/// A stand, and the light that the surface around it reflects.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LitStand {
    pub(crate) stand: Stand,
    /// The area of the surface that it stands for, m2.
    pub(crate) area_m2: f64,
    /// The reflected light, lx, photometric.
    pub(crate) reflected_lx: f64,
}

/// The walls of a scene and their light.
#[derive(Debug, Serialize, Deserialize)]
pub(crate) struct ControlVariate {
    walls: Vec<Wall>,
}

#[derive(Debug, Serialize, Deserialize)]
struct Wall {
    rectangle: Rectangle,
    /// The light that it reflects, lx, photometric.
    light: Polynomial,
    /// The colour of that light.
    tint: Rgb,
    /// The light that it reflects at the evaluated places, lx, photometric; `None` where it is not known.
    lit: Vec<Option<f64>>,
}

/// Integrals over walls: of light, of its square, and of the squared residual.
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

    /// The root mean square of the residual, as a share of that of the variation of light; 1 if light does not vary.
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
    /// The walls of a scene with large plane surfaces, still dark, if enough of these places see them. Each place
    /// comes with the surface that it stands for, m2.
    pub(crate) fn seen_by(
        scene: &Scene,
        places: impl Iterator<Item = (Stand, f64)>,
    ) -> Option<Self> {
        let places: Vec<_> = places.collect();
        Self::of(scene).filter(|walls| walls.share_of_clear(scene, &places) >= LEAST_CLEAR_SHARE)
    }

    /// The walls of a scene with large plane surfaces, still dark, whether places see them or not.
    pub(crate) fn of(scene: &Scene) -> Option<Self> {
        let dark = |rectangle: Rectangle| {
            let light = Polynomial([0.0; COEFFICIENTS]);
            Wall { rectangle, light, tint: Rgb::BLACK, lit: Vec::new() }
        };
        let largest = planes::largest(scene).into_iter();
        let faced = largest.filter(|rectangle| rectangle.faces_something(scene));
        let walls: Vec<Wall> = faced.take(MOST_WALLS).map(dark).collect();
        (!walls.is_empty()).then_some(Self { walls })
    }

    /// Fits the light of the walls; `light_at` is the illuminance of a place, if known. Returns the share of the
    /// variation of light that the fit leaves out, root mean square.
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

    /// The share of the variation between some places that the fit leaves out, root mean square. Places off the walls
    /// do not count.
    pub(crate) fn leaves_out(&self, places: impl Iterator<Item = LitStand>) -> f64 {
        let mut all = Moments::default();
        for LitStand { stand, area_m2, reflected_lx } in places {
            if let Some(told) = self.walls.iter().find_map(|wall| wall.tells(&stand)) {
                all.add(area_m2, reflected_lx, reflected_lx - told);
            }
        }
        all.left_out()
    }

    /// The share of the surface that the places stand for which sees mostly walls.
    fn share_of_clear(&self, scene: &Scene, places: &[(Stand, f64)]) -> f64 {
        let is_clear = |(of, _): &(Stand, f64)| Self::is_clear(scene, of, &self.seen_from(of));
        let clear: Vec<bool> = places.par_iter().map(is_clear).collect();
        let all_m2: f64 = places.iter().map(|(_, m2)| m2).sum();
        let of_clear = places.iter().zip(clear).filter(|(_, is_clear)| *is_clear);
        let clear_m2: f64 = of_clear.map(|((_, m2), _)| m2).sum();
        if all_m2 > 0.0 { clear_m2 / all_m2 } else { 0.0 }
    }

    /// The illuminance of a place from the walls without obstacles, lx; `None` where obstacles hide too much.
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

    /// Whether enough rays, and as large a share of the light, reach the walls, and whether polynomials tell the
    /// light there. A bright part that is hidden, or that only the polynomial has, would add more noise than all
    /// others remove. The bound on noisy light then adds light.
    fn is_clear(scene: &Scene, of: &Stand, seen: &[Seen<'_>]) -> bool {
        let ray = |k: usize| DIRECTIONS.ray(k, *of);
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
            let is_at =
                |other_m: f64| (other_m - far_m).abs() <= BESIDE_WALL_SHARE * (far_m + size_m);
            // A wall behind another one is not seen.
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
        are_told
            && count >= FEWEST_CLEAR_RAYS
            && light * TEST_RAYS as f64 >= all_light * FEWEST_CLEAR_RAYS as f64
    }
}

/// The negative sum of the walls' light that the rays find, lx, to be added to their estimate.
pub(crate) fn lacking(walls: &[Seen<'_>], directions: &[Direction]) -> Rgb {
    let found = walls.iter().flat_map(|wall| directions.iter().filter_map(|&d| wall.light(d)));
    found.fold(Rgb::BLACK, |lacking, light| lacking - light)
}

impl Wall {
    /// Fits the polynomial to the light of the wall's places.
    fn see(
        &mut self,
        scene: &Scene,
        light_at: &(impl Fn(&SurfacePoint) -> Option<Rgb> + Sync),
    ) -> Moments {
        let rule = &*RULE;
        self.lit.clear();
        let mut sums = Sums::default();
        let mut colour = Rgb::BLACK;
        let mut places = Vec::with_capacity(PLACES_A_SIDE * PLACES_A_SIDE);
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

    /// The fitted light at a place on the wall; `None` for a place elsewhere.
    fn tells(&self, of: &Stand) -> Option<f64> {
        let Rectangle { middle, axes, half_m } = &self.rectangle;
        let to = of.origin - *middle;
        let before_m = BESIDE_WALL_SHARE * half_m[0].min(half_m[1]);
        let is_on = to.dot(axes[2]).abs() < before_m
            && of.normal.to_vector().dot(axes[2]) > 1.0 - BESIDE_WALL_SHARE;
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
        let is_near = |m: f64, half_m: f64| m.abs() < MOST_HALF_SIDES * half_m;
        let least_m = half_m[0].min(half_m[1]);
        let is_before = view.height_m > 0.0
            && is_near(view.height_m, least_m)
            && (0..2).all(|k| is_near(view.foot_m[k], half_m[k]));
        is_before.then_some(Self { wall, view })
    }

    /// Half of the shorter side of the wall, m.
    fn size_m(&self) -> f64 {
        let [a, b] = self.wall.rectangle.half_m;
        a.min(b)
    }

    fn illuminance(&self) -> Rgb {
        let Wall { light, rectangle, tint, .. } = self.wall;
        *tint * light.illuminance(rectangle.half_m, &self.view)
    }

    /// The distance at which a ray meets the wall, m, and the place.
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

    /// The least known light of the four evaluated places around the end of a ray, and the fitted light there. The
    /// others may be hidden by objects on the wall.
    fn lit_and_told(&self, direction: Direction) -> Option<[f64; 2]> {
        let (_, place) = self.at(direction)?;
        let [x, y] = place.map(|c| {
            let after = RULE.nodes.partition_point(|node| *node < c);
            [after.saturating_sub(1), after.min(PLACES_A_SIDE - 1)]
        });
        let about = x.into_iter().flat_map(|x| y.map(|y| [x, y]));
        let known = about
            .filter_map(|[x, y]| Some(((*self.wall.lit.get(PLACES_A_SIDE * x + y)?)?, [x, y])));
        let (lit, least) = known.min_by(|a, b| a.0.total_cmp(&b.0))?;
        Some([lit, self.wall.light.at(least.map(|k| RULE.nodes[k]))])
    }

    fn light(&self, direction: Direction) -> Option<Rgb> {
        let (_, place) = self.at(direction)?;
        Some(self.wall.tint * self.wall.light.at(place))
    }
}

/// The normal equations of the fit.
struct Sums {
    products: [[f64; COEFFICIENTS]; COEFFICIENTS],
    values: [f64; COEFFICIENTS],
}

impl Default for Sums {
    fn default() -> Self {
        Self { products: [[0.0; COEFFICIENTS]; COEFFICIENTS], values: [0.0; COEFFICIENTS] }
    }
}

impl Sums {
    fn add(&mut self, powers: &[f64; COEFFICIENTS], value: f64, weight: f64) {
        for (i, row) in self.products.iter_mut().enumerate() {
            for (k, product) in row.iter_mut().enumerate().take(i + 1) {
                *product += weight * powers[i] * powers[k];
            }
            self.values[i] += weight * powers[i] * value;
        }
    }

    /// The coefficients by Cholesky's method; `None` without any place.
    fn solved(mut self) -> Option<[f64; COEFFICIENTS]> {
        let held = RIDGE_WEIGHT * self.products[0][0];
        let rows = &mut self.products;
        for i in 0..COEFFICIENTS {
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
        for i in 0..COEFFICIENTS {
            let known: f64 = (0..i).map(|j| rows[i][j] * values[j]).sum();
            values[i] = (values[i] - known) / rows[i][i];
        }
        for i in (0..COEFFICIENTS).rev() {
            let known: f64 = (i + 1..COEFFICIENTS).map(|j| rows[j][i] * values[j]).sum();
            values[i] = (values[i] - known) / rows[i][i];
        }
        Some(values)
    }
}
