//! Light from emitting surfaces.

use super::Lighting;
use super::measured::{Measured, REPLICATES};
use super::source::{Emitter, Source, SourceKind, Target, facing_cos};
use crate::engine::accumulate::mean_and_variance;
use crate::engine::path::Dice;
use crate::engine::surface::SurfacePoint;
use crate::sampling::{Sequence, SphericalTriangle};
use crate::units::Rgb;
use isolux_geometry::{Direction, Point, Vector};
use std::cell::OnceCell;

/// Emitters of at most so many triangles a sample are sampled by solid angle, with the exact
/// unoccluded illuminance as control; larger ones by area, which costs less and spreads more.
const TRIANGLES_A_SAMPLE: usize = 32;

/// So many times the shadow rays where those before tell too little.
const MORE: usize = 4;

/// The standard error by the spread of eight replicates, so that 1.96 of it hold the truth in 95 % of cases (quantiles of Student's
/// distribution with seven degrees of freedom and of the normal one).
const OF_FEW: f64 = 2.365 / 1.96;

/// Places of a large emitter that tell roughly what it gives.
const LOOKED_AT: usize = 64;

/// Directions drawn before one is taken as it is. Over a triangle above the horizon the mean cosine is
/// above a quarter of the highest, so this happens once in a hundred million.
const TRIES: usize = 64;

/// A triangle of an emitter, as far as it is above the horizon of a receiver.
struct Piece {
    /// From the receiver, m.
    corners: [Vector; 3],
    /// Which of the emitter's triangles it belongs to.
    triangle: usize,
    /// Projected solid angle: the integral of the cosine at the receiver, sr.
    steradians: f64,
    /// Its directions and the highest cosine over them, once they are wanted; none where it is too
    /// small or too near its plane to be told apart by direction.
    directions: OnceCell<Option<(SphericalTriangle, f64)>>,
}

impl Piece {
    fn directions(&self, at: &SurfacePoint) -> Option<(SphericalTriangle, f64)> {
        *self.directions.get_or_init(|| {
            let spherical = SphericalTriangle::new(at.point, self.corners.map(|c| at.point + c))?;
            let highest = highest_cos(spherical.corners(), at.shading.to_vector());
            Some((spherical, highest))
        })
    }
}

/// What a place sees of an emitting surface, obstacles left out, as directions are drawn to it: one by one.
pub(in crate::engine) struct Shape<'a> {
    at: SurfacePoint,
    triangles: &'a [[Point; 3]],
    emitter: &'a Emitter,
    /// None where places of it are drawn by area.
    pieces: Option<Vec<Piece>>,
    /// Projected solid angle of the pieces, sr; one where there are none.
    whole: f64,
}

impl<'a> Shape<'a> {
    /// For so many looks at it; `None` where nothing of it is above the horizon.
    fn new(
        at: &SurfacePoint,
        (emitter, triangles): (&'a Emitter, &'a [[Point; 3]]),
        samples: usize,
    ) -> Option<Self> {
        let by_area = Self { at: *at, triangles, emitter, pieces: None, whole: 1.0 };
        if triangles.len() > TRIANGLES_A_SAMPLE * samples {
            return Some(by_area);
        }
        let pieces = pieces(at, triangles);
        let whole = pieces.iter().map(|p| p.steradians).sum();
        (whole > 0.0).then_some(Self { pieces: Some(pieces), whole, ..by_area })
    }

    /// One of its triangles and a place on it.
    fn place(&self, dice: &mut Dice) -> Option<(usize, Point)> {
        let [pick, accept] = dice.pair();
        let Some(pieces) = &self.pieces else {
            return Some(place_by_area(self.emitter, self.triangles, pick, dice.pair()));
        };
        let piece = drawn(pieces, pick * self.whole)?;
        let corners = self.triangles[piece.triangle];
        Some((piece.triangle, target(piece, corners, &self.at, accept, dice)))
    }

    /// The projected solid angle that a place stands for, over that of the pieces; `None` where it is not seen.
    fn share(&self, index: usize, to_place: Vector) -> Option<f64> {
        if self.pieces.is_some() {
            return (to_place.dot(self.at.geometric.to_vector()) > 0.0).then_some(1.0);
        }
        let direction = to_place.direction()?;
        let [p, q, r] = self.triangles[index];
        let cos_there = -direction.cos((q - p).cross(r - p).normal()?);
        let cos = facing_cos(direction, self.at.shading, self.at.geometric)?;
        let total_m2 = *self.emitter.area_sums_m2.last()?;
        (cos_there > 0.0).then(|| cos * cos_there * total_m2 / to_place.length_squared())
    }

