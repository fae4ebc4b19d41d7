//! Openings in front of large emitting surfaces and of skies: windows, skylights, doors to a lit room.
//!
//! Where little of an emitter is visible, most shadow rays to points all over it end at a wall. They go to
//! the openings instead. Openings are rectangles in the planes of the surfaces that block the emitter
//! (`opening_search/planes`), found by trial rays beforehand (`opening_search`). The trial rays also tell
//! which openings bring light to which parts of the scene (`zones`). A quarter of all rays is spread over
//! the hemisphere, for light that enters elsewhere. A direction counts only for the kind of rays that
//! samples it more densely (the maximum heuristic of Veach and Guibas 1995), so no light is lost, wherever
//! the openings are. With the balance heuristic, the few rays over the hemisphere that meet an opening would
//! bring part of its light. Mostly none meets it; then readings are too dark and their replicates agree.
//!
//! A sky with bright parts gets rays in proportion to its luminance as well, a quarter of all.

mod zones;

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests stop at the first surprise")]
mod tests;

use super::far_sky::{BRIGHT_SHARE, FarSky};
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

/// Openings in front of one emitter, and the parts of the scene that each of them lights.
pub(crate) struct Before {
    pub(crate) openings: Vec<Opening>,
    pub(crate) zones: Zones,
    /// Whether the emitter fills the hemisphere of every place, apart from obstacles.
    surrounds: bool,
    pub(crate) beyond: Beyond,
}

/// An emitter that openings are in front of.
pub(crate) enum Beyond {
    /// Emitting triangles, in ascending order, and the side that emits.
    Surface {
        triangles: Vec<u32>,
        back: bool,
    },
    Sky(FarSky),
}

/// Openings in front of all emitting surfaces of a scene, by number, and of its skies, by the number of the luminaire.
#[derive(Default)]
pub(crate) struct Openings {
    surfaces: Vec<Option<Before>>,
    skies: Vec<(u32, Before)>,
}

/// How a ray was drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Drawn {
    /// Through the opening with this index.
    Through(usize),
    /// Over the hemisphere.
    Anywhere,
    /// In proportion to the luminance of the sky.
    Bright,
}

