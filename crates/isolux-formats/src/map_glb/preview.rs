//! The look of a map in viewers that know nothing of lux.

use super::display::texture_of;
use super::value_arrays::storable;
use isolux::elements::Element;
use isolux::map::IlluminationMap;
use isolux::scene::{Finish, Scene, Texture};
use isolux::units::Rgb;
use serde::{Deserialize, Serialize};
use std::f64::consts::PI;

/// Displayed luminance, 0 to 1, of a surface of average luminance: a photographer's middle grey.
const MIDDLE_GREY: f64 = 0.18;
/// Share of the area that may be displayed as white.
const WHITE_SHARE: f64 = 0.01;
/// Places darker than this share of the mean are in the dark: the outsides of walls, the insides of cupboards. Nobody's
/// eyes adapt to them.
const DARKEST_SHARE: f64 = 1e-3;

/// How luminances become colours between 0 and 1: the global operator of Reinhard et al. 2002,
/// "Photographic tone reproduction for digital images", equation 4, on the luminance.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Preview {
    /// Factor on luminances, m2/cd.
    pub exposure_m2_cd: f64,
    /// The luminance shown as white, cd/m2.
    pub white_cd_m2: f64,
}

impl Preview {
    /// Exposure by the area-weighted geometric mean of the luminances, white where only a
    /// hundredth of the area is brighter. Where luminances are much alike, white alone decides.
    pub fn automatic(scene: &Scene, map: &IlluminationMap) -> Self {
        let mut patches = lit(patches(scene, map));
        patches.sort_by(|a, b| a.luminance_cd_m2.total_cmp(&b.luminance_cd_m2));
        let Some(Means { area_m2, arithmetic, geometric }) = means(&patches) else {
            return Self { exposure_m2_cd: 1.0, white_cd_m2: 1.0 };
        };
        let mut brighter = area_m2;
        let white = patches.iter().find(|p| {
            brighter -= p.area_m2;
            brighter <= WHITE_SHARE * area_m2
        });
        let white_cd_m2 = white.map_or(arithmetic, |p| p.luminance_cd_m2.max(geometric));
        // Less than one for white would bend the curve the wrong way and exaggerate contrasts; with
        // one it is a straight line.
        let exposure_m2_cd = (MIDDLE_GREY / geometric).max(1.0 / white_cd_m2);
        Self { exposure_m2_cd, white_cd_m2 }
    }

    /// The area-weighted geometric mean of the luminances, cd/m2: what eyes are adapted to, wherever they look. `None` for a map
    /// without light.
    pub fn adaptation_cd_m2(scene: &Scene, map: &IlluminationMap) -> Option<f64> {
        means(&lit(patches(scene, map))).map(|means| means.geometric)
    }

    /// Linear Rec. 709 between 0 and 1, for a luminance in three channels, cd/m2.
    pub fn colour(&self, luminance_cd_m2: Rgb) -> [f64; 3] {
        let exposed = luminance_cd_m2 * self.exposure_m2_cd;
        let white = self.exposure_m2_cd * self.white_cd_m2;
        let x = exposed.luminance();
        if !x.is_finite() {
            return [1.0; 3];
        }
        let factor = (1.0 + x / (white * white)) / (1.0 + x);
        exposed.map(|c| (c * factor).clamp(0.0, 1.0)).0
    }
}

/// A piece of surface of one luminance.
struct Patch {
    area_m2: f64,
    luminance_cd_m2: f64,
}

/// Mean luminances over the area, cd/m2.
struct Means {
    area_m2: f64,
    arithmetic: f64,
    geometric: f64,
}

/// The patches that are not in the dark.
fn lit(mut patches: Vec<Patch>) -> Vec<Patch> {
    let area_m2: f64 = patches.iter().map(|p| p.area_m2).sum();
    let sum: f64 = patches.iter().map(|p| p.area_m2 * p.luminance_cd_m2).sum();
    let darkest = DARKEST_SHARE * sum / area_m2;
    patches.retain(|p| p.luminance_cd_m2 > darkest);
    patches
}