    /// A direction to some place of it, and its density, 1/sr.
    pub(in crate::engine) fn draw(&self, dice: &mut Dice) -> Option<(Direction, f64)> {
        let (index, place) = self.place(dice)?;
        let to_place = place - self.at.point;
        Some((to_place.direction()?, self.density(index, to_place)?))
    }

    /// The density of directions to a place on one of its triangles, 1/sr.
    pub(in crate::engine) fn density(&self, index: usize, to_place: Vector) -> Option<f64> {
        let cos = facing_cos(to_place.direction()?, self.at.shading, self.at.geometric)?;
        Some(cos / (self.share(index, to_place)? * self.whole))
    }
}

impl Lighting<'_> {
    /// How directions are drawn to an emitting surface, itself and no image of it, that a place sees.
    pub(in crate::engine) fn shape(&self, number: usize, at: &SurfacePoint) -> Option<Shape<'_>> {
        let source = &self.sources[self.starts[self.scene.luminaires().len() + number]];
        match &source.kind {
            SourceKind::Area { emitter, triangles } => Shape::new(at, (emitter, triangles), 1),
            _ => None,
        }
    }

    /// Illuminance from emitting surfaces with the variance of its mean: where that is more than asked for, by more shadow rays.
    /// What none of them have seen may still be there: it counts as if the next one did.
    pub(in crate::engine) fn of_surfaces(
        &self,
        at: &SurfacePoint,
        goal_lx: f64,
        [fewest, most]: [usize; 2],
        sequence: Sequence,
    ) -> Measured {
        let goal = goal_lx * goal_lx / self.area_sources.max(1) as f64;
        let mut sum = Measured { lx: Rgb::BLACK, variance: 0.0 };
        for (k, source) in self.sources.iter().enumerate() {
            let SourceKind::Area { emitter, triangles } = &source.kind else { continue };
            let mut samples = fewest;
            let measured = loop {
                let of_each = [const { Rgb::BLACK }; REPLICATES as usize];
                let mut replicate = 0;
                let of_each = of_each.map(|_| {
                    let mut dice = Dice::new(sequence.fork(k as u32, samples as u32), replicate);
                    replicate += 1;
                    self.lit_by_area(source, emitter, triangles, at, samples, &mut dice)
                });
                let (lx, mut variance) = mean_and_variance(&of_each);
                if lx.is_black() {
                    let whole_lx =
                        unhidden_lx(source, (emitter, triangles), at, &mut Dice::new(sequence, 0));
                    let unseen_lx = whole_lx / (samples as f64 * f64::from(REPLICATES));
                    variance = unseen_lx * unseen_lx;
                }
                if variance <= goal || samples >= most {
                    break Measured { lx, variance };
                }
                samples = (MORE * samples).min(most);
            };
            sum.lx += measured.lx;
            sum.variance += OF_FEW * OF_FEW * measured.variance;
        }
        sum
    }

    /// Illuminance from one emitting surface, by `samples` shadow rays.
    ///
    /// Directions are drawn in proportion to the cosine at the receiver, so the share of them that is
    /// free, times the exact illuminance without obstacles, is an unbiased estimate, and one without
    /// variance where nothing or everything is hidden.
    pub(super) fn lit_by_area(
        &self,
        source: &Source,
        emitter: &Emitter,
        triangles: &[[Point; 3]],
        at: &SurfacePoint,
        samples: usize,
        dice: &mut Dice,
    ) -> Rgb {
        let Some(shape) = Shape::new(at, (emitter, triangles), samples) else {
            return Rgb::BLACK;
        };
        let one = |dice: &mut Dice| {
            let Some((index, place)) = shape.place(dice) else { return Rgb::BLACK };
            let Some(share) = shape.share(index, place - at.point) else { return Rgb::BLACK };
            let index = emitter.indices[index];
            self.visibility(&source.chain, at, Target::Point(place), Some(index)) * share
        };
        source.colour * mean(samples, dice, one) * shape.whole
    }
}

