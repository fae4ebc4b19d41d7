//! Openings in front of large emitting surfaces: windows below a luminous sky, doors to a lit room.
//!
//! Where little of an emitter is visible, most shadow rays to points all over it end at a wall. They go to
//! the openings instead. Openings are rectangles in the planes of the surfaces that block the emitter
//! (`opening_search/planes`), found by trial rays beforehand (`opening_search`). The trial rays also tell
//! which openings bring light to which parts of the scene (`zones`). A quarter of all rays is spread over
//! the hemisphere, for light that enters elsewhere. A direction counts only for the kind of rays that
//! samples it more densely (the maximum heuristic of Veach and Guibas 1995), so no light is lost, wherever
//! the openings are. With the balance heuristic, the few rays over the hemisphere that meet an opening would
//! bring part of its light. Mostly none meets it; then readings are too dark and their replicates agree.

mod zones;

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests stop at the first surprise")]
mod tests;

use super::polygon::{Piece, pieces, target};
use super::sources::{LuminaireId, Source, facing_cos};
use crate::engine::ray::{Dice, SurfacePoint};
use crate::sampling::CosineHemisphere;
use crate::units::Rgb;
use isolux_geometry::{Direction, Point, Vector};
use std::f64::consts::PI;
pub(crate) use zones::{Through, Told, Zones};

/// Share of the rays that are spread over the hemisphere, through openings or not.
pub(crate) const ANYWHERE_SHARE: f64 = 0.25;

/// A rectangle through which light enters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Opening {
    pub(crate) corner: Point,
    /// Vectors along its sides, at right angles; counter-clockwise as seen from the side that light goes to.
    pub(crate) sides: [Vector; 2],
    /// Unit vector towards the side that light comes from.
    pub(crate) outwards: Vector,
}

/// Openings in front of one emitting surface, and the parts of the scene that each of them lights.
pub(crate) struct Before {
    pub(crate) openings: Vec<Opening>,
    pub(crate) zones: Zones,
    /// Whether the emitter fills the hemisphere of every place, apart from obstacles.
    surrounds: bool,
    /// The emitting triangles, in ascending order; `back` tells their emitting side.
    triangles: Vec<u32>,
    back: bool,
}

/// Openings in front of all emitting surfaces of a scene, by number.
#[derive(Default)]
pub(crate) struct Openings(Vec<Option<Before>>);

/// The openings in front of an emitter as a receiver sees them.
pub(crate) struct View<'a> {
    pub(crate) before: &'a Before,
    through: &'a [Through],
    pub(crate) at: SurfacePoint,
    /// Halves of openings above the horizon, each with its index in `through`.
    pieces: Vec<Piece>,
    /// Sum of their projected solid angles times weights, sr.
    pub(crate) whole: f64,
}

impl Openings {
    pub(crate) const fn new(of_emitters: Vec<Option<Before>>) -> Self {
        Self(of_emitters)
    }

    /// Whether there are openings in front of any emitting surface.
    pub(crate) fn exist(&self) -> bool {
        self.0.iter().any(Option::is_some)
    }

    /// Whether there are openings in front of an emitting surface.
    pub(crate) fn are_before(&self, number: usize) -> bool {
        self.0.get(number).is_some_and(Option::is_some)
    }

    /// The view of the openings in front of an emitting surface, without its images. `None` where
    /// rays are better spread over all of the surface.
    pub(crate) fn view(&self, source: &Source, at: &SurfacePoint) -> Option<View<'_>> {
        let LuminaireId::Area(number) = source.luminaire else { return None };
        let before = self.0.get(number as usize)?.as_ref()?;
        if !source.chain.is_empty() {
            return None;
        }
        View::new(before, before.zones.through(at), at)
    }
}

impl Opening {
    /// Its two halves, which emit towards the side that light goes to.
    fn halves(&self) -> [[Point; 3]; 2] {
        let [a, b] = self.sides;
        let far = self.corner + a + b;
        [[self.corner, self.corner + a, far], [self.corner, far, self.corner + b]]
    }

    /// Whether a ray passes out through it.
    pub(crate) fn is_passed(&self, from: Point, direction: Vector) -> bool {
        let to_corner = self.corner - from;
        let (height_m, rise) = (to_corner.dot(self.outwards), direction.dot(self.outwards));
        if height_m <= 0.0 || rise <= 0.0 {
            return false;
        }
        let place = direction * (height_m / rise) - to_corner;
        self.sides.iter().all(|side| (0.0..=side.length_squared()).contains(&place.dot(*side)))
    }
}

impl<'a> View<'a> {
    pub(crate) fn new(
        before: &'a Before,
        through: &'a [Through],
        at: &SurfacePoint,
    ) -> Option<Self> {
        if through.is_empty() && !before.surrounds {
            return None;
        }
        let halves = through.iter().enumerate().flat_map(|(k, through)| {
            before.openings[through.opening as usize].halves().map(|half| (k, half))
        });
        let pieces = pieces(at, halves);
        let weighted = |piece: &Piece| piece.steradians * through[piece.triangle].weight;
        let whole = pieces.iter().map(weighted).sum();
        let is_wanted = whole > 0.0 || before.surrounds;
        is_wanted.then_some(Self { before, through, at: *at, pieces, whole })
    }

