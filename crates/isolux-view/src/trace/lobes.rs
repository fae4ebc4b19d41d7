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

/// Facets narrower than this show no luminaire without surface: it is seen as wide as real ones are, and less than a pixel.
const POINT_ALPHA: f64 = 0.03;

/// A direction in which a surface shows what lies there, times a weight.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lobe {
    pub(super) weight: Rgb,
    pub(super) direction: Direction,
    /// If it is one of many about the direction: the density of all of them there, 1/sr.
    pub(super) density: Option<f64>,
}

impl Lobe {
    const fn sharp(weight: Rgb, direction: Direction) -> Self {
        Self { weight, direction, density: None }
    }

    /// Whether it is one of many about the direction.
    pub(super) const fn is_blurred(&self) -> bool {
        self.density.is_some()
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
    /// The way back, in the frame of the normal.
    fn view(&self) -> Vector {
        let axis = self.normal.to_direction();
        let (u, v) = axis.frame();
        let towards = -self.direction;
        Vector::new(towards.dot(u), towards.dot(v), towards.dot(axis).max(1e-6))
    }

    /// The mirror direction; about the flat normal where a smoothed one would lead into the surface.
    fn mirror(&self) -> Direction {
        let smooth = self.direction.reflect(self.normal);
        if smooth.cos(self.flat) > 0.0 { smooth } else { self.direction.reflect(self.flat) }
    }
}

/// Facets of one width, of gloss or of a coat.
pub(super) struct Rough<'a> {
    finish: &'a Finish,
    layer: Layer<'a>,
    alpha: f64,
}

#[derive(Clone, Copy)]
enum Layer<'a> {
    Gloss(&'a Gloss),
    Coat,
}

/// The lobes of an opaque finish.
pub(super) fn opaque(at: &Arrival, finish: &Finish, facets: u32, key: Key) -> Vec<Lobe> {
    let mut lobes = Vec::new();
    if !finish.mirror.is_black() {
        lobes.push(Lobe::sharp(finish.mirror, at.mirror()));
    }
    layers(finish).for_each(|layer| layer.add_lobes(at, (facets, key), &mut lobes));
    lobes
}

/// What shows luminaires blurred.
pub(super) fn rough(finish: &Finish) -> impl Iterator<Item = Rough<'_>> {
    layers(finish).filter(|layer| layer.alpha >= MIRROR_ALPHA)
}

fn layers(finish: &Finish) -> impl Iterator<Item = Rough<'_>> {
    let gloss = finish.gloss.as_ref().map(|gloss| (Layer::Gloss(gloss), gloss.alpha));
    let coat = finish.coat.as_ref().map(|coat| (Layer::Coat, coat.alpha));
    gloss.into_iter().chain(coat).map(move |(layer, alpha)| Rough { finish, layer, alpha })
}

impl Rough<'_> {
    /// The lobes of so many visible facets (Heitz 2018, "Sampling the GGX distribution of visible normals").
    fn add_lobes(&self, at: &Arrival, (facets, key): (u32, Key), lobes: &mut Vec<Lobe>) {
        if self.alpha < MIRROR_ALPHA {
            let cos = -at.direction.cos(at.normal);
            lobes.push(Lobe::sharp(self.reflectance(cos, [cos, cos]), at.mirror()));
            return;
        }
        let key = match self.layer {
            Layer::Gloss(_) => key,
            Layer::Coat => key.with(COAT),
        };
        let ggx = Ggx { alpha: self.alpha };
        let view = at.view();
        let all = f64::from(facets);
        let lobe = |place| {
            let half = ggx.sample(view, place);
            let out = half * (2.0 * view.dot(half)) - view;
            let direction = at.normal.to_direction().from_local(out.direction()?.to_vector());
            let (weight, density) = self.shown(at, view, out, direction)?;
            let (weight, density) = (weight / all, Some(density * all));
            Some(Lobe { weight, direction, density })
        };
        lobes.extend(spread(facets, key).filter_map(lobe));
    }

    /// Whether it is wide enough to show luminaires without surface.
    pub(super) fn shows_points(&self) -> bool {
        self.alpha >= POINT_ALPHA
    }

    /// What one cd/m2 in a direction adds, of which facets are drawn with the density that goes with it, 1/sr.
    pub(super) fn towards(&self, at: &Arrival, direction: Direction) -> Option<(Rgb, f64)> {
        let axis = at.normal.to_direction();
        let (u, v) = axis.frame();
        let out = Vector::new(direction.dot(u), direction.dot(v), direction.dot(axis));
        self.shown(at, at.view(), out, direction)
    }

    fn shown(
        &self,
        at: &Arrival,
        view: Vector,
        out: Vector,
        direction: Direction,
    ) -> Option<(Rgb, f64)> {
        if out.z <= 0.0 || direction.cos(at.flat) <= 0.0 {
            return None;
        }
        let half = (view + out).direction()?.to_vector();
        let ggx = Ggx { alpha: self.alpha };
        let cos = view.dot(half);
        let density = ggx.density(view, half) / (4.0 * cos);
        let entering = -at.direction.cos(at.normal);
        Some((self.reflectance(cos, [entering, out.z]) * ggx.masking(out), density))
    }

    /// By the cosine of light on a facet and those of its ways in and out.
    fn reflectance(&self, facet: f64, cosines: [f64; 2]) -> Rgb {
        match self.layer {
            Layer::Gloss(gloss) => {
                let spare = self.finish.gloss_limit(cosines);
                fresnel(gloss, spare, facet, self.finish.through_coat(cosines))
            }
            Layer::Coat => self.finish.coat_reflectance(facet),
        }
    }
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
