//! Metallic-roughness numbers to a [`Finish`]; the formulas are derived in this folder's README.

use isolux::scene::{Finish, Gloss, Reflectance};
use isolux::units::Rgb;

/// Narrowest facet distribution: a roughness of about 0.03. glTF's smooth surfaces reflect by
/// Fresnel's law, which [`Finish::mirror`], the same at every angle, cannot say.
const SMALLEST_ALPHA: f64 = 1e-3;

/// What a glTF material says of one surface, factors and texture means multiplied together.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct MetallicRoughness {
    /// Base colour without its texture.
    pub(super) base: Rgb,
    /// Mean of the base colour texture; white without one.
    pub(super) texture_mean: Rgb,
    /// Index of the base colour texture among those of the scene.
    pub(super) texture: Option<u32>,
    /// 0 for a dielectric, 1 for a metal.
    pub(super) metallic: f64,
    /// Perceptual roughness, 0 to 1.
    pub(super) roughness: f64,
    /// Reflectance of the dielectric at normal incidence.
    pub(super) dielectric_f0: Rgb,
    /// What lies over all of it.
    pub(super) coat: Option<Coat>,
}

/// A clear coat of index 1.5.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Coat {
    /// Share of the surface it covers.
    pub(super) cover: f64,
    /// Perceptual roughness, 0 to 1.
    pub(super) roughness: f64,
}

/// Reflectance of a coat at normal incidence.
const COAT_F0: f64 = 0.04;

/// Reflectance at normal incidence of a dielectric against air (Fresnel).
pub(super) fn f0_from_ior(ior: f64) -> f64 {
    let ratio = (ior - 1.0) / (ior + 1.0);
    ratio * ratio
}

/// Mean of Schlick's reflectance over the cosine-weighted hemisphere.
fn mean_albedo(f0: f64) -> f64 {
    if f0 == 0.0 { 0.0 } else { f0 + (1.0 - f0) / 21.0 }
}

/// The reflectance at normal incidence of which that is the mean; none below the least mean.
fn f0_of_mean(mean: f64) -> f64 {
    ((21.0 * mean - 1.0) / 20.0).max(0.0)
}

/// The finish without light of its own.
pub(super) fn finish(pbr: &MetallicRoughness) -> Finish {
    let dielectric = 1.0 - pbr.metallic;
    let diffuse = pbr.base * (dielectric * (1.0 - mean_albedo(pbr.dielectric_f0.max_channel())));
    let metal = pbr.base * pbr.texture_mean * pbr.metallic;
    let f0 = metal + pbr.dielectric_f0 * dielectric;
    let base = Layers { diffuse, f0, alpha: alpha(pbr.roughness) };
    let Layers { diffuse, f0, alpha } = match &pbr.coat {
        Some(coat) => base.under(coat),
        None => base,
    };
    Finish {
        diffuse: Reflectance {
            colour: diffuse,
            texture: pbr.texture.filter(|_| !diffuse.is_black()),
        },
        gloss: (!f0.is_black()).then_some(Gloss { f0, alpha }),
        ..Finish::BLACK
    }
}

fn alpha(roughness: f64) -> f64 {
    (roughness * roughness).max(SMALLEST_ALPHA)
}

/// Diffuse reflectance and the gloss above it.
struct Layers {
    diffuse: Rgb,
    f0: Rgb,
    alpha: f64,
}

impl Layers {
    /// The same under a coat: what the coat reflects in the mean is taken from all below it, and its
    /// gloss and that below become one, which reflects as much as both in the mean and is as wide as
    /// they are, weighted by what they reflect.
    fn under(&self, coat: &Coat) -> Self {
        let of_coat = coat.cover * mean_albedo(COAT_F0);
        let below = self.f0.map(mean_albedo) * (1.0 - of_coat);
        let share = of_coat / (of_coat + below.luminance()).max(f64::MIN_POSITIVE);
        Self {
            diffuse: self.diffuse * (1.0 - of_coat),
            f0: (below + Rgb::grey(of_coat)).map(f0_of_mean),
            alpha: alpha(coat.roughness) * share + self.alpha * (1.0 - share),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_combination_gains_energy() {
        let shares = [0.0, 0.04, 0.3, 0.999, 1.0];
        for base in shares {
            for metallic in shares {
                for (dielectric_f0, cover) in
                    shares.into_iter().flat_map(|f0| [0.0, 0.5, 1.0].map(|c| (f0, c)))
                {
                    let pbr = MetallicRoughness {
                        base: Rgb::grey(base),
                        texture_mean: Rgb::WHITE,
                        texture: None,
                        metallic,
                        roughness: 0.5,
                        dielectric_f0: Rgb::grey(dielectric_f0),
                        coat: Some(Coat { cover, roughness: 0.1 }),
                    };
                    let finish = finish(&pbr);
                    let f0 = finish.gloss.map_or(Rgb::BLACK, |g| g.f0);
                    let sum = (finish.diffuse.colour + f0).max_channel();
                    // Four roundings of numbers up to one.
                    assert!(sum <= 1.0 + 4.0 * f64::EPSILON, "{pbr:?}: {sum}");
                }
            }
        }
    }

    /// What a coat reflects is taken from what lies below: a white surface stays white.
    #[test]
    fn a_coat_keeps_the_energy() {
        for metallic in [0.0, 1.0] {
            let pbr = MetallicRoughness {
                base: Rgb::WHITE,
                texture_mean: Rgb::WHITE,
                texture: None,
                metallic,
                roughness: 0.5,
                dielectric_f0: Rgb::grey(0.04),
                coat: Some(Coat { cover: 0.7, roughness: 0.0 }),
            };
            let finish = finish(&pbr);
            let gloss = finish.gloss.unwrap();
            let sum = finish.diffuse.colour.0[0] + mean_albedo(gloss.f0.0[0]);
            // Ten roundings of numbers up to one.
            assert!((sum - 1.0).abs() < 10.0 * f64::EPSILON, "{metallic}: {sum}");
            assert!(gloss.alpha < 0.25 && gloss.alpha > SMALLEST_ALPHA);
        }
    }

    /// The integral of `2 c (f0 + (1 - f0) (1 - c)^5)` over c from 0 to 1, by the midpoint rule.
    #[test]
    fn mean_albedo_is_the_integral() {
        const STEPS: u32 = 20_000;
        for f0 in [0.02, 0.04, 0.5, 1.0] {
            let sum: f64 = (0..STEPS)
                .map(|k| (f64::from(k) + 0.5) / f64::from(STEPS))
                .map(|c| 2.0 * c * (f0 + (1.0 - f0) * (1.0 - c).powi(5)))
                .sum();
            let quadrature = sum / f64::from(STEPS);
            // Midpoint rule: h^2 / 24 times the difference of the end slopes, at most 12.
            assert!((mean_albedo(f0) - quadrature).abs() < 2e-9, "{f0}");
        }
    }
}
