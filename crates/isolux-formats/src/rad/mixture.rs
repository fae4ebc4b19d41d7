//! Mixtures of two materials: by the share that a number gives, else their mean, as of a function nothing is known but that it lies
//! between 0 and 1.

use super::material::Made;
use isolux::scene::{Body, Dielectric, Finish, Gloss, Reflectance};
use isolux::units::Rgb;

/// A share of one and the rest of the other. Of what is not there the other is whole, because surfaces have no holes.
pub(super) fn mixed(one: Made, other: Made, share: f64) -> Result<Made, &'static str> {
    let mix = Mix(share);
    match (one, other) {
        (Made::Invisible, made) | (made, Made::Invisible) => Ok(made),
        (Made::Spot(_), _) | (_, Made::Spot(_)) => Err("mixes a spotlight"),
        (Made::Body(one), Made::Body(other)) => mix.body(one, other).map(Made::Body),
    }
}

/// The share of the first.
struct Mix(f64);

impl Mix {
    fn body(&self, one: Body, other: Body) -> Result<Body, &'static str> {
        match (one, other) {
            (
                Body::Opaque { front, back },
                Body::Opaque { front: other_front, back: other_back },
            ) => Ok(Body::Opaque {
                front: self.finish(&front, &other_front),
                back: self.finish(&back, &other_back),
            }),
            (Body::Dielectric(one), Body::Dielectric(other))
                if (one.ior, one.thin) == (other.ior, other.thin) =>
            {
                let transmittance = self.colour(one.transmittance, other.transmittance);
                Ok(Body::Dielectric(Dielectric { transmittance, ..one }))
            }
            (Body::Dielectric(_), Body::Dielectric(_)) => Err("mixes two kinds of glass"),
            _ => Err("mixes what light passes with what it does not"),
        }
    }

    fn colour(&self, one: Rgb, other: Rgb) -> Rgb {
        one * self.0 + other * (1.0 - self.0)
    }

    fn finish(&self, one: &Finish, other: &Finish) -> Finish {
        let colour = self.colour(one.diffuse.colour, other.diffuse.colour);
        Finish {
            diffuse: Reflectance { colour, texture: None },
            mirror: self.colour(one.mirror, other.mirror),
            gloss: self.gloss(one.gloss, other.gloss),
            coat: None,
            luminance_cd_m2: self.colour(one.luminance_cd_m2, other.luminance_cd_m2),
        }
    }

    /// The reflectance is mixed; the width that of the part that reflects more.
    fn gloss(&self, one: Option<Gloss>, other: Option<Gloss>) -> Option<Gloss> {
        let f0 = |gloss: Option<Gloss>| gloss.map_or(Rgb::BLACK, |gloss| gloss.f0);
        let widest = if f0(one).luminance() < f0(other).luminance() { other } else { one };
        widest.map(|gloss| Gloss { f0: self.colour(f0(one), f0(other)), ..gloss })
    }
}
