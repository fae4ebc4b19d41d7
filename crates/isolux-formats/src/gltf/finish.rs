//! Metallic-roughness numbers to a [`Finish`]; the formulas are derived in this folder's README.

use isolux::scene::{Coat, Finish, Gloss, Reflectance};
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
    pub(super) coat: Option<ClearCoat>,
}

/// A clear coat of index 1.5.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct ClearCoat {
    /// Share of the surface it covers.
    pub(super) cover: f64,
    /// Perceptual roughness, 0 to 1.
    pub(super) roughness: f64,
}

/// Reflectance at normal incidence of a dielectric against air (Fresnel).
pub(super) fn f0_from_ior(ior: f64) -> f64 {
    let ratio = (ior - 1.0) / (ior + 1.0);
    ratio * ratio
}

/// Mean of Schlick's reflectance over the cosine-weighted hemisphere.
fn mean_albedo(f0: f64) -> f64 {
    if f0 == 0.0 { 0.0 } else { f0 + (1.0 - f0) / 21.0 }
}

/// The finish without light of its own.
pub(super) fn finish(pbr: &MetallicRoughness) -> Finish {
    let dielectric = 1.0 - pbr.metallic;
    let diffuse = pbr.base * (dielectric * (1.0 - mean_albedo(pbr.dielectric_f0.max_channel())));
    let metal = pbr.base * pbr.texture_mean * pbr.metallic;
    let f0 = metal + pbr.dielectric_f0 * dielectric;
    // What the coat reflects in the mean is taken from what is diffuse below it; from gloss by the angle.
    let diffuse = diffuse * pbr.coat.map_or(1.0, |coat| 1.0 - coat.cover * mean_albedo(Coat::F0));
    let coat = pbr.coat.filter(|coat| coat.cover > 0.0);
    Finish {
        diffuse: Reflectance {
            colour: diffuse,
            texture: pbr.texture.filter(|_| !diffuse.is_black()),
        },
        gloss: (!f0.is_black()).then_some(Gloss { f0, alpha: alpha(pbr.roughness) }),
        coat: coat.map(|c| Coat { cover: c.cover, alpha: alpha(c.roughness) }),
        ..Finish::BLACK
    }
}

fn alpha(roughness: f64) -> f64 {
    (roughness * roughness).max(SMALLEST_ALPHA)
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
                        coat: Some(ClearCoat { cover, roughness: 0.1 }),
                    };
                    let finish = finish(&pbr);
                    let sum = (finish.diffuse.colour + finish.glossy_f0()).max_channel();
                    // Four roundings of numbers up to one.
                    assert!(sum <= 1.0 + 4.0 * f64::EPSILON, "{pbr:?}: {sum}");
                }
            }
        }
    }

    /// What a coat reflects in the mean is taken from diffuse reflection: white stays white.
    #[test]
    fn a_coat_keeps_the_energy() {
        let pbr = MetallicRoughness {
            base: Rgb::WHITE,
            texture_mean: Rgb::WHITE,
            texture: None,
            metallic: 0.0,
            roughness: 0.5,
            dielectric_f0: Rgb::BLACK,
            coat: Some(ClearCoat { cover: 0.7, roughness: 0.0 }),
        };
        let finish = finish(&pbr);
        let sum = finish.diffuse.colour.0[0] + 0.7 * mean_albedo(Coat::F0);
        // Four roundings of numbers up to one.
        assert!((sum - 1.0).abs() < 4.0 * f64::EPSILON, "{sum}");
        assert_eq!(finish.coat, Some(Coat { cover: 0.7, alpha: SMALLEST_ALPHA }));
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
