//! Particles that leave luminaires in proportion to flux.

use super::far_sky::{FarSky, on_disc};
use super::sources::{LuminaireId, inverse_of_rotation};
use crate::engine::ray::{Dice, SurfacePoint};
use crate::sampling::CosineHemisphere;
use crate::scene::{AreaLuminaire, Luminaire, LuminaireKind, Scene};
use crate::units::Rgb;
use isolux_geometry::{Direction, Normal, Point, Ray, Vector};
use std::f64::consts::PI;

/// The smallest intensity of a luminaire towards an extended target, as a share of its mean
/// intensity. The target also extends into other directions.
const LEAST_INTENSITY_SHARE: f64 = 0.1;

/// All luminaires of a scene as emitters of particles.
pub(crate) struct Emission<'s> {
    scene: &'s Scene,
    /// Running sums of the fluxes, lm: luminaires without surface, then emitting surfaces.
    sums_lm: Vec<f64>,
    /// Running sums of the areas of the triangles of every emitting surface, m2.
    sums_m2: Vec<Vec<f64>>,
    /// Centre of a sphere around the scene, which light from far away has to cover.
    centre: Point,
    radius_m: f64,
    /// Skies, by the number of the luminaire.
    skies: Vec<(usize, FarSky)>,
}

impl Emitted {
    /// Whether the particle left an emitting surface.
    pub(crate) const fn is_of_surface(&self) -> bool {
        self.normal.is_some()
    }
}

/// A particle as it leaves a luminaire.
pub(crate) struct Emitted {
    pub(crate) ray: Ray,
    pub(crate) direction: Direction,
    pub(crate) luminaire: LuminaireId,
    /// Colour of its flux, with a photometric value of one on average.
    pub(crate) colour: Rgb,
    /// Normal of the surface that it leaves.
    normal: Option<Normal>,
}