    /// Share of the rays that are spread over the hemisphere.
    fn anywhere_share(&self) -> f64 {
        if self.whole > 0.0 { ANYWHERE_SHARE } else { 1.0 }
    }

    /// Mean projected solid angle of the visible part of the emitter, sr, by `samples` rays. `seen`
    /// gives the share of its light that arrives along a ray.
    pub(crate) fn steradians(
        &self,
        samples: usize,
        dice: &mut Dice,
        seen: impl Fn(Direction) -> Rgb,
    ) -> Rgb {
        let share = self.anywhere_share();
        let brought = |found: Option<(Direction, Option<usize>)>, counts: [f64; 2]| {
            found
                .and_then(|(direction, through)| {
                    Some(seen(direction) / self.density(direction, through, counts)?)
                })
                .unwrap_or(Rgb::BLACK)
        };
        if samples == 1 {
            let [pick, accept] = dice.pair();
            let found = if pick < share {
                self.anywhere(dice)
            } else {
                self.through_one([(pick - share) / (1.0 - share), accept], dice)
            };
            return brought(found, [1.0 - share, share]);
        }
        let anywhere = (samples as f64 * share).ceil();
        let counts = [samples as f64 - anywhere, anywhere];
        let sequence = dice.fork();
        let one = |k: usize| {
            let mut dice = Dice::new(sequence, k as u32);
            let found = if (k as f64) < counts[0] {
                let pair = dice.pair();
                self.through_one(pair, &mut dice)
            } else {
                self.anywhere(&mut dice)
            };
            brought(found, counts)
        };
        (0..samples).map(one).sum()
    }

    /// Projected solid angle that the next ray would bring if it met light that none of `samples` rays has met, sr.
    pub(crate) fn unseen(&self, samples: f64) -> f64 {
        PI / (self.anywhere_share() * samples)
    }

    /// Number of rays for every projected solid angle in a direction, 1/sr, for the kind of rays
    /// that samples it more densely. `None` for a ray of the other kind, which does not count.
    fn density(&self, direction: Direction, drawn: Option<usize>, counts: [f64; 2]) -> Option<f64> {
        let anywhere = counts[1] / PI;
        if self.whole <= 0.0 {
            return Some(anywhere);
        }
        let is_passed = |k: usize, through: &Through| {
            let opening = &self.before.openings[through.opening as usize];
            drawn == Some(k) || opening.is_passed(self.at.point, direction.to_vector())
        };
        let passed = self.through.iter().enumerate().filter(|(k, through)| is_passed(*k, through));
        let weights: f64 = passed.map(|(_, through)| through.weight).sum();
        let by_openings = counts[0] * weights / self.whole;
        let are_openings = by_openings >= anywhere;
        let counted = if are_openings { by_openings } else { anywhere };
        (are_openings == drawn.is_some()).then_some(counted)
    }

    /// A direction of the hemisphere, in proportion to its cosine.
    fn anywhere(&self, dice: &mut Dice) -> Option<(Direction, Option<usize>)> {
        let local = CosineHemisphere::sample(dice.pair());
        let direction = self.at.shading.to_direction().from_local(local);
        facing_cos(direction, self.at.shading, self.at.geometric).map(|_| (direction, None))
    }

    /// A direction through an opening, in proportion to its cosine and the weight of the opening,
    /// and the opening's index.
    pub(crate) fn through_one(
        &self,
        [pick, accept]: [f64; 2],
        dice: &mut Dice,
    ) -> Option<(Direction, Option<usize>)> {
        let mut left = pick * self.whole;
        let piece = self.pieces.iter().find(|piece| {
            left -= piece.steradians * self.through[piece.triangle].weight;
            left < 0.0
        });
        // Rounding may leave a remainder past the last piece.
        let piece = piece.or(self.pieces.last())?;
        let number = piece.triangle;
        let opening = &self.before.openings[self.through[number].opening as usize];
        let point = target(piece, opening.halves()[0], &self.at, accept, dice);
        let direction = (point - self.at.point).direction()?;
        facing_cos(direction, self.at.shading, self.at.geometric).map(|_| (direction, Some(number)))
    }
}

impl Before {
    /// An emitting surface without any openings yet.
    pub(crate) fn new(mut triangles: Vec<u32>, back: bool, surrounds: bool) -> Self {
        triangles.sort_unstable();
        Self { openings: Vec::new(), zones: Zones::none(), surrounds, triangles, back }
    }

    /// Whether a side of a triangle is part of the emitter.
    pub(crate) fn emits(&self, triangle: u32, back: bool) -> bool {
        back == self.back && self.triangles.binary_search(&triangle).is_ok()
    }
}
