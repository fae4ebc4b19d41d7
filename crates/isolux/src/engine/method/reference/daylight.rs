//! Daylight coefficients: what each part of the sky gives to a place (Tregenza and Waters 1983, "Daylight coefficients").
//!
//! Paths from a place tell the illuminance for every cd/m2 of a patch of the sky; a year of skies is then a sum for each hour. The
//! sun is apart: its direct light is traced to its own place in the sky, and its reflected light is that of the patch
//! about it, as in the five-phase method (McNeil 2013). Independent replicates tell the error of whatever follows.

use super::PathTracer;
use crate::engine::ray::{Dice, ProbePoint, place_key};
use crate::engine::read::ExactSettings;
use crate::photometry::SkyPatches;
use crate::sampling::Sequence;
use crate::scene::{LuminaireKind, Scene};
use isolux_geometry::Direction;
use rayon::prelude::*;

/// A scene with a sky, prepared for daylight coefficients.
pub struct Daylight<'a> {
    tracer: PathTracer<'a>,
    /// The number of the luminaire that is the sky.
    sky: u32,
}

/// The daylight coefficients of a place by one replicate: illuminance for every cd/m2 of each patch, and at the end of the ground
/// below the horizon, lx. They are photometric.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Coefficients {
    /// Of light that comes straight, through panes and by planar mirrors.
    pub direct: Vec<f64>,
    /// Of all other light.
    pub indirect: Vec<f64>,
}

impl<'a> Daylight<'a> {
    /// Prepares a scene; `None` where there is no sky. What luminance its sky has makes no difference.
    pub fn new(scene: &'a Scene) -> Option<Self> {
        let mut luminaires = (0..).zip(scene.luminaires());
        let is_sky = |kind: &LuminaireKind| matches!(kind, LuminaireKind::Sky { .. });
        let (sky, _) = luminaires.find(|(_, luminaire)| is_sky(&luminaire.kind))?;
        Some(Self { tracer: PathTracer::new(scene), sky })
    }

    /// The coefficients of a place, one set a replicate.
    pub fn coefficients(
        &self,
        at: ProbePoint,
        patches: &SkyPatches,
        settings: &ExactSettings,
    ) -> Vec<Coefficients> {
        let start = self.tracer.start(at);
        let key = place_key(at.position).with(settings.seed);
        let one = |replicate: u32| {
            let key = key.with(u64::from(replicate));
            let number_of = |towards: Direction| patches.of(towards).unwrap_or(patches.count());
            let nothing = || vec![0.0; patches.count() + 1];
            let mut found = Coefficients { direct: nothing(), indirect: nothing() };
            let rays = settings.rays.max(1);
            let dice = &mut Dice::new(Sequence::new(key.with(u64::MAX)), 0);
            let lighting = &self.tracer.lighting;
            lighting.sky_rays(self.sky, &start.surface, rays as usize, dice, |towards, lx| {
                found.direct[number_of(towards)] += lx.luminance();
            });
            let sequence = Sequence::new(key);
            let local = |towards: Direction| self.local(towards);
            for index in 0..rays {
                let dice = &mut Dice::new(sequence, index);
                self.tracer.path_to_sky((self.sky, &local), start, dice, &mut |towards, lx| {
                    found.indirect[number_of(towards)] += lx.luminance() / f64::from(rays);
                });
            }
            found
        };
        (0..settings.replicates.max(2)).into_par_iter().map(one).collect()
    }

    /// The share of the direct light of a sun that arrives at a place: its illuminance over that of a surface that faces the sun.
    /// `towards` is in the frame of the sky.
    pub fn share_of_sun(&self, at: ProbePoint, towards: Direction) -> f64 {
        let start = self.tracer.start(at);
        self.tracer.lighting.share_of_sky(self.sky, &start.surface, towards).luminance()
    }

    fn local(&self, towards: Direction) -> Option<Direction> {
        let LuminaireKind::Sky { world_from_sky, .. } =
            &self.tracer.scene.luminaires()[self.sky as usize].kind
        else {
            return None;
        };
        world_from_sky.inverse()?.vector(towards.to_vector()).direction()
    }
}