/// Numbers of rays of each kind.
#[derive(Clone, Copy)]
struct Counts {
    through: f64,
    anywhere: f64,
    bright: f64,
}

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
    pub(crate) const fn new(surfaces: Vec<Option<Before>>, skies: Vec<(u32, Before)>) -> Self {
        Self { surfaces, skies }
    }

    /// Whether there are openings in front of any emitting surface.
    pub(crate) fn exist(&self) -> bool {
        self.surfaces.iter().any(Option::is_some)
    }

    /// Whether there are openings in front of an emitting surface.
    pub(crate) fn are_before(&self, number: usize) -> bool {
        self.surfaces.get(number).is_some_and(Option::is_some)
    }

    /// The view of the openings in front of an emitting surface, without its images, or of those in front of a sky, without
    /// any for its images. `None` where rays are better spread over all of the surface.
    pub(crate) fn view(&self, source: &Source, at: &SurfacePoint) -> Option<View<'_>> {
        let before = match source.luminaire {
            LuminaireId::Area(number) => self.surfaces.get(number as usize)?.as_ref()?,
            LuminaireId::Luminaire(number) => &self.skies.iter().find(|(sky, _)| *sky == number)?.1,
        };
        match (source.chain.is_empty(), &before.beyond) {
            (true, _) => View::new(before, before.zones.through(at), at),
            (false, Beyond::Sky(_)) => View::new(before, &[], at),
            (false, Beyond::Surface { .. }) => None,
        }
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

    /// Shares of the rays of each kind. `bright` is the sky, if it has bright parts.
    fn shares(&self, bright: Option<&FarSky>) -> Counts {
        let bright = if bright.is_some() { BRIGHT_SHARE } else { 0.0 };
        let anywhere = if self.whole > 0.0 { ANYWHERE_SHARE } else { 1.0 - bright };
        Counts { through: 1.0 - anywhere - bright, anywhere, bright }
    }

    /// Mean projected solid angle of the visible part of the emitter, sr, by `samples` rays. `seen`
    /// gives the share of its light that arrives along a ray. `sky` is the emitter if it is one: then `seen` may give its
    /// luminance, and bright parts get rays of their own.
    pub(crate) fn steradians(
        &self,
        samples: usize,
        dice: &mut Dice,
        sky: Option<&FarSky>,
        seen: impl Fn(Direction) -> Rgb,
    ) -> Rgb {
        let mut sum = Rgb::BLACK;
        self.rays(samples, dice, sky, |direction, weight| sum += seen(direction) * weight);
        sum
    }

    /// Calls `found` for rays drawn as [`View::steradians`] does, each with the projected solid angle that it stands for, sr.
    pub(crate) fn rays(
        &self,
        samples: usize,
        dice: &mut Dice,
        sky: Option<&FarSky>,
        mut found: impl FnMut(Direction, f64),
    ) {
        let sky = sky.filter(|sky| sky.has_bright_parts());
        let shares = self.shares(sky);
        let mut tell = |drawn: Option<(Direction, Drawn)>, counts: Counts| {
            let Some((direction, drawn)) = drawn else { return };
            if let Some(density) = self.density(direction, drawn, counts, sky) {
                found(direction, 1.0 / density);
            }
        };
        if samples == 1 {
            let [pick, accept] = dice.pair();
            let beyond = pick - shares.anywhere - shares.bright;
            let found = if pick < shares.anywhere {
                self.anywhere(dice)
            } else if beyond < 0.0 {
                self.bright(sky, (pick - shares.anywhere) / shares.bright, dice)
            } else {
                self.through_one([beyond / shares.through, accept], dice)
            };
            return tell(found, shares);
        }
        let anywhere = (samples as f64 * shares.anywhere).ceil();
        let bright = (samples as f64 * shares.bright).floor();
        let counts = Counts { through: samples as f64 - anywhere - bright, anywhere, bright };
        let sequence = dice.fork();
        let one = |k: usize| {
            let mut dice = Dice::new(sequence, k as u32);
            let k = k as f64;
            let found = if k < counts.through {
                let pair = dice.pair();
                self.through_one(pair, &mut dice)
            } else if k < counts.through + counts.bright {
                let [pick, _] = dice.pair();
                self.bright(sky, pick, &mut dice)
            } else {
                self.anywhere(&mut dice)
            };
            tell(found, counts);
        };
        (0..samples).for_each(one);
    }

    /// Projected solid angle that the next ray would bring if it met light that none of `samples` rays has met, sr.
    pub(crate) fn unseen(&self, samples: f64) -> f64 {
        PI / (self.shares(None).anywhere * samples)
    }

    /// Number of rays for every projected solid angle in a direction, 1/sr, for the kind of rays
    /// that samples it more densely. `None` for a ray of another kind, which does not count.
    fn density(
        &self,
        direction: Direction,
        drawn: Drawn,
        counts: Counts,
        sky: Option<&FarSky>,
    ) -> Option<f64> {
        let anywhere = counts.anywhere / PI;
        let through = self.density_through(direction, drawn, counts);
        let bright = sky.map_or(0.0, |sky| {
            counts.bright * sky.density(direction) / direction.cos(self.at.shading)
        });
        let is_densest = match drawn {
            Drawn::Through(_) => through >= anywhere && through >= bright,
            Drawn::Anywhere => anywhere > through && anywhere >= bright,
            Drawn::Bright => bright > through && bright > anywhere,
        };
        is_densest.then_some(through.max(anywhere).max(bright))
    }

    /// The same of the rays through openings.
    fn density_through(&self, direction: Direction, drawn: Drawn, counts: Counts) -> f64 {
        if self.whole <= 0.0 {
            return 0.0;
        }
        let is_passed = |k: usize, through: &Through| {
            let opening = &self.before.openings[through.opening as usize];
            drawn == Drawn::Through(k) || opening.is_passed(self.at.point, direction.to_vector())
        };
        let passed = self.through.iter().enumerate().filter(|(k, through)| is_passed(*k, through));
        let weights: f64 = passed.map(|(_, through)| through.weight).sum();
        counts.through * weights / self.whole
    }

    /// A direction of the hemisphere, in proportion to its cosine.
    fn anywhere(&self, dice: &mut Dice) -> Option<(Direction, Drawn)> {
        let local = CosineHemisphere::sample(dice.pair());
        self.facing(self.at.shading.to_direction().from_local(local), Drawn::Anywhere)
    }

    /// A direction in proportion to the luminance of the sky.
    fn bright(
        &self,
        sky: Option<&FarSky>,
        pick: f64,
        dice: &mut Dice,
    ) -> Option<(Direction, Drawn)> {
        self.facing(sky?.draw(pick, dice.pair())?, Drawn::Bright)
    }

    /// The direction, if it is above the horizon of the place.
    fn facing(&self, direction: Direction, drawn: Drawn) -> Option<(Direction, Drawn)> {
        let cos = facing_cos(direction, self.at.shading, self.at.geometric);
        cos.map(|_| (direction, drawn))
    }

    /// A direction through an opening, in proportion to its cosine and the weight of the opening,
    /// and the opening's index.
    pub(crate) fn through_one(
        &self,
        [pick, accept]: [f64; 2],
        dice: &mut Dice,
    ) -> Option<(Direction, Drawn)> {
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
        self.facing(direction, Drawn::Through(number))
    }
}

impl Before {
    /// An emitting surface without any openings yet.
    pub(crate) fn surface(mut triangles: Vec<u32>, back: bool, surrounds: bool) -> Self {
        triangles.sort_unstable();
        Self::new(Beyond::Surface { triangles, back }, surrounds)
    }

    /// A sky without any openings yet.
    pub(crate) fn sky(sky: FarSky) -> Self {
        Self::new(Beyond::Sky(sky), true)
    }

    fn new(beyond: Beyond, surrounds: bool) -> Self {
        Self { openings: Vec::new(), zones: Zones::none(), surrounds, beyond }
    }

    /// Whether a side of a triangle is part of the emitter.
    pub(crate) fn emits(&self, triangle: u32, back: bool) -> bool {
        match &self.beyond {
            Beyond::Surface { triangles, back: emitting } => {
                back == *emitting && triangles.binary_search(&triangle).is_ok()
            }
            Beyond::Sky(_) => false,
        }
    }
}
