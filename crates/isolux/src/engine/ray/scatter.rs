//! Scattering by specular surfaces: mirrors, gloss, coats, glass.

use super::surface::SurfacePoint;
use crate::sampling::Ggx;
use crate::scene::pane::{fresnel, mean};
use crate::scene::{Body, Dielectric, Finish, Pane};
use crate::units::Rgb;
use isolux_geometry::{Direction, Ray, Vector};

/// One sample of the light that a surface scatters.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Scattered {
    /// The ray along which the light goes on.
    pub(crate) ray: Ray,
    pub(crate) direction: Direction,
    /// Factor on the light carried, divided by the probability of this sample.
    pub(crate) weight: Rgb,
    /// Whether a perfect mirror reflected it.
    pub(crate) mirrored: bool,
}

/// Probability with which the specular part of a finish is followed: its largest reflectance over the
/// channels.
pub(crate) fn specular_share(finish: &Finish, surface: &SurfacePoint, incoming: Direction) -> f64 {
    let cos = -incoming.cos(surface.shading);
    (finish.mirror + gloss_share(finish, cos) + finish.coat_reflectance(cos))
        .max_channel()
        .clamp(0.0, 1.0)
}

/// Reflectance of the gloss if its facets lay in the surface.
fn gloss_share(finish: &Finish, cos: f64) -> Rgb {
    finish.gloss.map_or(Rgb::BLACK, |gloss| {
        (schlick(gloss.f0, cos) * finish.through_coat([cos; 2])).min(finish.gloss_limit([cos; 2]))
    })
}

/// One sample of the specular part of a finish, weighted as one taken with the probability
/// [`specular_share`]. `pick` in [0, 1) chooses between mirror, coat and gloss; `square` chooses the facet.
pub(crate) fn reflect(
    finish: &Finish,
    surface: &SurfacePoint,
    incoming: Direction,
    pick: f64,
    square: [f64; 2],
) -> Option<Scattered> {
    let share = specular_share(finish, surface, incoming);
    let mirror = finish.mirror.max_channel();
    let cos = -incoming.cos(surface.shading);
    let gloss = gloss_share(finish, cos).max_channel();
    let coat = finish.coat_reflectance(cos).max_channel();
    // Each part is drawn in proportion to its strongest channel, which may differ from part to part.
    let mirror_chance = mirror / (mirror + gloss + coat);
    let coat_chance = coat / (mirror + gloss + coat);
    if pick < mirror_chance {
        let direction = incoming.reflect(surface.shading);
        let weight = finish.mirror * (1.0 / (share * mirror_chance));
        return scattered(surface, direction, weight, true);
    }
    if let Some(layer) = finish.coat.filter(|_| pick < mirror_chance + coat_chance) {
        let facet = facet(layer.alpha, surface, incoming, square)?;
        let reflectance = finish.coat_reflectance(facet.cos) * facet.unmasked;
        let weight = reflectance * (1.0 / (share * coat_chance));
        return scattered(surface, facet.direction, weight, false);
    }
    let gloss = finish.gloss?;
    let facet = facet(gloss.alpha, surface, incoming, square)?;
    let cosines = [cos, facet.direction.cos(surface.shading)];
    let reflectance = schlick(gloss.f0, facet.cos) * facet.unmasked * finish.through_coat(cosines);
    // The gloss reflects at most the share that the other parts leave, at any angle.
    let chance = 1.0 - mirror_chance - coat_chance;
    let weight = reflectance.min(finish.gloss_limit(cosines)) * (1.0 / (share * chance));
    scattered(surface, facet.direction, weight, false)
}

fn scattered(
    surface: &SurfacePoint,
    direction: Direction,
    weight: Rgb,
    mirrored: bool,
) -> Option<Scattered> {
    // Interpolated normals can send light below the true surface: it is lost there.
    (direction.cos(surface.geometric) > 0.0).then(|| Scattered {
        ray: surface.leave(direction),
        direction,
        weight,
        mirrored,
    })
}