impl<'s> Emission<'s> {
    /// The emitters of a scene; `None` where there is no light.
    pub(crate) fn new(scene: &'s Scene) -> Option<Self> {
        let (low, high) = scene.bvh().mesh().bounds()?;
        let radius_m = 0.5 * (high - low).length() * (1.0 + 1e-3);
        let skies = skies(scene);
        let points = scene.luminaires().iter().enumerate().map(|(number, luminaire)| {
            let white = match &luminaire.kind {
                LuminaireKind::Point { intensity, .. } => intensity.luminous_flux_lm(),
                LuminaireKind::Directional { illuminance_lx, .. } => {
                    illuminance_lx * PI * radius_m * radius_m
                }
                LuminaireKind::Sky { .. } => {
                    let mean_cd_m2 = sky(&skies, number).map_or(0.0, FarSky::mean_cd_m2);
                    4.0 * PI * mean_cd_m2 * PI * radius_m * radius_m
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
        if sum <= 0.0 {
            return None;
        }
        let sums_m2 = scene.area_luminaires().iter().map(|area| sums_m2(scene, area)).collect();
        Some(Self { scene, sums_lm, sums_m2, centre: low.lerp(high, 0.5), radius_m, skies })
    }

    /// Flux of all luminaires, lm.
    pub(crate) fn flux_lm(&self) -> f64 {
        self.sums_lm.last().copied().unwrap_or(0.0)
    }

    /// One particle of all luminaires; `None` where a distribution has no flux after all.
    pub(crate) fn emit(&self, dice: &mut Dice) -> Option<Emitted> {
        let [pick, other] = dice.pair();
        let square = dice.pair();
        let place = dice.pair();
        let number = self.sums_lm.partition_point(|&sum| sum <= pick * self.flux_lm());
        self.emit_from(number.min(self.sums_lm.len() - 1), other, square, place)
    }

    /// One particle of a luminaire. `other` chooses a triangle of a surface, `square` the
    /// direction, and `place` the position.
    pub(crate) fn emit_from(
        &self,
        number: usize,
        other: f64,
        square: [f64; 2],
        place: [f64; 2],
    ) -> Option<Emitted> {
        let luminaire = match self.luminaire(number) {
            Emitter::Surface(area) => {
                let start = self.start(number, area, other, place);
                let direction =
                    start.normal.to_direction().from_local(CosineHemisphere::sample(square));
                return Some(self.leave(number, area, &start, direction));
            }
            Emitter::Other(luminaire) => luminaire,
        };
        match &luminaire.kind {
            LuminaireKind::Point { world_from_luminaire, intensity, .. } => {
                let local = intensity.sample(square)?;
                let direction = world_from_luminaire.vector(local.to_vector()).direction()?;
                let origin = origin(&luminaire.kind, other, place)?;
                Some(self.sent(number, luminaire, origin, direction))
            }
            LuminaireKind::Directional { .. } | LuminaireKind::Sky { .. } => {
                let (direction, colour) = self.afar(number, luminaire, (other, square))?;
                let origin = self.on_disc(direction, place);
                Some(Emitted { colour, ..self.sent(number, luminaire, origin, direction) })
            }
        }
    }

    /// A direction of light from infinitely far away, and the colour of its flux: of a sky, times what the luminance there is
    /// over the mean of its cell.
    fn afar(
        &self,
        number: usize,
        luminaire: &Luminaire,
        (pick, square): (f64, [f64; 2]),
    ) -> Option<(Direction, Rgb)> {
        match &luminaire.kind {
            LuminaireKind::Directional { direction, half_angle_rad, .. } => {
                let towards = on_disc(-*direction, *half_angle_rad, square);
                Some((-towards, luminaire.colour.chromaticity()))
            }
            LuminaireKind::Sky { .. } => {
                let sky = sky(&self.skies, number)?;
                let towards = sky.draw(pick, square)?;
                let cell_cd_m2 = sky.density(towards) * 4.0 * PI * sky.mean_cd_m2();
                let share = sky.luminance_cd_m2(towards) / cell_cd_m2;
                Some((-towards, luminaire.colour.chromaticity() * share))
            }
            LuminaireKind::Point { .. } => None,
        }
    }

    /// A ray from a random place of an emitting surface, cosine-distributed. `number` is that among all luminaires.
    pub(crate) fn leaving(
        &self,
        number: usize,
        pick: f64,
        place: [f64; 2],
        square: [f64; 2],
    ) -> Option<Ray> {
        let Emitter::Surface(area) = self.luminaire(number) else { return None };
        let start = self.start(number, area, pick, place);
        let direction = start.normal.to_direction().from_local(CosineHemisphere::sample(square));
        Some(self.leave(number, area, &start, direction).ray)
    }

    /// Share of all particles that land on a square metre where point luminaires give this direct illuminance, 1/m2.
    pub(crate) fn landing(&self, direct_lx: Rgb) -> f64 {
        direct_lx.luminance() / self.flux_lm()
    }

    /// Number of luminaires. Emitting surfaces have the last numbers.
    pub(crate) const fn count(&self) -> usize {
        self.sums_lm.len()
    }

    /// Share of all flux that a luminaire emits.
    pub(crate) fn part(&self, number: usize) -> f64 {
        let before = number.checked_sub(1).map_or(0.0, |before| self.sums_lm[before]);
        (self.sums_lm[number] - before) / self.flux_lm()
    }

    /// One particle of a luminaire that flies towards a place; `None` where it emits no light that way.
    pub(crate) fn towards(
        &self,
        number: usize,
        to: Point,
        pick: f64,
        place: [f64; 2],
    ) -> Option<Emitted> {
        match self.luminaire(number) {
            Emitter::Surface(area) => {
                let start = self.start(number, area, pick, place);
                let direction = (to - start.origin).direction()?;
                (direction.cos(start.normal) > 0.0)
                    .then(|| self.leave(number, area, &start, direction))
            }
            Emitter::Other(luminaire) if luminaire.kind.is_infinitely_far() => {
                let (direction, colour) = self.afar(number, luminaire, (pick, place))?;
                let beyond_m = (to - self.centre).dot(direction.to_vector());
                let origin = to - direction * (2.0 * self.radius_m + beyond_m);
                Some(Emitted { colour, ..self.sent(number, luminaire, origin, direction) })
            }
            Emitter::Other(luminaire) => {
                let origin = origin(&luminaire.kind, pick, place)?;
                let direction = (to - origin).direction()?;
                Some(self.sent(number, luminaire, origin, direction))
            }
        }
    }

    /// Share of all particles of [`Emission::emit`] that would arrive for every square metre at a
    /// place, 1/m2, if all particles of the luminaire left from the same place as `emitted`.
    pub(crate) fn density(&self, emitted: &Emitted, at: &SurfacePoint) -> f64 {
        let Emitted { direction, luminaire, normal, .. } = emitted;
        let number = self.number(*luminaire);
        let cos = direction.cos(at.geometric).abs();
        let distance2 = (at.point - emitted.ray.origin).length_squared();
        let one_m2 = match self.luminaire(number) {
            Emitter::Surface(_) => {
                let cos = normal.map_or(0.0, |normal| direction.cos(normal).max(0.0));
                self.part(number) * cos / PI / distance2
            }
            Emitter::Other(luminaire) => self.on_one_m2(number, luminaire, *direction, distance2),
        };
        one_m2 * cos
    }

    /// Approximate share of all particles that a luminaire sends to a surface of one square metre,
    /// 1/m2, with the distance at least `least_m`.
    pub(crate) fn reach(&self, number: usize, at: Point, least_m: f64) -> f64 {
        let from = |origin: Point| {
            let way = at - origin;
            (way.direction(), way.length_squared().max(least_m * least_m))
        };
        let evenly = |distance2: f64| self.part(number) / (4.0 * PI) / distance2;
        let one_m2 = match self.luminaire(number) {
            Emitter::Surface(area) => {
                let start = self.start(number, area, 0.5, [4.0 / 9.0, 0.5]);
                let (direction, distance2) = from(start.origin);
                let cos = direction.map_or(1.0, |direction| direction.cos(start.normal));
                evenly(distance2) * (4.0 * cos).max(LEAST_INTENSITY_SHARE)
            }
            Emitter::Other(luminaire) => {
                let origin = match &luminaire.kind {
                    LuminaireKind::Point { position, .. } => *position,
                    LuminaireKind::Directional { direction, .. } => at - direction.to_vector(),
                    // From the zenith: it makes no difference.
                    LuminaireKind::Sky { world_from_sky, .. } => {
                        at + world_from_sky.vector(Vector::new(0.0, 0.0, 1.0))
                    }
                };
                let (direction, distance2) = from(origin);
                let told = direction.map(|d| self.on_one_m2(number, luminaire, d, distance2));
                told.unwrap_or(0.0).max(LEAST_INTENSITY_SHARE * evenly(distance2))
            }
        };
        0.5 * one_m2
    }

    /// Share of all particles that a luminaire without surface sends to a square metre that faces
    /// it, 1/m2, at a squared distance of `distance2` m2.
    fn on_one_m2(
        &self,
        number: usize,
        luminaire: &Luminaire,
        direction: Direction,
        distance2: f64,
    ) -> f64 {
        match &luminaire.kind {
            LuminaireKind::Directional { .. } | LuminaireKind::Sky { .. } => {
                self.part(number) / (PI * self.radius_m * self.radius_m)
            }
            LuminaireKind::Point { world_from_luminaire, intensity, .. } => {
                let local_from_world = world_from_luminaire.inverse();
                let local =
                    local_from_world.and_then(|of| of.vector(direction.to_vector()).direction());
                let candela = local.map_or(0.0, |local| intensity.intensity_cd(local));
                candela * luminaire.colour.luminance() / self.flux_lm() / distance2
            }
        }
    }

    pub(crate) fn number(&self, luminaire: LuminaireId) -> usize {
        match luminaire {
            LuminaireId::Luminaire(k) => k as usize,
            LuminaireId::Area(k) => self.scene.luminaires().len() + k as usize,
        }
    }

    fn luminaire(&self, number: usize) -> Emitter<'s> {
        let others = self.scene.luminaires();
        match others.get(number) {
            Some(luminaire) => Emitter::Other(luminaire),
            None => Emitter::Surface(&self.scene.area_luminaires()[number - others.len()]),
        }
    }

    fn sent(
        &self,
        number: usize,
        luminaire: &Luminaire,
        origin: Point,
        direction: Direction,
    ) -> Emitted {
        Emitted {
            ray: self.ray(origin, direction),
            direction,
            luminaire: LuminaireId::Luminaire(number as u32),
            colour: luminaire.colour.chromaticity(),
            normal: None,
        }
    }

    /// A ray whose origin is rounded as in the ray kernel, which counts distances from there.
    fn ray(&self, origin: Point, direction: Direction) -> Ray {
        Ray::new(self.scene.bvh().mesh().rounded(origin), direction)
    }

    /// A start of light from far away: uniform over a disc that covers the scene.
    fn on_disc(&self, direction: Direction, [a, b]: [f64; 2]) -> Point {
        let (u, v) = direction.frame();
        let radius = self.radius_m * a.sqrt();
        let (s, c) = libm::sincos(2.0 * PI * b);
        self.centre + u * (radius * c) + v * (radius * s) - direction * (2.0 * self.radius_m)
    }

    /// A place of an emitting surface, uniform by area.
    fn start(&self, number: usize, area: &AreaLuminaire, pick: f64, [a, b]: [f64; 2]) -> Start {
        let sums_m2 = &self.sums_m2[number - self.scene.luminaires().len()];
        let drawn = sums_m2.partition_point(|&sum| sum <= pick * area.area_m2);
        let triangle = area.triangles[drawn.min(area.triangles.len() - 1)];
        let root = a.sqrt();
        let point = self.scene.triangle(triangle).point(root * (1.0 - b), root * b);
        let front = self.scene.geometric_normal(triangle);
        let normal = if area.back { -front } else { front };
        Start { origin: self.scene.bvh().offset_origin(point, normal), triangle, normal }
    }

    fn leave(
        &self,
        number: usize,
        area: &AreaLuminaire,
        start: &Start,
        direction: Direction,
    ) -> Emitted {
        Emitted {
            ray: self.ray(start.origin, direction).skipping(start.triangle),
            direction,
            luminaire: LuminaireId::Area((number - self.scene.luminaires().len()) as u32),
            colour: area.luminance_cd_m2.chromaticity(),
            normal: Some(start.normal),
        }
    }
}

/// The skies of a scene, by the number of the luminaire.
fn skies(scene: &Scene) -> Vec<(usize, FarSky)> {
    let of = |(number, luminaire): (usize, &Luminaire)| match &luminaire.kind {
        LuminaireKind::Sky { world_from_sky, sky } => {
            Some((number, FarSky::new(sky, inverse_of_rotation(world_from_sky))))
        }
        _ => None,
    };
    scene.luminaires().iter().enumerate().filter_map(of).collect()
}

fn sky(skies: &[(usize, FarSky)], number: usize) -> Option<&FarSky> {
    skies.iter().find(|(of, _)| *of == number).map(|(_, sky)| sky)
}

/// Where light leaves a luminaire: its position, or a place of its luminous area; `None` for light from
/// infinitely far away.
fn origin(kind: &LuminaireKind, pick: f64, [a, b]: [f64; 2]) -> Option<Point> {
    let LuminaireKind::Point { position, world_from_luminaire, area, .. } = kind else {
        return None;
    };
    let offset = area.map(|area| world_from_luminaire.vector(area.place([a, b, pick])));
    Some(offset.map_or(*position, |offset| *position + offset))
}

/// Running sums of the areas of the triangles of an emitting surface, m2.
fn sums_m2(scene: &Scene, area: &AreaLuminaire) -> Vec<f64> {
    let mut sum = 0.0;
    let add = |&triangle: &u32| {
        sum += scene.triangle(triangle).area();
        sum
    };
    area.triangles.iter().map(add).collect()
}

/// A luminaire of either kind.
enum Emitter<'s> {
    Other(&'s Luminaire),
    Surface(&'s AreaLuminaire),
}

/// The place where a particle leaves an emitting surface.
struct Start {
    origin: Point,
    triangle: u32,
    normal: Normal,
}
