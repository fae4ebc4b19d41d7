//! A clear coat over gloss: two lobes, the lower attenuated by the upper on both ways.

use super::gloss::{ANGLES_DEG, incoming, place};
use super::*;
use crate::engine::ray::{specular_share, specular_step};
use crate::sampling::Ggx;
use crate::scene::{Body, Coat, Gloss};
use isolux_geometry::Direction;
use std::f64::consts::PI;

/// Cosine of the cone about the mirror direction that tells a narrow lobe from a wide one: 15 degrees.
const CONE_COS: f64 = 0.965_925_826_289_068_3;

fn coated(diffuse: f64, gloss: Option<(f64, f64)>, coat: Coat) -> Finish {
    let gloss = gloss.map(|(f0, alpha)| Gloss { f0: Rgb::grey(f0), alpha });
    Finish { gloss, coat: Some(coat), ..Finish::diffuse(Rgb::grey(diffuse)) }
}

fn schlick(f0: f64, cos: f64) -> f64 {
    f0 + (1.0 - f0) * libm::pow(1.0 - cos, 5.0)
}

/// Reflectance of both lobes by the midpoint rule over directions of reflection, each with its own distribution (Walter
/// et al. 2007, eq. 20): `c F D G / (4 cos)` of the coat, and that of the base times `1 - c F` at the angle of either
/// direction (KHR_materials_clearcoat, with Schlick's F of an index of 1.5). Of all directions, and of those within the
/// cone.
fn by_quadrature(finish: &Finish, view: Vector) -> [f64; 2] {
    let (rings, sectors) = (600, 600);
    let coat = finish.coat.unwrap();
    let through = |cos: f64| 1.0 - coat.cover * schlick(0.04, cos);
    let mirrored = Vector::new(-view.x, -view.y, view.z);
    let mut sums = [0.0; 2];
    for i in 0..rings {
        let z = (f64::from(i) + 0.5) / f64::from(rings);
        for j in 0..sectors {
            let (s, c) = libm::sincos(2.0 * PI * (f64::from(j) + 0.5) / f64::from(sectors));
            let sine = (1.0 - z * z).sqrt();
            let out = Vector::new(sine * c, sine * s, z);
            let half = (view + out).direction().unwrap().to_vector();
            let lobe = |alpha: f64| {
                let ggx = Ggx { alpha };
                ggx.distribution(half) * ggx.masking(view) * ggx.masking(out) / (4.0 * view.z)
            };
            let cos = half.dot(view);
            let mut value = coat.cover * schlick(0.04, cos) * lobe(coat.alpha);
            if let Some(Gloss { f0, alpha }) = finish.gloss {
                value += schlick(f0.0[1], cos) * lobe(alpha) * through(view.z) * through(z);
            }
            sums[0] += value;
            sums[1] += if out.dot(mirrored) > CONE_COS { value } else { 0.0 };
        }
    }
    sums.map(|sum| sum * 2.0 * PI / f64::from(rings * sectors))
}

/// Mean weight after one step with roulette, and its standard error, of the steps into some directions.
fn reflected(finish: &Finish, angle_deg: f64, into: impl Fn(Direction) -> bool) -> (f64, f64) {
    let body = Body::Opaque { front: finish.clone(), back: Finish::BLACK };
    let incoming = incoming(angle_deg);
    mean_and_error((0..20_000).map(|k| {
        let mut dice = Dice::new(Sequence::new(Key::new(k)), 0);
        let step = specular_step(&body, &place(), incoming, Rgb::WHITE, &mut dice);
        step.filter(|step| into(step.direction)).map_or(0.0, |step| step.weight.0[1])
    }))
}

