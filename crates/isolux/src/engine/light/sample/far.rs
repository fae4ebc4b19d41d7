//! Light from infinitely far away that has an extent: skies, and the disc of the sun.

use super::super::far_sky::{FarSky, on_disc};
use super::super::lighting::Lighting;
use super::super::sources::{LuminaireId, Source, SourceKind, Target, facing_cos};
use super::measured::mean;
use crate::engine::ray::{Dice, Sensor, SurfacePoint};
use crate::units::Rgb;
use isolux_geometry::Direction;

/// A source that is a sky or an image of one.
#[derive(Clone, Copy)]
pub(crate) struct SkySource<'a> {
    source: &'a Source,
    sky: &'a FarSky,
}

/// A source that is a disc, or an image of one.
#[derive(Clone, Copy)]
pub(crate) struct Disc<'a> {
    source: &'a Source,
    middle: Direction,
    half_angle_rad: f64,
    illuminance_lx: f64,
}

impl<'a> SkySource<'a> {
    /// The source as a sky; `None` if it is none.
    pub(crate) fn of(source: &'a Source) -> Option<Self> {
        match &source.kind {
            SourceKind::Sky(sky) => Some(Self { source, sky }),
            _ => None,
        }
    }
}

impl<'a> Disc<'a> {
    /// The source as a disc; `None` if it is none.
    pub(crate) fn of(source: &'a Source) -> Option<Self> {
        match source.kind {
            SourceKind::Directional { towards, illuminance_lx, half_angle_rad }
                if half_angle_rad > 0.0 =>
            {
                Some(Self { source, middle: towards, half_angle_rad, illuminance_lx })
            }
            _ => None,
        }
    }

    /// The mean cosine of its places at a surface that faces the middle, which sees the border at an angle.
    fn facing(&self) -> f64 {
        0.5 * (1.0 + libm::cos(self.half_angle_rad))
    }

    /// Its light where nothing is before it, as if all came from its middle, lx.
    pub(crate) fn unhidden_lx(&self, at: &SurfacePoint) -> f64 {
        let cos = self.middle.cos(at.shading).max(0.0);
        self.source.colour.luminance() * self.illuminance_lx * cos
    }
}

impl Lighting<'_> {
    /// Calls `found` for the rays to a sky, and to its images, that are free: with the direction in the frame of the sky, and the
    /// illuminance for every cd/m2 there, lx.
    pub(crate) fn sky_rays(
        &self,
        number: u32,
        at: &SurfacePoint,
        samples: usize,
        dice: &mut Dice,
        mut found: impl FnMut(Direction, Rgb),
    ) {
        for SkySource { source, sky } in self.images_of_sky(number) {
            let Some(view) = self.openings.view(source, at) else { continue };
            view.rays(samples, dice, None, |towards, weight| {
                let target = Target::Infinity(towards);
                let share = self.visibility(&source.chain, at, target, None);
                if let Some(local) = sky.local(towards).filter(|_| !share.is_black()) {
                    found(local, share * weight);
                }
            });
        }
    }

    /// The share of parallel light from a direction of the frame of a sky that arrives, straight and by mirrors.
    pub(crate) fn share_of_sky(&self, number: u32, at: &SurfacePoint, local: Direction) -> Rgb {
        let one = |SkySource { source, sky }: SkySource<'_>| {
            let towards = sky.world(local.to_vector())?;
            let cos = facing_cos(towards, at.shading, at.geometric)?;
            Some(self.visibility(&source.chain, at, Target::Infinity(towards), None) * cos)
        };
        self.images_of_sky(number).filter_map(one).sum()
    }

    /// A sky and its images.
    fn images_of_sky(&self, number: u32) -> impl Iterator<Item = SkySource<'_>> {
        let id = LuminaireId::Luminaire(number);
        self.sources.iter().filter(move |s| s.luminaire == id).filter_map(SkySource::of)
    }

    /// Illuminance from a sky, by `samples` shadow rays: through openings, over the hemisphere, and to bright parts.
    pub(crate) fn lit_by_sky(
        &self,
        SkySource { source, sky }: SkySource<'_>,
        at: &SurfacePoint,
        samples: usize,
        dice: &mut Dice,
    ) -> Rgb {
        let Some(view) = self.openings.view(source, at) else { return Rgb::BLACK };
        let seen = |towards: Direction| {
            let luminance_cd_m2 = sky.luminance_cd_m2(towards);
            if luminance_cd_m2.is_black() {
                return Rgb::BLACK;
            }
            luminance_cd_m2 * self.visibility(&source.chain, at, Target::Infinity(towards), None)
        };
        source.colour * view.steradians(samples, dice, Some(sky), seen)
    }

    /// Illuminance from a disc, by `samples` shadow rays to places of it.
    pub(crate) fn lit_by_disc(
        &self,
        disc: Disc<'_>,
        at: &SurfacePoint,
        samples: usize,
        dice: &mut Dice,
    ) -> Rgb {
        let one = |dice: &mut Dice| {
            let towards = on_disc(disc.middle, disc.half_angle_rad, dice.pair());
            let Some(cos) = facing_cos(towards, at.shading, at.geometric) else {
                return Rgb::BLACK;
            };
            self.visibility(&disc.source.chain, at, Target::Infinity(towards), None) * cos
        };
        disc.source.colour * mean(samples, dice, one) * (disc.illuminance_lx / disc.facing())
    }

    /// Mean illuminance of a sensor from a disc, by `samples` shadow rays to places of it.
    pub(super) fn disc_all_round(
        &self,
        disc: Disc<'_>,
        (at, sensor): (&SurfacePoint, &Sensor),
        samples: usize,
        dice: &mut Dice,
    ) -> Rgb {
        let one = |dice: &mut Dice| {
            let towards = on_disc(disc.middle, disc.half_angle_rad, dice.pair());
            let at = at.facing(towards.to_normal());
            let share = self.visibility(&disc.source.chain, &at, Target::Infinity(towards), None);
            share * sensor.share(towards)
        };
        disc.source.colour * mean(samples, dice, one) * (disc.illuminance_lx / disc.facing())
    }
}