/// A reflection at one microfacet of the GGX distribution, drawn from the visible ones.
struct Facet {
    direction: Direction,
    /// Cosine of the angle of incidence on the facet.
    cos: f64,
    /// The unmasked share of its reflectance: the masking function G1 of the outgoing direction.
    unmasked: f64,
}

fn facet(
    alpha: f64,
    surface: &SurfacePoint,
    incoming: Direction,
    square: [f64; 2],
) -> Option<Facet> {
    let normal = surface.shading.to_direction();
    let (u, v) = normal.frame();
    let view = -incoming;
    let local = Vector::new(view.dot(u), view.dot(v), view.dot(normal));
    if local.z <= 0.0 {
        return None;
    }
    let ggx = Ggx { alpha };
    let facet = ggx.sample(local, square);
    let cos = local.dot(facet);
    let out = facet * (2.0 * cos) - local;
    if out.z <= 0.0 {
        return None;
    }
    Some(Facet { direction: normal.from_local(out), cos, unmasked: ggx.masking(out) })
}

/// Schlick's approximation of Fresnel reflectance (1994).
fn schlick(f0: Rgb, cos: f64) -> Rgb {
    let m = (1.0 - cos).clamp(0.0, 1.0);
    let m5 = m * m * m * m * m;
    f0.map(|f| f + (1.0 - f) * m5)
}

/// One sample of the light that leaves a smooth dielectric: reflection with a probability in proportion to
/// Fresnel's reflectance, else transmission.
pub(crate) fn refract(
    glass: &Dielectric,
    surface: &SurfacePoint,
    incoming: Direction,
    pick: f64,
) -> Scattered {
    let cos = -incoming.cos(surface.shading);
    let ior = if surface.back { 1.0 / glass.ior } else { glass.ior };
    let (reflected, transmitted, through) = if glass.thin {
        let Pane { reflectance, transmittance } = glass.pane(cos);
        (reflectance, transmittance, Some(incoming))
    } else {
        let reflectance = mean(fresnel(cos, ior));
        let through = refracted(incoming, surface, cos, ior);
        let kept = if through.is_some() { reflectance } else { 1.0 };
        (Rgb::grey(kept), glass.transmittance * (1.0 - kept), through)
    };
    let both = reflected.luminance() + transmitted.luminance();
    let chance = if both > 0.0 { reflected.luminance() / both } else { 1.0 };
    match through.filter(|_| pick >= chance) {
        Some(direction) => Scattered {
            ray: surface.cross(direction),
            direction,
            weight: transmitted * (1.0 / (1.0 - chance)),
            mirrored: false,
        },
        None => {
            let direction = incoming.reflect(surface.shading);
            let weight = reflected * (1.0 / chance);
            Scattered { ray: surface.leave(direction), direction, weight, mirrored: false }
        }
    }
}

/// Factor on luminance at a refraction, besides the weight of [`refract`], for a path followed backwards.
/// Light that enters a denser medium is pressed into a smaller solid angle; luminance over the square of the
/// index is invariant (Nicodemus 1963, "Radiance"). Flux needs no such factor.
pub(crate) fn luminance_ratio(body: &Body, surface: &SurfacePoint, onwards: Direction) -> f64 {
    match body {
        Body::Dielectric(glass) if !glass.thin && onwards.cos(surface.shading) < 0.0 => {
            let ior = if surface.back { 1.0 / glass.ior } else { glass.ior };
            1.0 / (ior * ior)
        }
        _ => 1.0,
    }
}

/// Direction of the refracted ray by Snell's law; `None` at total reflection.
fn refracted(incoming: Direction, surface: &SurfacePoint, cos: f64, ior: f64) -> Option<Direction> {
    let sin2 = (1.0 - cos * cos) / (ior * ior);
    if sin2 >= 1.0 {
        return None;
    }
    let normal = surface.shading.to_vector();
    let along = incoming.to_vector() / ior + normal * (cos / ior - (1.0 - sin2).sqrt());
    along.direction()
}
