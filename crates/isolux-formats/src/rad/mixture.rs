//! Mixtures of two materials, of whose function nothing is known but that it lies between 0 and 1: their mean.

use super::material::Made;
use isolux::scene::{Body, Dielectric, Finish, Gloss, Reflectance};
use isolux::units::Rgb;

/// Half of one and half of the other. Of what is not there the other is whole, because surfaces have no holes.
pub(super) fn mean(one: Made, other: Made) -> Result<Made, &'static str> {
    match (one, other) {
        (Made::Invisible, made) | (made, Made::Invisible) => Ok(made),
        (Made::Spot(_), _) | (_, Made::Spot(_)) => Err("mixes a spotlight"),
        (Made::Body(one), Made::Body(other)) => mean_body(one, other).map(Made::Body),
    }
}

fn mean_body(one: Body, other: Body) -> Result<Body, &'static str> {
    match (one, other) {
        (Body::Opaque { front, back }, Body::Opaque { front: other_front, back: other_back }) => {
            Ok(Body::Opaque {
                front: mean_finish(&front, &other_front),
                back: mean_finish(&back, &other_back),
            })
        }
        (Body::Dielectric(one), Body::Dielectric(other))
            if (one.ior, one.thin) == (other.ior, other.thin) =>
        {
            let transmittance = half(one.transmittance, other.transmittance);
            Ok(Body::Dielectric(Dielectric { transmittance, ..one }))
        }
        (Body::Dielectric(_), Body::Dielectric(_)) => Err("mixes two kinds of glass"),
        _ => Err("mixes what light passes with what it does not"),
    }
}

fn half(one: Rgb, other: Rgb) -> Rgb {
    (one + other) * 0.5
}

fn mean_finish(one: &Finish, other: &Finish) -> Finish {
    let colour = half(one.diffuse.colour, other.diffuse.colour);
    Finish {
        diffuse: Reflectance { colour, texture: None },
        mirror: half(one.mirror, other.mirror),
        gloss: mean_gloss(one.gloss, other.gloss),
        coat: None,
        luminance_cd_m2: half(one.luminance_cd_m2, other.luminance_cd_m2),
    }
}

/// The reflectance is the mean; the width that of the part that reflects more.
fn mean_gloss(one: Option<Gloss>, other: Option<Gloss>) -> Option<Gloss> {
    let f0 = |gloss: Option<Gloss>| gloss.map_or(Rgb::BLACK, |gloss| gloss.f0);
    let widest = if f0(one).luminance() < f0(other).luminance() { other } else { one };
    widest.map(|gloss| Gloss { f0: half(f0(one), f0(other)), ..gloss })
}
