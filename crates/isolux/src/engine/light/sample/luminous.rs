//! Light of luminaires with a luminous area, by shadow rays to places of it.

use super::super::lighting::Lighting;
use super::super::sources::{Arriving, Luminous, Source, SourceKind, Target, unoccluded_from};
use super::measured::mean;
use crate::engine::ray::{Dice, SurfacePoint};
use crate::units::Rgb;
use isolux_geometry::{Direction, Point, Transform, Vector};

/// Places along each side of an area for its light without obstacles: this many times its radius over the distance of
/// its nearest place. The midpoint rule errs in proportion to the square of their spacing over that distance, a fourth.
const PLACES_ALONG_A_RADIUS: f64 = 8.0;
/// The most places along a side, for areas that are nearly touched.
const MOST_PLACES_ALONG_A_SIDE: f64 = 24.0;

/// The fraction of the golden ratio.
const GOLDEN_RATIO: f64 = 0.618_033_988_749_894_8;

/// What a look at a luminous area sees.
pub(crate) struct LuminousLook {
    pub(crate) direction: Direction,
    pub(crate) luminance_cd_m2: Rgb,
    /// The density of the directions of such looks, 1/sr.
    pub(crate) density: f64,
}

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
        let [a, b] = dice.pair();
        let c = if self.area.area.is_flat() { 0.0 } else { dice.pair()[0] };
        self.at([a, b, c])
    }

    /// The density of the directions to places drawn as [`LuminousSource::place`] draws them, 1/sr, as if they were even
    /// over the outline as seen from there: exact for flat areas.
    fn density(&self, from: Point) -> Option<f64> {
        let way = self.position - from;
        let local = self.local_from_world.vector(way).direction()?;
        Some(way.length_squared() / self.area.area.seen_m2(local))
    }

    /// The distance of a point from the box around the area, m.
    fn nearest_m(&self, from: Point) -> f64 {
        let local = self.local_from_world.vector(from - self.position);
        let area = &self.area.area;
        let outside =
            |k: usize| ((local.component(k) - area.middle_m[k]).abs() - area.half_m[k]).max(0.0);
        Vector::new(outside(0), outside(1), outside(2)).length()
    }

    fn at(&self, numbers: [f64; 3]) -> Point {
        let [x, y, z] = self.local_from_world.columns;
        let local = self.area.area.place(numbers);
        self.position + Vector::new(local.dot(x), local.dot(y), local.dot(z))
    }
}

impl Lighting<'_> {
    /// Illuminance from a luminous area, by at most `samples` shadow rays to places spread evenly over it. They are
    /// fewer where it is small for its distance: so narrow are its half-shadows then.
    pub(super) fn lit_by_luminous(
        &self,
        luminous: LuminousSource<'_>,
        at: &SurfacePoint,
        samples: usize,
        dice: &mut Dice,
    ) -> Rgb {
        let distance_m = (luminous.position - at.point).length();
        let extent = (2.0 * luminous.area.radius_m / distance_m).min(1.0);
        let samples = (samples as f64 * extent).ceil().max(1.0) as usize;
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

    /// The luminous areas themselves, without their images.
    pub(crate) fn luminous(&self) -> impl Iterator<Item = LuminousSource<'_>> {
        self.sources.iter().filter(|source| source.chain.is_empty()).filter_map(LuminousSource::of)
    }

    /// A look at a luminous area from a place; `None` where nothing is seen.
    pub(crate) fn look_at_area(
        &self,
        luminous: LuminousSource<'_>,
        at: &SurfacePoint,
        dice: &mut Dice,
    ) -> Option<LuminousLook> {
        let place = luminous.place(dice);
        let arriving = self.unhidden_from(luminous, place, at)?;
        let direction = (place - at.point).direction()?;
        let density = luminous.density(at.point)?;
        let share = self.visibility_in_view(&[], at, arriving.target, None);
        let facing_lx = arriving.illuminance_lx * share / direction.cos(at.shading);
        let luminance_cd_m2 = facing_lx * density;
        let is_seen = !share.is_black() && density.is_finite();
        is_seen.then_some(LuminousLook { direction, luminance_cd_m2, density })
    }

    /// Illuminance from a luminous area without obstacles, from places that are the same everywhere, so that it
    /// has no noise.
    pub(super) fn unhidden(&self, luminous: LuminousSource<'_>, at: &SurfacePoint) -> Rgb {
        let nearest_m = luminous.nearest_m(at.point);
        let side = (PLACES_ALONG_A_RADIUS * luminous.area.radius_m / nearest_m)
            .ceil()
            .clamp(2.0, MOST_PLACES_ALONG_A_SIDE) as u32;
        let share = |k: u32| (f64::from(k) + 0.5) / f64::from(side);
        let places = side * side;
        let lit = (0..places).map(|k| {
            let (i, j) = (k % side, k / side);
            // Multiples of the golden ratio spread evenly over the third number, however many they are.
            let level = (f64::from(k) * GOLDEN_RATIO + 0.5).fract();
            let place = luminous.at([share(i), share(j), level]);
            self.unhidden_from(luminous, place, at).map_or(Rgb::BLACK, |a| a.illuminance_lx)
        });
        lit.sum::<Rgb>() / f64::from(places)
    }
}
