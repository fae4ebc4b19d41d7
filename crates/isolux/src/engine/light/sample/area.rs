//! Light from emitting surfaces.

use super::super::lighting::Lighting;
use super::super::polygon::{Piece, Place, drawn, pieces, target};
use super::super::sources::{
    Emitter, MOST_TRIANGLES_A_SAMPLE, Source, SourceKind, Target, facing_cos,
};
use super::clusters::Parted;
use super::measured::mean;
use crate::engine::ray::{Dice, SurfacePoint};
use crate::units::Rgb;
use isolux_geometry::{Direction, Point, Vector};
use std::borrow::Cow;

/// Samples of a large emitter for a rough value of its unoccluded light.
const ROUGH_SAMPLES: usize = 16;

/// An emitting surface as a receiver sees it without obstacles, for drawing directions to it.
pub(crate) struct Shape<'a> {
    at: SurfacePoint,
    triangles: &'a [[Point; 3]],
    seen: Seen<'a>,
    /// Projected solid angle of the visible part, sr; an estimate if the surface is partitioned.
    whole: f64,
}

/// A source that is an emitting surface or an image of one.
#[derive(Clone, Copy)]
pub(crate) struct AreaSource<'a> {
    source: &'a Source,
    emitter: &'a Emitter,
    triangles: &'a [[Point; 3]],
}

impl<'a> AreaSource<'a> {
    /// The source as an emitting surface; `None` if it is not one.
    pub(crate) fn of(source: &'a Source) -> Option<Self> {
        match &source.kind {
            SourceKind::Area { emitter, triangles } => Some(Self { source, emitter, triangles }),
            _ => None,
        }
    }

    /// The number of its triangles.
    pub(crate) const fn count(self) -> usize {
        self.triangles.len()
    }

    /// Unoccluded illuminance, lx; a rough value if the surface is partitioned.
    pub(super) fn unhidden_lx(self, at: &SurfacePoint, dice: &mut Dice) -> f64 {
        let Some(shape) = Shape::new(at, self.emitter(), 1) else { return 0.0 };
        let one = |dice: &mut Dice| Rgb::grey(shape.place(dice).map_or(0.0, |place| place.share));
        let samples = if let Seen::Pieces(_) = shape.seen { 1 } else { ROUGH_SAMPLES };
        self.source.colour.luminance() * mean(samples, dice, one).luminance() * shape.whole
    }

    /// The surface as a whole, and its triangles.
    pub(crate) const fn emitter(self) -> (&'a Emitter, &'a [[Point; 3]]) {
        (self.emitter, self.triangles)
    }
}

enum Seen<'a> {
    Pieces(Vec<Piece>),
    Parted(Parted<'a>),
}

impl<'a> Shape<'a> {
    /// The shape for `samples` samples; `None` where nothing of the surface is above the horizon.
    pub(crate) fn new(
        at: &SurfacePoint,
        (emitter, triangles): (&'a Emitter, &'a [[Point; 3]]),
        samples: usize,
    ) -> Option<Self> {
        let (seen, whole) = if triangles.len() > MOST_TRIANGLES_A_SAMPLE * samples {
            let parted = Parted::new(at, &emitter.clusters, triangles, samples);
            let whole = parted.whole;
            (Seen::Parted(parted), whole)
        } else {
            let pieces = pieces(at, triangles.iter().copied().enumerate());
            let whole = pieces.iter().map(|p| p.steradians).sum();
            (Seen::Pieces(pieces), whole)
        };
        (whole > 0.0).then_some(Self { at: *at, triangles, seen, whole })
    }

    /// Projected solid angle of the visible part, sr; an estimate if the surface is partitioned.
    pub(crate) const fn whole(&self) -> f64 {
        self.whole
    }

