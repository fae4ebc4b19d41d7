//! Light of luminaires with a luminous area, by shadow rays to places of it.

use super::super::lighting::Lighting;
use super::super::sources::{Arriving, Luminous, Source, SourceKind, Target, unoccluded_from};
use super::area::mean;
use crate::engine::ray::{Dice, SurfacePoint};
use crate::units::Rgb;
use isolux_geometry::{Point, Transform, Vector};

/// Places along each side of an area for its light without obstacles: this many times its radius over its distance, so
/// that the midpoint rule, of second order in their spacing over the distance, errs by half a hundredth.
const PLACES_ALONG_A_RADIUS: f64 = 8.0;
/// The most places along a side, for areas at less than their radius.
const MOST_PLACES_ALONG_A_SIDE: f64 = 8.0;

/// A source that has a luminous area, or an image of one.
#[derive(Clone, Copy)]
pub(crate) struct LuminousSource<'a> {
    source: &'a Source,
    area: &'a Luminous,
    position: Point,
    local_from_world: &'a Transform,
}

impl<'a> LuminousSource<'a> {
    /// The source as a luminous area; `None` if it has none.
    pub(crate) fn of(source: &'a Source) -> Option<Self> {
        match &source.kind {
            SourceKind::Point { position, local_from_world, area: Some(area), .. } => {
                Some(Self { source, area, position: *position, local_from_world })
            }
            _ => None,
        }
    }

    /// A place of the area.
    pub(crate) fn place(&self, dice: &mut Dice) -> Point {
        let ([a, b], [c, _]) = (dice.pair(), dice.pair());
        self.at([a, b, c])
    }

    fn at(&self, numbers: [f64; 3]) -> Point {
        let [x, y, z] = self.local_from_world.columns;
        let local = self.area.area.place(numbers);
        self.position + Vector::new(local.dot(x), local.dot(y), local.dot(z))
    }
}

impl Lighting<'_> {
    /// Illuminance from a luminous area, by `samples` shadow rays to places spread evenly over it.
    pub(super) fn lit_by_luminous(
        &self,
        luminous: LuminousSource<'_>,
        at: &SurfacePoint,
        samples: usize,
        dice: &mut Dice,
    ) -> Rgb {
        mean(samples, dice, |dice| {
            let place = luminous.place(dice);
            self.unhidden_from(luminous, place, at).map_or(Rgb::BLACK, |arriving| {
                let chain = &luminous.source.chain;
                arriving.illuminance_lx * self.visibility_in_view(chain, at, arriving.target, None)
            })
        })
    }

    /// Illuminance from a place of a luminous area if all its light left from there, without obstacles.
    pub(super) fn unhidden_from(
        &self,
        luminous: LuminousSource<'_>,
        place: Point,
        at: &SurfacePoint,
    ) -> Option<Arriving> {
        let source = luminous.source;
        let in_view = |target: Target| self.chain_is_in_view(&source.chain, at, target);
        unoccluded_from(self.scene, source, place, at, in_view)
    }

    /// Illuminance from a luminous area without obstacles, from places that are the same everywhere, so that it
    /// has no noise.
    pub(super) fn unhidden(&self, luminous: LuminousSource<'_>, at: &SurfacePoint) -> Rgb {
        let nearness = luminous.area.radius_m / (luminous.position - at.point).length();
        let side =
            (PLACES_ALONG_A_RADIUS * nearness).ceil().clamp(2.0, MOST_PLACES_ALONG_A_SIDE) as u32;
        let share = |k: u32| (f64::from(k) + 0.5) / f64::from(side);
        let places = side * side;
        let lit = (0..places).map(|k| {
            let (i, j) = (k % side, k / side);
            // The third number runs through all levels once, in another order.
            let level = f64::from((k * 7 + 3) % places) + 0.5;
            let place = luminous.at([share(i), share(j), level / f64::from(places)]);
            self.unhidden_from(luminous, place, at).map_or(Rgb::BLACK, |a| a.illuminance_lx)
        });
        lit.sum::<Rgb>() / f64::from(places)
    }
}