#[test]
fn coat_and_base_reflect_what_their_distributions_say() {
    // A varnished rough metal, one covered by half, a rough coat on a smoother metal, a coat on black.
    for (gloss, coat) in [
        (Some((0.9, 0.6)), Coat { cover: 1.0, alpha: 0.1 }),
        (Some((0.7, 0.8)), Coat { cover: 0.5, alpha: 0.3 }),
        (Some((1.0, 0.25)), Coat { cover: 1.0, alpha: 1.0 }),
        (None, Coat { cover: 1.0, alpha: 0.4 }),
    ] {
        let finish = coated(0.0, gloss, coat);
        for angle_deg in [0.0, 25.0, 50.0, 70.0, 84.0] {
            let view = (-incoming(angle_deg)).to_vector();
            let mirrored = incoming(angle_deg).reflect(place().shading);
            let expected = by_quadrature(&finish, view);
            let all = reflected(&finish, angle_deg, |_| true);
            let near = reflected(&finish, angle_deg, |d| d.dot(mirrored) > CONE_COS);
            for ((mean, error), expected) in [all, near].into_iter().zip(expected) {
                // Of the whole the rule is good to 1e-3; the border of the cone cuts through its cells.
                let allowed = SIGMAS * error + 4e-3 * expected;
                assert!(
                    (mean - expected).abs() < allowed,
                    "{gloss:?} {coat:?} {angle_deg}: {mean} for {expected}"
                );
            }
        }
    }
}

/// In a furnace nothing gets brighter, however little room diffuse reflection leaves for both.
#[test]
fn coats_do_not_gain_energy() {
    for (name, finish) in [
        ("white metal", coated(0.0, Some((1.0, 0.1)), Coat { cover: 1.0, alpha: 0.05 })),
        ("rough", coated(0.0, Some((1.0, 0.4)), Coat { cover: 1.0, alpha: 1.0 })),
        ("varnish on white", coated(0.836, Some((0.04, 0.5)), Coat { cover: 1.0, alpha: 0.01 })),
        ("little room", coated(0.92, Some((0.04, 1.0)), Coat { cover: 1.0, alpha: 1.0 })),
        ("half", coated(0.5, Some((0.3, 0.2)), Coat { cover: 0.5, alpha: 0.3 })),
    ] {
        for angle_deg in ANGLES_DEG {
            let (specular, error) = reflected(&finish, angle_deg, |_| true);
            let whole = finish.diffuse.colour.0[1] + specular;
            assert!(whole < 1.0 + SIGMAS * error + 1e-12, "{name} {angle_deg}: {whole}");
        }
    }
}

/// The same whichever way light goes.
#[test]
fn what_passes_a_coat_is_reciprocal() {
    let finish = coated(0.3, Some((0.6, 0.3)), Coat { cover: 0.8, alpha: 0.1 });
    for [a, b] in [[1.0, 0.1], [0.7, 0.05], [0.3, 0.9]] {
        assert_eq!(finish.through_coat([a, b]), finish.through_coat([b, a]));
        assert_eq!(finish.gloss_limit([a, b]), finish.gloss_limit([b, a]));
    }
}

/// Without a coat nothing is said of one, and nothing is taken from what lies below.
#[test]
fn no_coat_is_no_coat() {
    let coat = Coat { cover: 1.0, alpha: 0.2 };
    let with = coated(0.2, Some((0.5, 0.3)), coat);
    let without = Finish { coat: None, ..with.clone() };
    assert!(!serde_json::to_string(&without).unwrap().contains("coat"));
    assert_eq!(without.through_coat([0.1, 0.9]), 1.0);
    assert_eq!(without.gloss_limit([0.1, 0.9]), Rgb::WHITE - Rgb::grey(0.2));
    assert_eq!(without.glossy_f0(), Rgb::grey(0.5));
    assert!((with.glossy_f0().0[0] - (0.04 + 0.96 * 0.96 * 0.5)).abs() < 1e-15);
    for angle_deg in ANGLES_DEG {
        let [more, less] =
            [&with, &without].map(|finish| specular_share(finish, &place(), incoming(angle_deg)));
        assert!(less > 0.0 && more > 0.0);
    }
}
