//! Direct light of sources evaluated one by one.

use super::super::lighting::Lighting;
use super::super::sources;
use super::super::sources::{Source, SourceKind, Target};
use super::area::AreaSource;
use super::far::{Disc, SkySource};
use super::luminous::LuminousSource;
use crate::engine::ray::{Dice, SurfacePoint};
use crate::units::Rgb;
use isolux_geometry::Direction;

impl Lighting<'_> {
    pub(crate) fn lit_by(
        &self,
        source: &Source,
        at: &SurfacePoint,
        samples: usize,
        dice: &mut Dice,
    ) -> Rgb {
        if let Some(surface) = AreaSource::of(source) {
            self.lit_by_area(surface, at, samples, dice)
        } else if let Some(luminous) = LuminousSource::of(source) {
            self.lit_by_luminous(luminous, at, samples, dice)
        } else if let Some(sky) = SkySource::of(source) {
            self.lit_by_sky(sky, at, samples, dice)
        } else if let Some(disc) = Disc::of(source) {
            self.lit_by_disc(disc, at, samples, dice)
        } else {
            self.lit_by_point(source, at)
        }
    }

    /// Illuminance from the sources among `some` that have no extent.
    pub(crate) fn lit_by_points<'a>(
        &self,
        some: impl Iterator<Item = &'a Source>,
        at: &SurfacePoint,
    ) -> Rgb {
        let points = some.filter(|source| !source.has_extent());
        points.map(|source| self.lit_by_point(source, at)).sum()
    }

    fn lit_by_point(&self, source: &Source, at: &SurfacePoint) -> Rgb {
        let in_view = |target| self.chain_is_in_view(&source.chain, at, target);
        let Some(arriving) = sources::unoccluded_if(self.scene, source, at, in_view) else {
            return Rgb::BLACK;
        };
        let share = self.visibility_in_view(&source.chain, at, arriving.target, None);
        arriving.illuminance_lx * share
    }

    /// [`Lighting::sampled`] with all sources evaluated one by one.
    pub(crate) fn by_all(&self, at: &SurfacePoint, samples: usize, dice: &mut Dice) -> Rgb {
        self.sources.iter().map(|s| self.lit_by(s, at, samples, dice)).sum()
    }

    /// Calls `found` for every point luminaire, every image of one, every sun, and one place of every image of a luminous area,
    /// whose light reaches a place. It receives the direction to the source, and the illuminance of a surface that
    /// faces it.
    pub(crate) fn points_at(
        &self,
        at: &SurfacePoint,
        dice: &mut Dice,
        mut found: impl FnMut(Direction, Rgb),
    ) {
        let is_told = |s: &&Source| match s.kind {
            SourceKind::Sky(_) | SourceKind::Area { .. } => false,
            SourceKind::Directional { .. } => true,
            SourceKind::Point { .. } => !s.has_extent() || !s.chain.is_empty(),
        };
        for source in self.sources.iter().filter(is_told) {
            let in_view = |target| self.chain_is_in_view(&source.chain, at, target);
            let arriving = match LuminousSource::of(source) {
                Some(luminous) => self.unhidden_from(luminous, luminous.place(dice), at),
                None => sources::unoccluded_if(self.scene, source, at, in_view),
            };
            let Some(arriving) = arriving else { continue };
            let towards = match arriving.target {
                Target::Point(place) => (place - at.point).direction(),
                Target::Infinity(direction) => Some(direction),
            };
            let Some(towards) = towards else { continue };
            let share = self.visibility_in_view(&source.chain, at, arriving.target, None);
            if !share.is_black() {
                found(towards, arriving.illuminance_lx * share / towards.cos(at.shading));
            }
        }
    }
}
