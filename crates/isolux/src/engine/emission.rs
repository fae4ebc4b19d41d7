//! Particles leaving luminaires in proportion to flux.

use super::direct::LuminaireId;
use super::path::Dice;
use crate::sampling::CosineHemisphere;
use crate::scene::{AreaLuminaire, LuminaireKind, Scene};
use crate::units::Rgb;
use isolux_geometry::{Direction, Point, Ray};
use std::f64::consts::PI;

/// All luminaires of a scene as emitters of particles.
pub(super) struct Emission<'s> {
    scene: &'s Scene,
    /// Running sums of the fluxes, lm: luminaires without surface, then emitting surfaces.
    sums_lm: Vec<f64>,
    /// Sphere around the scene, which parallel light has to cover.
    centre: Point,
    radius_m: f64,
}

/// A particle as it leaves.
pub(super) struct Emitted {
    pub(super) ray: Ray,
    pub(super) direction: Direction,
    pub(super) luminaire: LuminaireId,
    /// Flux it carries, of photometric value one.
    pub(super) colour: Rgb,
}

impl<'s> Emission<'s> {
    /// `None` where there is no light.
    pub(super) fn new(scene: &'s Scene) -> Option<Self> {
        let (low, high) = scene.bvh().mesh().bounds()?;
        let radius_m = 0.5 * (high - low).length() * (1.0 + 1e-3);
        let points = scene.luminaires().iter().map(|luminaire| {
            let white = match &luminaire.kind {
                LuminaireKind::Point { intensity, .. } => intensity.luminous_flux_lm(),
                LuminaireKind::Directional { illuminance_lx, .. } => {
                    illuminance_lx * PI * radius_m * radius_m
                }
            };
            white * luminaire.colour.luminance()
        });
        let areas = scene.area_luminaires().iter().map(AreaLuminaire::luminous_flux_lm);
        let mut sum = 0.0;
        let sums_lm: Vec<f64> = points
            .chain(areas)
            .map(|lm| {
                sum += lm;
                sum
            })
            .collect();
        (sum > 0.0).then(|| Self { scene, sums_lm, centre: low.lerp(high, 0.5), radius_m })
    }

    /// Flux of all, lm.
    pub(super) fn flux_lm(&self) -> f64 {
        self.sums_lm.last().copied().unwrap_or(0.0)
    }

    /// One particle; `None` where a distribution has no flux after all.
    pub(super) fn emit(&self, dice: &mut Dice) -> Option<Emitted> {
        let [pick, other] = dice.pair();
        let square = dice.pair();
        let place = dice.pair();
        let index = self.sums_lm.partition_point(|&sum| sum <= pick * self.flux_lm());
        let index = index.min(self.sums_lm.len() - 1);
        let points = self.scene.luminaires().len();
        if index >= points {
            let area = &self.scene.area_luminaires()[index - points];
            return self.leave_area(area, index - points, other, square, place);
        }
        let luminaire = &self.scene.luminaires()[index];
        let (origin, direction) = match &luminaire.kind {
            LuminaireKind::Point { position, world_from_luminaire, intensity } => {
                let local = intensity.sample(square)?;
                (*position, world_from_luminaire.vector(local.to_vector()).direction()?)
            }
            LuminaireKind::Directional { direction, .. } => {
                (self.on_disc(*direction, place), *direction)
            }
        };
        Some(Emitted {
            ray: Ray::new(origin, direction),
            direction,
            luminaire: LuminaireId::Luminaire(index as u32),
            colour: luminaire.colour.chromaticity(),
        })
    }

    /// A start of parallel light: uniform over a disc that covers the scene.
    fn on_disc(&self, direction: Direction, [a, b]: [f64; 2]) -> Point {
        let (u, v) = direction.frame();
        let radius = self.radius_m * a.sqrt();
        let (s, c) = libm::sincos(2.0 * PI * b);
        self.centre + u * (radius * c) + v * (radius * s) - direction * (2.0 * self.radius_m)
    }

    fn leave_area(
        &self,
        area: &AreaLuminaire,
        index: usize,
        pick: f64,
        square: [f64; 2],
        [a, b]: [f64; 2],
    ) -> Option<Emitted> {
        let mut left_m2 = pick * area.area_m2;
        let drawn = area.triangles.iter().find(|&&t| {
            left_m2 -= self.scene.triangle(t).area();
            left_m2 < 0.0
        });
        let triangle = *drawn.or(area.triangles.last())?;
        let root = a.sqrt();
        let point = self.scene.triangle(triangle).point(root * (1.0 - b), root * b);
        let front = self.scene.geometric_normal(triangle);
        let normal = if area.back { -front } else { front };
        let direction = normal.to_direction().from_local(CosineHemisphere::sample(square));
        Some(Emitted {
            ray: Ray::new(self.scene.bvh().offset_origin(point, normal), direction)
                .skipping(triangle),
            direction,
            luminaire: LuminaireId::Area(index as u32),
            colour: area.luminance_cd_m2.chromaticity(),
        })
    }
}
