//! Where a surface looks on: mirror directions, refraction, facets of gloss and coats.

use super::dielectric::Interface;
use isolux::geometry::{Direction, Normal, Vector};
use isolux::sampling::{Ggx, Key};
use isolux::scene::{Dielectric, Finish, Gloss};
use isolux::units::Rgb;

/// Tells the random shift of the coat from that of what lies below.
const COAT: u64 = 2;
/// Facets narrower than this are mirrors: their lobe is thinner than a pixel.
const MIRROR_ALPHA: f64 = 1e-3;

/// A direction in which a surface shows what lies there, times a weight.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lobe {
    pub(super) weight: Rgb,
    pub(super) direction: Direction,
    /// Whether it is one of many about the direction.
    pub(super) blurred: bool,
}

impl Lobe {
    const fn sharp(weight: Rgb, direction: Direction) -> Self {
        Self { weight, direction, blurred: false }
    }
}

/// A place of a surface as the ray arrives there.
#[derive(Clone, Copy, Debug)]
pub(super) struct Arrival {
    /// Direction of the ray.
    pub(super) direction: Direction,
    /// Shading normal, turned to the side of the ray.
    pub(super) normal: Normal,
    /// Normal of the triangle, turned to the side of the ray.
    pub(super) flat: Normal,
}

impl Arrival {
    /// The mirror direction; about the flat normal where a smoothed one would lead into the surface.
    fn mirror(&self) -> Direction {
        let smooth = self.direction.reflect(self.normal);
        if smooth.cos(self.flat) > 0.0 { smooth } else { self.direction.reflect(self.flat) }
    }
}

/// The lobes of an opaque finish.
pub(super) fn opaque(at: &Arrival, finish: &Finish, facets: u32, key: Key) -> Vec<Lobe> {
    let mut lobes = Vec::new();
    if !finish.mirror.is_black() {
        lobes.push(Lobe::sharp(finish.mirror, at.mirror()));
    }
    let cos = -at.direction.cos(at.normal);
    if let Some(gloss) = &finish.gloss {
        let below = |facet: f64, out: f64| {
            fresnel(gloss, finish.gloss_limit([cos, out]), facet, finish.through_coat([cos, out]))
        };
        lobes.extend(glossy(at, gloss.alpha, (facets, key), below));
    }
    if let Some(coat) = &finish.coat {
        let coated = |facet: f64, _| finish.coat_reflectance(facet);
        lobes.extend(glossy(at, coat.alpha, (facets, key.with(COAT)), coated));
    }
    lobes
}

/// The lobes of facets of one width, with their reflectance by the cosines of light on a facet and of its way out.
fn glossy(
    at: &Arrival,
    alpha: f64,
    (facets, key): (u32, Key),
    reflectance: impl Fn(f64, f64) -> Rgb,
) -> Vec<Lobe> {
    if alpha < MIRROR_ALPHA {
        let cos = -at.direction.cos(at.normal);
        return vec![Lobe::sharp(reflectance(cos, cos), at.mirror())];
    }
    let lobe = |place| {
        facet(at, alpha, place).map(|facet| Lobe {
            weight: reflectance(facet.cos, facet.out) * (facet.unmasked / f64::from(facets)),
            direction: facet.direction,
            blurred: true,
        })
    };
    spread(facets, key).filter_map(lobe).collect()
}

/// The lobes of a dielectric.
pub(super) fn dielectric(at: &Arrival, glass: &Dielectric, inside: bool) -> Vec<Lobe> {
    let Interface { reflected, transmitted } =
        Interface::new(glass, at.direction, at.normal, inside);
    let mirror = Lobe::sharp(reflected, at.mirror());
    let through = transmitted.map(|(weight, direction)| Lobe::sharp(weight, direction));
    std::iter::once(mirror).chain(through).collect()
}

/// Schlick's approximation, cut where diffuse, mirror and gloss would reflect more than they
/// receive; so much of it passes the coat.
fn fresnel(gloss: &Gloss, spare: Rgb, cos: f64, passing: f64) -> Rgb {
    let c = 1.0 - cos.clamp(0.0, 1.0);
    let c5 = (c * c) * (c * c) * c;
    let channel = |k: usize| {
        let schlick = gloss.f0.0[k] + (1.0 - gloss.f0.0[k]) * c5;
        (schlick * passing).min(spare.0[k])
    };
    Rgb([0, 1, 2].map(channel))
}

/// The places of n facets in the unit square: Hammersley's points, shifted at random.
fn spread(n: u32, key: Key) -> impl Iterator<Item = [f64; 2]> {
    let [x, y] = [0, 1].map(|axis| key.with(axis).uniform());
    (0..n).map(move |k| {
        let mirrored = f64::from(k.reverse_bits()) / 2f64.powi(32);
        [(mirrored + x).fract(), ((f64::from(k) + y) / f64::from(n))]
    })
}

/// A visible facet (Heitz 2018, "Sampling the GGX distribution of visible normals").
struct Facet {
    direction: Direction,
    /// Of the angle of light on it, and on its way out.
    cos: f64,
    out: f64,
    /// The share that leaves unmasked.
    unmasked: f64,
}

fn facet(at: &Arrival, alpha: f64, place: [f64; 2]) -> Option<Facet> {
    let axis = at.normal.to_direction();
    let (u, v) = axis.frame();
    let towards = -at.direction;
    let view = Vector::new(towards.dot(u), towards.dot(v), towards.dot(axis).max(1e-6));
    let ggx = Ggx { alpha };
    let half = ggx.sample(view, place);
    let out = half * (2.0 * view.dot(half)) - view;
    let direction = axis.from_local(out.direction()?.to_vector());
    if out.z <= 0.0 || direction.cos(at.flat) <= 0.0 {
        return None;
    }
    Some(Facet { direction, cos: view.dot(half), out: out.z, unmasked: ggx.masking(out) })
}