    /// A place on one of its triangles; `None` where the receiver's own surface hides it.
    pub(crate) fn place(&self, dice: &mut Dice) -> Option<Place> {
        let [pick, accept] = dice.pair();
        let (piece, share) = match &self.seen {
            Seen::Pieces(pieces) => (Cow::Borrowed(drawn(pieces, pick * self.whole)?), 1.0),
            Seen::Parted(parted) => parted.drawn(pick)?,
        };
        let triangle = piece.triangle;
        let point = target(&piece, self.triangles[triangle], &self.at, accept, dice);
        Place::seen(&self.at, triangle, point, share)
    }

    /// A direction to a place on it, and the density of that direction, 1/sr.
    pub(crate) fn draw(&self, dice: &mut Dice) -> Option<(Direction, f64)> {
        let place = self.place(dice)?;
        let direction = (place.point - self.at.point).direction()?;
        let cos = facing_cos(direction, self.at.shading, self.at.geometric)?;
        Some((direction, cos / (place.share * self.whole)))
    }

    /// Density of directions to a place on one of its triangles, 1/sr.
    pub(crate) fn density(&self, triangle: usize, to_place: Vector) -> Option<f64> {
        let cos = facing_cos(to_place.direction()?, self.at.shading, self.at.geometric)?;
        let share = match &self.seen {
            Seen::Pieces(_) => 1.0,
            Seen::Parted(parted) => parted.share(triangle)?,
        };
        Some(cos / (share * self.whole))
    }
}