/// What an emitting surface gives a place that nothing hides it from, lx; roughly where places of it are drawn by area.
fn unhidden_lx(
    source: &Source,
    of: (&Emitter, &[[Point; 3]]),
    at: &SurfacePoint,
    dice: &mut Dice,
) -> f64 {
    let Some(shape) = Shape::new(at, of, 1) else { return 0.0 };
    let one = |dice: &mut Dice| {
        let drawn = shape.place(dice);
        let share = drawn.and_then(|(index, place)| shape.share(index, place - at.point));
        Rgb::grey(share.unwrap_or(0.0))
    };
    let samples = if shape.pieces.is_some() { 1 } else { LOOKED_AT };
    source.colour.luminance() * mean(samples, dice, one).luminance() * shape.whole
}

/// A triangle of an emitter and a place on it, evenly over its area.
fn place_by_area(
    emitter: &Emitter,
    triangles: &[[Point; 3]],
    pick: f64,
    [a, b]: [f64; 2],
) -> (usize, Point) {
    let total_m2 = emitter.area_sums_m2.last().copied().unwrap_or(0.0);
    let k = emitter.area_sums_m2.partition_point(|&sum| sum <= pick * total_m2);
    let k = k.min(triangles.len() - 1);
    let [p, q, r] = triangles[k];
    let root = a.sqrt();
    (k, p + (q - p) * (root * (1.0 - b)) + (r - p) * (root * b))
}

/// Mean of samples that are spread evenly.
fn mean(samples: usize, dice: &mut Dice, mut one: impl FnMut(&mut Dice) -> Rgb) -> Rgb {
    if samples == 1 {
        return one(dice);
    }
    let sequence = dice.fork();
    let sum: Rgb = (0..samples).map(|k| one(&mut Dice::new(sequence, k as u32))).sum();
    sum / samples as f64
}

/// The piece at a running sum of projected solid angles.
fn drawn(pieces: &[Piece], mut sum: f64) -> Option<&Piece> {
    let found = pieces.iter().find(|piece| {
        sum -= piece.steradians;
        sum < 0.0
    });
    // Rounding may leave a sliver past the last.
    found.or(pieces.last())
}

/// A point of a piece, with a density by direction in proportion to the cosine at the receiver: drawn
/// uniformly by solid angle, and taken with a chance of its cosine over the highest.
fn target(
    piece: &Piece,
    corners: [Point; 3],
    at: &SurfacePoint,
    mut accept: f64,
    dice: &mut Dice,
) -> Point {
    let middle = || at.point + (piece.corners[0] + piece.corners[1] + piece.corners[2]) / 3.0;
    let Some((spherical, highest)) = piece.directions(at) else { return middle() };
    let mut direction = None;
    for _ in 0..TRIES {
        direction = spherical.sample(dice.pair());
        if direction.is_none_or(|d| accept * highest < d.cos(at.shading)) {
            break;
        }
        [accept, _] = dice.pair();
    }
    direction.and_then(|d| on_plane(at.point, d.to_vector(), corners)).unwrap_or_else(middle)
}

/// The highest cosine with `up` over a spherical triangle above the horizon.
fn highest_cos(corners: [Vector; 3], up: Vector) -> f64 {
    let heights = corners.map(|c| c.dot(up));
    let mut highest = heights.into_iter().fold(0.0, f64::max);
    let mut sides = [0.0; 3];
    for k in 0..3 {
        let next = (k + 1) % 3;
        let across = corners[k].cross(corners[next]);
        sides[k] = across.dot(up);
        let cos = corners[k].dot(corners[next]);
        // An arc that rises from both its ends has its highest point between them.
        if heights[next] > cos * heights[k] && heights[k] > cos * heights[next] {
            let sine2 = sides[k] * sides[k] / across.length_squared();
            highest = highest.max((1.0 - sine2).max(0.0).sqrt());
        }
    }
    let has_zenith = sides.iter().all(|&s| s > 0.0) || sides.iter().all(|&s| s < 0.0);
    if has_zenith { 1.0 } else { highest }
}

/// Where a ray meets the plane of a triangle.
fn on_plane(from: Point, direction: Vector, [a, b, c]: [Point; 3]) -> Option<Point> {
    let normal = (b - a).cross(c - a);
    let t = (a - from).dot(normal) / direction.dot(normal);
    (t > 0.0 && t.is_finite()).then(|| from + direction * t)
}

