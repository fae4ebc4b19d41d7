//! A particle of light on its path through the scene.

use super::emission::{Emission, Emitted};
use super::lighting::Lighting;
use super::mirrors::met::MirrorChain;
use super::sources::LuminaireId;
use crate::engine::ray::{Dice, Scattered, SurfacePoint, specular_step};
use crate::sampling::{CosineHemisphere, Sequence};
use crate::scene::{Body, Finish, Material, Scene};
use crate::units::Rgb;
use isolux_geometry::{Direction, Ray};

/// Share of the light left after the last scattering of a path, even if all surfaces were the brightest one.
const NEGLIGIBLE_LIGHT_SHARE: f64 = 1e-6;
/// Lower bound of the number of scatterings of a path.
const FEWEST_SCATTERINGS: f64 = 128.0;
/// Upper bound of the number of scatterings of a path.
const MOST_SCATTERINGS: f64 = 4096.0;
/// Number of scatterings of a path if some surface absorbs nothing (an ideal mirror, a white wall). No number
/// suffices for light enclosed by such surfaces; among others this one does. The light given up is counted.
const SCATTERINGS_WITHOUT_LOSS: f64 = 64.0;

/// Light so strong that Russian roulette ends no path that carries it.
const SPARED: Rgb = Rgb::grey(f64::MAX);

/// Number of scatterings after which a particle is given up.
pub(crate) fn scatterings(scene: &Scene) -> u32 {
    let reflected = |finish: &Finish| {
        (finish.diffuse.colour + finish.mirror + finish.glossy_f0()).max_channel()
    };
    let sides = |m: &Material| [false, true].map(|back| m.finish(back).map_or(0.0, reflected));
    let largest = scene.materials().iter().flat_map(sides).fold(0.0, f64::max);
    if largest >= 1.0 {
        return SCATTERINGS_WITHOUT_LOSS as u32;
    }
    let enough = libm::log(NEGLIGIBLE_LIGHT_SHARE) / libm::log(largest);
    enough.clamp(FEWEST_SCATTERINGS, MOST_SCATTERINGS) as u32
}

/// A particle: flux that moves in one direction.
pub(crate) struct Particle {
    ray: Ray,
    direction: Direction,
    pub(crate) flux_lm: Rgb,
    luminaire: LuminaireId,
    chain: MirrorChain,
    dice: Dice,
    at: Option<SurfacePoint>,
    scatterings_left: u32,
    /// Whether it has been reflected diffusely.
    pub(crate) diffused: bool,
}

impl Particle {
    /// Particle `index` of `count` that share the flux of all luminaires. It is given up after
    /// `scatterings` scatterings.
    pub(crate) fn emit(
        emission: &Emission,
        sequence: Sequence,
        index: u32,
        count: u32,
        scatterings: u32,
    ) -> Option<Self> {
        let mut dice = Dice::new(sequence, index);
        let emitted = emission.emit(&mut dice)?;
        let flux_lm = emission.flux_lm() / f64::from(count);
        Some(Self::sent(&emitted, flux_lm, dice, scatterings))
    }

    /// The particle that `emitted` describes, with a flux in lm.
    pub(crate) fn sent(emitted: &Emitted, flux_lm: f64, dice: Dice, scatterings: u32) -> Self {
        Self {
            ray: emitted.ray,
            direction: emitted.direction,
            flux_lm: emitted.colour * flux_lm,
            luminaire: emitted.luminaire,
            chain: MirrorChain::default(),
            dice,
            at: None,
            scatterings_left: scatterings,
            diffused: false,
        }
    }

    /// Moves to the next surface; `None` when the particle leaves the scene.
    pub(crate) fn advance(&mut self, scene: &Scene) -> Option<SurfacePoint> {
        let hit = scene.bvh().closest_hit(&self.ray)?;
        let at = SurfacePoint::from_hit(scene, &hit);
        self.at = Some(at);
        Some(at)
    }

    /// Whether its light is part of direct light as evaluated at points.
    pub(crate) fn is_covered(&self, lighting: &Lighting) -> bool {
        !self.diffused && self.chain.is_covered(lighting, self.luminaire)
    }

    /// Goes on without diffuse reflection; `false` when the particle is absorbed.
    pub(crate) fn scatter_specular(&mut self, scene: &Scene, lighting: &Lighting) -> bool {
        // Russian roulette is relative to the present flux: a share of one always survives.
        let unit = self.flux_lm * (1.0 / self.flux_lm.max_channel().max(f64::MIN_POSITIVE));
        self.step_specular(scene, lighting, unit)
    }

    /// Goes on without diffuse reflection and without Russian roulette: the flux falls instead. `false` where nothing
    /// is reflected.
    pub(crate) fn follow_specular(&mut self, scene: &Scene, lighting: &Lighting) -> bool {
        self.step_specular(scene, lighting, SPARED)
    }

    fn step_specular(&mut self, scene: &Scene, lighting: &Lighting, carried: Rgb) -> bool {
        let Some(at) = self.at else { return false };
        let body = &scene.material(at.triangle).body;
        match specular_step(body, &at, self.direction, carried, &mut self.dice) {
            Some(next) => {
                self.chain.pass((&at, self.direction), body, lighting, &next);
                self.go(next);
                true
            }
            None => false,
        }
    }

    /// Goes on diffusely or specularly, by Russian roulette; `false` when the particle is absorbed.
    pub(crate) fn scatter(&mut self, scene: &Scene, lighting: &Lighting) -> bool {
        let Some(at) = self.at else { return false };
        let body = &scene.material(at.triangle).body;
        let Body::Opaque { front, back } = body else {
            return self.scatter_specular(scene, lighting);
        };
        let finish = if at.back { back } else { front };
        let reflectance = scene.diffuse_reflectance(finish, at.triangle, at.u, at.v);
        let chance = diffuse_chance(finish, reflectance, self.flux_lm);
        let [pick, _] = self.dice.pair();
        if pick < chance {
            let square = self.dice.pair();
            self.reflect_diffusely(&at, reflectance, chance, square)
        } else {
            self.flux_lm = self.flux_lm * (1.0 / (1.0 - chance));
            self.scatter_specular(scene, lighting)
        }
    }

    fn reflect_diffusely(
        &mut self,
        at: &SurfacePoint,
        reflectance: Rgb,
        chance: f64,
        square: [f64; 2],
    ) -> bool {
        let direction = at.shading.to_direction().from_local(CosineHemisphere::sample(square));
        self.diffused = true;
        self.go(Scattered {
            ray: at.leave(direction),
            direction,
            weight: reflectance * (1.0 / chance),
            mirrored: false,
        });
        direction.cos(at.geometric) > 0.0
    }

    /// Whether the particle has used up its scatterings.
    pub(crate) const fn is_given_up(&self) -> bool {
        self.scatterings_left == 0
    }

    fn go(&mut self, next: Scattered) {
        self.scatterings_left -= 1;
        self.ray = next.ray;
        self.direction = next.direction;
        self.flux_lm = self.flux_lm * next.weight;
    }
}

/// Probability of diffuse reflection: the reflectance for the luminance of the particle's light. The specular
/// part has its own Russian roulette in the rest, so the probability is one only where there is no specular part.
fn diffuse_chance(finish: &Finish, reflectance: Rgb, flux: Rgb) -> f64 {
    let chance =
        ((flux * reflectance).luminance() / flux.luminance().max(f64::MIN_POSITIVE)).min(1.0);
    let specular = !finish.mirror.is_black() || finish.is_glossy();
    if specular { chance.min(0.95) } else { chance }
}