/// The means; `None` without light.
fn means(patches: &[Patch]) -> Option<Means> {
    let area_m2: f64 = patches.iter().map(|p| p.area_m2).sum();
    let sum: f64 = patches.iter().map(|p| p.area_m2 * p.luminance_cd_m2).sum();
    let arithmetic = sum / area_m2;
    if !(arithmetic > 0.0 && arithmetic.is_finite()) {
        return None;
    }
    let logarithm = |p: &Patch| p.area_m2 * libm::log(p.luminance_cd_m2);
    let geometric = libm::exp(patches.iter().map(logarithm).sum::<f64>() / area_m2);
    Some(Means { area_m2, arithmetic, geometric })
}

fn patches(scene: &Scene, map: &IlluminationMap) -> Vec<Patch> {
    let textures: Vec<Rgb> = scene.textures().iter().map(Texture::mean).collect();
    let elements = map.elements.elements();
    elements.iter().filter_map(|element| patch(scene, map, &textures, element)).collect()
}

fn patch(
    scene: &Scene,
    map: &IlluminationMap,
    textures: &[Rgb],
    element: &Element,
) -> Option<Patch> {
    let finish = scene.material(element.triangle).finish(element.back)?;
    let [a, b, c] = element.vertices.map(|v| map.elements.vertices()[v as usize].position);
    let known = element.vertices.iter().filter_map(|&v| map.read_at_vertex(v).and_then(storable));
    let (sum, count) = known.fold((Rgb::BLACK, 0.0), |(s, n), v| (s + v.total_lx(), n + 1.0));
    let texture = texture_of(scene, element.triangle, element.back);
    let texture = texture.map_or(Rgb::WHITE, |t| textures[t as usize]);
    let luminance = luminance_cd_m2(finish, sum / count) * texture;
    (count > 0.0).then(|| Patch {
        area_m2: 0.5 * (b - a).cross(c - a).length(),
        luminance_cd_m2: luminance.luminance(),
    })
}

/// Luminance of a surface without its texture, cd/m2: what it emits and `rho E / pi`, gloss counted
/// as if it were diffuse.
pub(super) fn luminance_cd_m2(finish: &Finish, illuminance_lx: Rgb) -> Rgb {
    reflectance(finish) * illuminance_lx / PI + finish.luminance_cd_m2
}

/// Without its texture, gloss counted as if it were diffuse.
pub(super) fn reflectance(finish: &Finish) -> Rgb {
    finish.diffuse.colour + finish.glossy_f0()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn black_is_black_white_is_white_and_nothing_leaves_the_range() {
        let preview = Preview { exposure_m2_cd: 0.01, white_cd_m2: 500.0 };
        assert_eq!(preview.colour(Rgb::BLACK), [0.0; 3]);
        let [white, ..] = preview.colour(Rgb::grey(500.0));
        assert!((white - 1.0).abs() < 1e-12, "four roundings of numbers near one: {white}");
        for luminance in [1e-300, 1.0, 1e6, 1e300] {
            for c in preview.colour(Rgb::new(luminance, 0.0, 0.5 * luminance)) {
                assert!((0.0..=1.0).contains(&c), "{luminance}: {c}");
            }
        }
    }

    #[test]
    fn what_is_in_the_dark_does_not_count() {
        let patch = |area_m2, luminance_cd_m2| Patch { area_m2, luminance_cd_m2 };
        let inside = || vec![patch(1.0, 50.0), patch(1.0, 200.0)];
        let alone = means(&lit(inside())).unwrap();
        let mut with_outside = inside();
        with_outside.extend([patch(3.0, 0.0), patch(3.0, 1e-3)]);
        let both = means(&lit(with_outside)).unwrap();
        assert!((alone.geometric - 100.0).abs() < 1e-9);
        assert_eq!((both.geometric, both.area_m2), (alone.geometric, alone.area_m2));
        assert!(means(&lit(vec![patch(1.0, 0.0)])).is_none());
    }

    #[test]
    fn brighter_is_never_darker() {
        let preview = Preview { exposure_m2_cd: 0.002, white_cd_m2: 900.0 };
        let shown: Vec<f64> =
            (0..1000).map(|k| preview.colour(Rgb::grey(f64::from(k)))[1]).collect();
        assert!(shown.is_sorted());
    }
}