impl Lighting<'_> {
    /// The shape of an emitting surface itself, without its images, as a place sees it.
    pub(crate) fn shape(&self, number: usize, at: &SurfacePoint) -> Option<Shape<'_>> {
        let source = &self.sources[self.starts[self.scene.luminaires().len() + number]];
        match &source.kind {
            SourceKind::Area { emitter, triangles } => Shape::new(at, (emitter, triangles), 1),
            _ => None,
        }
    }

    /// Illuminance from one emitting surface, by `samples` shadow rays.
    ///
    /// Directions are drawn in proportion to the cosine at the receiver. The share of free ones,
    /// times the exact unoccluded illuminance, is an unbiased estimate, and has no variance where
    /// nothing or everything is hidden. Many triangles are drawn in approximately that proportion,
    /// and each sample counts with the inverse of its probability.
    pub(crate) fn lit_by_area(
        &self,
        surface: AreaSource<'_>,
        at: &SurfacePoint,
        samples: usize,
        dice: &mut Dice,
    ) -> Rgb {
        let AreaSource { source, emitter, triangles } = surface;
        if let Some(view) = self.openings.view(source, at) {
            let seen = |direction| self.seen_along(&view, direction);
            return source.colour * view.steradians(samples, dice, None, seen);
        }
        let seen = |place: &Place| {
            let index = emitter.indices[place.triangle];
            self.visibility(&source.chain, at, Target::Point(place.point), Some(index))
        };
        if samples == 1 && emitter.facets.are_some() {
            let look = emitter.facets.look(at, triangles, dice);
            return look.map_or(Rgb::BLACK, |(place, steradians)| {
                source.colour * seen(&place) * steradians
            });
        }
        let Some(shape) = Shape::new(at, (emitter, triangles), samples) else {
            return Rgb::BLACK;
        };
        let one = |dice: &mut Dice| {
            shape.place(dice).map_or(Rgb::BLACK, |place| seen(&place) * place.share)
        };
        source.colour * mean(samples, dice, one) * shape.whole
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::engine::light::{sources::facets::Facets, sources::triangle_tree::Clusters};
    use crate::sampling::{Key, Sequence};
    use isolux_geometry::Normal;
    use std::f64::consts::TAU;

    /// Draws of every emitter for every receiver.
    const DRAWS: u32 = 4000;

    /// Allowed deviation of a mean of [`DRAWS`], in standard errors. Chance exceeds it once in ten
    /// million, and a hundred means are compared.
    const DEVIATIONS: f64 = 5.5;

    /// Expected number of draws of a part that is missing from all draws in one case of three thousand.
    const SELDOM_DRAWS: f64 = 8.0;

    fn emitter(triangles: &[[Point; 3]]) -> Emitter {
        Emitter {
            indices: (0..triangles.len() as u32).collect(),
            area_m2: 1.0,
            centre: Point::ORIGIN,
            facets: Facets::of(triangles),
            clusters: Clusters::of(triangles),
        }
    }

    /// A surface over the unit square, with two triangles in each of its cells.
    fn sheet(cells: [usize; 2], place: impl Fn(f64, f64) -> Vector) -> Vec<[Point; 3]> {
        let [rows, columns] = cells;
        let corner = |i: usize, k: usize| {
            Point::ORIGIN + place(i as f64 / rows as f64, k as f64 / columns as f64)
        };
        let all = (0..rows).flat_map(|i| (0..columns).map(move |k| (i, k)));
        all.flat_map(|(i, k)| {
            let (a, b) = (corner(i, k), corner(i + 1, k));
            let (c, d) = (corner(i + 1, k + 1), corner(i, k + 1));
            [[a, b, c], [a, c, d]]
        })
        .collect()
    }

    /// A ring that faces down, a ball, a long thin tube, a floor, random triangles, equal
    /// triangles, and triangles of zero area.
    fn shapes() -> Vec<(&'static str, Vec<[Point; 3]>)> {
        let turn = |radius_m: f64, turn: f64| {
            Vector::new(radius_m * libm::cos(TAU * turn), radius_m * libm::sin(TAU * turn), 0.0)
        };
        let up = |height_m: f64| Vector::new(0.0, 0.0, height_m);
        let ring = sheet([48, 1], |u, v| turn(2.0 + 0.1 * v, u) + up(1.0));
        let ball = sheet([12, 24], |u, v| {
            turn(0.5 * libm::sin(TAU * u / 2.0), v) + up(0.7 - 0.5 * libm::cos(TAU * u / 2.0))
        });
        let tube = sheet([64, 3], |u, v| {
            let around = turn(0.01, u);
            Vector::new(3.0 * v - 1.0, around.x, 0.4 + around.y)
        });
        let floor = sheet([10, 10], |u, v| Vector::new(u - 0.3, v - 0.3, 0.0));
        let any = |k: u64| {
            let key = Key::new(7).with(k);
            let c = |n: u64| 2.0 * key.with(n).uniform() - 1.0;
            let first = Point::new(c(0), c(1), c(2));
            let [b, r] = [Vector::new(c(3), c(4), c(5)), Vector::new(c(6), c(7), c(8))];
            [first, first + b * 0.3, first + r * 0.3]
        };
        let soup = (0..500).map(any).collect();
        let same = vec![any(1); 100];
        let none = vec![[Point::ORIGIN; 3]; 100];
        let mixed = (0..200).map(|k| if k % 3 == 0 { any(k) } else { [any(k)[0]; 3] }).collect();
        let away = Vector::new(1e5, -1e5, 1e5);
        let far = ring.iter().map(|t| t.map(|p| p + away)).collect();
        vec![
            ("ring", ring),
            ("ball", ball),
            ("tube", tube),
            ("floor", floor),
            ("soup", soup),
            ("same", same),
            ("none", none),
            ("mixed", mixed),
            ("far", far),
        ]
    }

    /// Receivers below, beside, on, in and above the shapes.
    fn receivers() -> impl Iterator<Item = SurfacePoint> {
        let place = |k: u64| {
            let c = |n: u64| 2.0 * Key::new(9).with(k).with(n).uniform() - 1.0;
            let point = match k {
                0 => Point::new(0.0, 0.0, 0.0),
                1 => Point::new(2.05, 0.0, 0.0),
                2 => Point::new(2.05, 0.0, 0.99),
                3 => Point::new(0.0, 0.5, 0.7),
                4 => Point::new(0.1, 0.1, 1e-3),
                5 => Point::new(1e5, -1e5, 1e5),
                _ => Point::new(2.5 * c(0), 2.5 * c(1), 1.5 * c(2)),
            };
            let normal = if k < 5 { up() } else { Vector::new(c(3), c(4), c(5)) };
            SurfacePoint::in_space(point, normal.normal().unwrap(), 0.0)
        };
        (0..16).map(place)
    }

    fn up() -> Vector {
        Normal::Z.to_vector()
    }

    fn check(found: &[f64], expected: f64, what: &str) {
        let count = found.len() as f64;
        let mean = found.iter().sum::<f64>() / count;
        let square = found.iter().map(|f| (f - mean) * (f - mean)).sum::<f64>();
        let error = (square / (count * (count - 1.0))).sqrt();
        // A part that is drawn more seldom may be missing, or wrong by half. Thin triangles lose
        // half the digits of the arcs.
        let tolerance = DEVIATIONS * error + 0.5 * SELDOM_DRAWS / count * expected + 1e-7;
        assert!((mean - expected).abs() <= tolerance, "{what}: {mean} +- {error}, not {expected}");
    }

    /// A part that is drawn too seldom shows in the density, not in the mean: every part that gives
    /// light has a density. The relative spread of the values drawn is 0.6 (November 2026).
    #[test]
    fn many_triangles_are_drawn_without_bias_and_with_their_density() {
        let (mut compared, mut spread) = (0, 0.0);
        for (name, triangles) in shapes() {
            let emitter = emitter(&triangles);
            for (k, at) in receivers().enumerate() {
                let what = format!("{name} from {k}");
                let all = pieces(&at, triangles.iter().copied().enumerate());
                let exact: f64 = all.iter().map(|p| p.steradians).sum();
                let Some(shape) = Shape::new(&at, (&emitter, &triangles), 1) else {
                    assert!(exact == 0.0, "{what}: {exact} is not seen");
                    continue;
                };
                let Seen::Parted(parted) = &shape.seen else { panic!("{what} is not parted") };
                let mut sum = 0.0;
                for piece in &all {
                    let share = parted.share(piece.triangle);
                    let share =
                        share.unwrap_or_else(|| panic!("{what}: {} unseen", piece.triangle));
                    sum += piece.steradians / (share * shape.whole);
                }
                let (mut seen, mut found) = (Vec::new(), Vec::new());
                for n in 0..DRAWS {
                    let dice = || Dice::new(Sequence::new(Key::new(3).with(k as u64)), n);
                    let place = shape.place(&mut dice());
                    seen.push(f64::from(u8::from(place.is_some())));
                    found.push(place.as_ref().map_or(0.0, |p| p.share * shape.whole));
                    let Some(place) = place else { continue };
                    let to_place = place.point - at.point;
                    let density = shape.density(place.triangle, to_place);
                    let drawn = shape.draw(&mut dice()).map(|(_, density)| density);
                    assert_eq!(density, drawn, "{what}");
                }
                check(&found, exact, &what);
                check(&seen, sum, &format!("density of {what}"));
                let square = found.iter().map(|f| (f / exact - 1.0).powi(2)).sum::<f64>();
                if exact > 0.0 {
                    (compared, spread) = (compared + 1, spread + square / f64::from(DRAWS));
                }
            }
        }
        let spread = (spread / f64::from(compared)).sqrt();
        assert!(compared > 50 && spread < 1.0, "{compared}: {spread}");
    }

    /// A single sample is unbiased for far triangles, weighted by their centroids, and for near ones, weighted exactly.
    #[test]
    fn one_look_has_no_bias() {
        let mut compared = 0;
        for (name, triangles) in shapes() {
            let facets = Facets::of(&triangles);
            for (k, at) in receivers().enumerate().filter(|_| facets.are_some()) {
                let all = pieces(&at, triangles.iter().copied().enumerate());
                let exact: f64 = all.iter().map(|p| p.steradians).sum();
                let look = |n: u32| {
                    let mut dice = Dice::new(Sequence::new(Key::new(5).with(k as u64)), n);
                    facets
                        .look(&at, &triangles, &mut dice)
                        .map_or(0.0, |(_, steradians)| steradians)
                };
                let found: Vec<f64> = (0..DRAWS).map(look).collect();
                check(&found, exact, &format!("{name} from {k}"));
                compared += u32::from(exact > 0.0);
            }
        }
        assert!(compared > 10, "{compared}");
    }
}
