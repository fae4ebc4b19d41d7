//! Light from emitting surfaces.

use super::Lighting;
use super::measured::{Measured, REPLICATES};
use super::parted::Parted;
use super::pieces::{Piece, drawn, pieces, target};
use super::source::{Emitter, Source, SourceKind, Target, facing_cos};
use crate::engine::accumulate::mean_and_variance;
use crate::engine::path::Dice;
use crate::engine::surface::SurfacePoint;
use crate::sampling::Sequence;
use crate::units::Rgb;
use isolux_geometry::{Direction, Point, Vector};
use std::borrow::Cow;

/// Emitters of at most so many triangles a sample are sampled by solid angle, with the exact
/// unoccluded illuminance as control; of larger ones only those triangles that are near.
const TRIANGLES_A_SAMPLE: usize = 32;

/// So many times the shadow rays where those before tell too little.
const MORE: usize = 4;

/// Places of a large emitter that tell roughly what it gives.
const LOOKED_AT: usize = 16;

/// What a place sees of an emitting surface, obstacles left out, as directions are drawn to it: one by one.
pub(in crate::engine) struct Shape<'a> {
    at: SurfacePoint,
    triangles: &'a [[Point; 3]],
    seen: Seen<'a>,
    /// Projected solid angle of what is seen, sr; where it is parted, an estimate.
    whole: f64,
}

enum Seen<'a> {
    Pieces(Vec<Piece>),
    Parted(Parted<'a>),
}

/// A place of an emitter that was drawn.
struct Place {
    triangle: usize,
    point: Point,
    /// The projected solid angle that it stands for, over the whole.
    share: f64,
}

impl<'a> Shape<'a> {
    /// For so many looks at it; `None` where nothing of it is above the horizon.
    fn new(
        at: &SurfacePoint,
        (emitter, triangles): (&'a Emitter, &'a [[Point; 3]]),
        samples: usize,
    ) -> Option<Self> {
        let (seen, whole) = if triangles.len() > TRIANGLES_A_SAMPLE * samples {
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

    /// A place on one of its triangles; `None` where that is not seen.
    fn place(&self, dice: &mut Dice) -> Option<Place> {
        let [pick, accept] = dice.pair();
        let (piece, share) = match &self.seen {
            Seen::Pieces(pieces) => (Cow::Borrowed(drawn(pieces, pick * self.whole)?), 1.0),
            Seen::Parted(parted) => parted.drawn(pick)?,
        };
        let triangle = piece.triangle;
        let point = target(&piece, self.triangles[triangle], &self.at, accept, dice);
        let is_seen = (point - self.at.point).dot(self.at.geometric.to_vector()) > 0.0;
        is_seen.then_some(Place { triangle, point, share })
    }

    /// A direction to some place of it, and its density, 1/sr.
    pub(in crate::engine) fn draw(&self, dice: &mut Dice) -> Option<(Direction, f64)> {
        let place = self.place(dice)?;
        let direction = (place.point - self.at.point).direction()?;
        let cos = facing_cos(direction, self.at.shading, self.at.geometric)?;
        Some((direction, cos / (place.share * self.whole)))
    }

    /// The density of directions to a place on one of its triangles, 1/sr.
    pub(in crate::engine) fn density(&self, triangle: usize, to_place: Vector) -> Option<f64> {
        let cos = facing_cos(to_place.direction()?, self.at.shading, self.at.geometric)?;
        let share = match &self.seen {
            Seen::Pieces(_) => 1.0,
            Seen::Parted(parted) => parted.share(triangle)?,
        };
        Some(cos / (share * self.whole))
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
            sum.variance += measured.variance;
        }
        sum
    }

    /// Illuminance from one emitting surface, by `samples` shadow rays.
    ///
    /// Directions are drawn in proportion to the cosine at the receiver, so the share of them that is
    /// free, times the exact illuminance without obstacles, is an unbiased estimate, and one without
    /// variance where nothing or everything is hidden. Where there are many triangles they are drawn in
    /// about that proportion, and every one counts as the inverse of its chance.
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
            let Some(place) = shape.place(dice) else { return Rgb::BLACK };
            let index = emitter.indices[place.triangle];
            let target = Target::Point(place.point);
            self.visibility(&source.chain, at, target, Some(index)) * place.share
        };
        source.colour * mean(samples, dice, one) * shape.whole
    }
}

/// What an emitting surface gives a place that nothing hides it from, lx; roughly where it is parted.
fn unhidden_lx(
    source: &Source,
    of: (&Emitter, &[[Point; 3]]),
    at: &SurfacePoint,
    dice: &mut Dice,
) -> f64 {
    let Some(shape) = Shape::new(at, of, 1) else { return 0.0 };
    let one = |dice: &mut Dice| Rgb::grey(shape.place(dice).map_or(0.0, |place| place.share));
    let samples = if let Seen::Pieces(_) = shape.seen { 1 } else { LOOKED_AT };
    source.colour.luminance() * mean(samples, dice, one).luminance() * shape.whole
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