/// What a receiver sees of triangles that emit from their counter-clockwise side.
fn pieces(at: &SurfacePoint, triangles: &[[Point; 3]]) -> Vec<Piece> {
    let normal = at.shading.to_vector();
    let mut pieces = Vec::with_capacity(triangles.len() + 1);
    for (triangle, &[a, b, c]) in triangles.iter().enumerate() {
        if (b - a).cross(c - a).dot(at.point - a) <= 0.0 {
            continue;
        }
        let (polygon, count) = above_horizon([a, b, c].map(|p| p - at.point), normal);
        for k in 2..count {
            let corners = [polygon[0], polygon[k - 1], polygon[k]];
            let steradians = projected_solid_angle(&corners, normal);
            if steradians > 0.0 {
                let directions = OnceCell::new();
                pieces.push(Piece { corners, triangle, steradians, directions });
            }
        }
    }
    pieces
}

/// Projected solid angle of a triangle above the horizon that turns clockwise as seen from the
/// receiver: Lambert's formula (Lambert 1760; in Arvo's notation, "The irradiance Jacobian for
/// partially occluded polyhedral sources", 1994).
fn projected_solid_angle(corners: &[Vector; 3], normal: Vector) -> f64 {
    let mut sum = 0.0;
    for k in 0..3 {
        let (from, to) = (corners[k], corners[(k + 1) % 3]);
        let edge = from.cross(to);
        let length = edge.length();
        if length > 0.0 {
            sum += libm::atan2(length, from.dot(to)) * edge.dot(normal) / length;
        }
    }
    -0.5 * sum
}

/// Sutherland and Hodgman's clip of a triangle at the horizon: corners and their number.
fn above_horizon(corners: [Vector; 3], normal: Vector) -> ([Vector; 4], usize) {
    let heights = corners.map(|c| c.dot(normal));
    let (mut kept, mut count) = ([Vector::ZERO; 4], 0);
    let mut keep = |v: Vector| {
        kept[count] = v;
        count += 1;
    };
    for k in 0..3 {
        let next = (k + 1) % 3;
        let (h0, h1) = (heights[k], heights[next]);
        if h0 >= 0.0 {
            keep(corners[k]);
        }
        if (h0 > 0.0 && h1 < 0.0) || (h0 < 0.0 && h1 > 0.0) {
            keep(corners[k] + (corners[next] - corners[k]) * (h0 / (h0 - h1)));
        }
    }
    (kept, count)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampling::{Key, Sequence};
    use isolux_geometry::Normal;

    /// Triangles in all places about a receiver, as pieces above its horizon.
    fn random_pieces(count: u64) -> Vec<Piece> {
        let floor = Point::new(0.0, 0.0, 0.0);
        let at = SurfacePoint::in_space(floor, Normal::Z);
        let triangle = |k: u64| {
            let key = Key::new(5).with(k);
            // Three shapes in turn: any, flat, thin.
            let flat = [1.0, 0.05, 1.0][(k % 3) as usize];
            let thin = [1.0, 1.0, 0.05][(k % 3) as usize];
            let c = |n: u64| 2.0 * key.with(n).uniform() - 1.0;
            let first = Point::new(c(0), c(1), flat * c(2));
            let second = Point::new(c(3), c(4), flat * c(5));
            [first, second, first + Vector::new(c(6), c(7), flat * c(8)) * thin]
        };
        let triangles: Vec<[Point; 3]> = (0..count).map(triangle).collect();
        pieces(&at, &triangles)
    }

    #[test]
    fn no_direction_is_higher_than_the_highest_and_a_quarter_is_taken() {
        let pieces = random_pieces(3000);
        assert!(pieces.len() > 1000, "{}", pieces.len());
        for (index, piece) in pieces.iter().enumerate() {
            let corners = piece.corners.map(|c| Point::ORIGIN + c);
            let Some(spherical) = SphericalTriangle::new(Point::ORIGIN, corners) else { continue };
            let highest = highest_cos(spherical.corners(), Vector::new(0.0, 0.0, 1.0));
            let taken = piece.steradians / (spherical.solid_angle_sr * highest);
            assert!(taken > 0.25 && taken <= 1.0 + 1e-9, "{corners:?}: {taken}");
            let sequence = Sequence::new(Key::new(6).with(index as u64));
            for k in 0..64 {
                let z = spherical.sample(sequence.pair(k, 0)).unwrap().to_vector().z;
                // Half the digits of the arcs are lost in thin triangles.
                assert!(z > -1e-7 && z <= highest + 1e-7, "{corners:?}: {z} above {highest}");
            }
        }
    }
}
