//! Materials of Radiance as materials of ours; the formulas are in this folder's README.

use super::light::luminance_cd_m2;
use super::record::Object;
use crate::lines::{At, Notes};
use isolux::scene::{Body, Dielectric, Finish, Gloss};
use isolux::units::Rgb;

/// Index of Radiance's `glass` where none is given.
const GLASS_INDEX: f64 = 1.52;
/// Roughness below which Radiance takes a surface as smooth: its square is below `FTINY`.
const SMOOTH: f64 = 1e-3;

/// What a surface of a material becomes.
#[derive(Clone, Debug, PartialEq)]
#[allow(clippy::large_enum_variant, reason = "one at a time, and most are bodies")]
pub(super) enum Made {
    /// Nothing is there.
    Invisible,
    /// A surface.
    Body(Body),
    /// A surface that shines into a cone.
    Spot(Spot),
}

/// A `spotlight`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Spot {
    pub(super) luminance_cd_m2: Rgb,
    /// Full angle of the cone.
    pub(super) angle_deg: f64,
    /// In world coordinates.
    pub(super) aim: [f64; 3],
}

/// Makes a material; `None` after a problem.
pub(super) fn make(object: &Object, at: &At, notes: &mut Notes) -> Option<Made> {
    let mut maker = Maker { object, at, notes };
    let made = match object.type_.as_str() {
        "plastic" => maker.reflecting(false),
        "metal" => maker.reflecting(true),
        "trans" => maker.trans(),
        "glass" => maker.glass(),
        "dielectric" => maker.dielectric(),
        "mirror" => maker.mirror(),
        "light" => maker.light(3),
        "illum" => maker.illum(),
        "glow" => maker.glow(),
        "spotlight" => maker.spotlight(),
        _ => Err("is not read".to_owned()),
    };
    made.map_err(|what| {
        let Object { type_, name, .. } = object;
        let what = format!("{type_} `{name}` {what}");
        let remedy = "use plastic, metal, trans, glass, dielectric, mirror, light, glow, spotlight \
                      or illum as the Radiance manual describes them, or refer to the file from a \
                      scene.toml that assigns a material";
        notes.problem(at, what, remedy);
    })
    .ok()
}

struct Maker<'a> {
    object: &'a Object,
    at: &'a At,
    notes: &'a mut Notes,
}

impl Maker<'_> {
    fn numbers<const N: usize>(&self) -> Result<[f64; N], String> {
        let numbers = &self.object.numbers;
        numbers[..]
            .try_into()
            .map_err(|_| format!("has {} real arguments where {N} are due", numbers.len()))
    }

    fn warn(&mut self, what: &str, remedy: &str) {
        let Object { type_, name, .. } = self.object;
        self.notes.warning(self.at, format!("{type_} `{name}` {what}"), remedy);
    }

    /// A colour of shares; what exceeds one is cut.
    fn share(&mut self, rgb: [f64; 3]) -> Result<Rgb, String> {
        if rgb.iter().any(|&c| c < 0.0) {
            return Err(format!("has a negative share of light in {rgb:?}"));
        }
        let cut = rgb.map(|c| c.min(1.0));
        if cut != rgb {
            self.warn(&format!("reflects or transmits {rgb:?}, cut at 1"), "write shares of light");
        }
        Ok(Rgb(cut))
    }

    fn fraction(what: &str, value: f64) -> Result<f64, String> {
        let is_share = (0.0..=1.0).contains(&value);
        is_share.then_some(value).ok_or_else(|| format!("has a {what} of {value}, not 0 to 1"))
    }

    /// Plastic and metal: a share `specular` of the light is mirrored or spread about the mirror's
    /// direction, uncoloured or coloured, and the rest reflected diffusely.
    fn reflecting(&mut self, metal: bool) -> Result<Made, String> {
        let [r, g, b, specular, roughness] = self.numbers()?;
        let colour = self.share([r, g, b])?;
        let specular = Self::fraction("specularity", specular)?;
        let tint = if metal { colour } else { Rgb::WHITE };
        let diffuse = colour * (1.0 - specular);
        self.opaque(diffuse, tint * specular, roughness)
    }

    fn opaque(&mut self, diffuse: Rgb, specular: Rgb, roughness: f64) -> Result<Made, String> {
        let alpha = Self::fraction("roughness", roughness)?;
        let mut finish = Finish::diffuse(diffuse);
        if alpha < SMOOTH {
            finish.mirror = specular;
        } else if !specular.is_black() {
            finish.gloss = Some(Gloss { f0: specular, alpha });
        }
        Ok(Made::Body(Body::Opaque { front: finish.clone(), back: finish }))
    }

    fn trans(&mut self) -> Result<Made, String> {
        let [r, g, b, specular, roughness, trans, clear] = self.numbers()?;
        let colour = self.share([r, g, b])?;
        let specular = Self::fraction("specularity", specular)?;
        let trans = Self::fraction("transmissivity", trans)?;
        let clear = Self::fraction("transmitted specularity", clear)?;
        let through = (1.0 - specular) * trans;
        if through == 0.0 {
            return self.opaque(colour * (1.0 - specular), Rgb::grey(specular), roughness);
        }
        if trans == 1.0 && clear == 1.0 && roughness < SMOOTH {
            if specular > 0.0 {
                let what = format!("is read as a clear film: it does not mirror its {specular}");
                self.warn(&what, "use glass where the reflection matters");
            }
            // Of index one it has no reflection of its own.
            let glass = Dielectric { ior: 1.0, transmittance: colour * through, thin: true };
            return Ok(Made::Body(Body::Dielectric(glass)));
        }
        let what = format!(
            "transmits a share of {:.4} of the light, which is absorbed here: its reflection alone is kept",
            colour.luminance() * through
        );
        let remedy = "nothing behind it is lit through it; use glass for clear sheets";
        self.warn(&what, remedy);
        let diffuse = colour * ((1.0 - specular) * (1.0 - trans));
        self.opaque(diffuse, Rgb::grey(specular), roughness)
    }

    fn glass(&mut self) -> Result<Made, String> {
        let (rgb, ior) = match self.object.numbers[..] {
            [r, g, b] => ([r, g, b], GLASS_INDEX),
            [r, g, b, ior] => ([r, g, b], ior),
            _ => return Err("does not have 3 or 4 real arguments".into()),
        };
        let transmittance = self.share(rgb)?;
        let ior = Self::index(ior)?;
        Ok(Made::Body(Body::Dielectric(Dielectric { ior, transmittance, thin: true })))
    }

    fn index(ior: f64) -> Result<f64, String> {
        (ior > 0.0).then_some(ior).ok_or_else(|| format!("has a refractive index of {ior}"))
    }

    fn dielectric(&mut self) -> Result<Made, String> {
        let [r, g, b, ior, hartmann] = self.numbers()?;
        let transmitted = self.share([r, g, b])?;
        if transmitted != Rgb::WHITE {
            let what = format!(
                "transmits {:?} of the light in each unit of length; this absorption is left out",
                transmitted.0
            );
            let remedy = "the body is read as clear; assign a `glass` of scene.toml whose \
                          transmittance fits its thickness";
            self.warn(&what, remedy);
        }
        if hartmann != 0.0 {
            self.warn("has a Hartmann constant: dispersion is left out", "set it to 0");
        }
        let ior = Self::index(ior)?;
        let glass = Dielectric { ior, transmittance: Rgb::WHITE, thin: false };
        Ok(Made::Body(Body::Dielectric(glass)))
    }

    fn mirror(&mut self) -> Result<Made, String> {
        let [r, g, b] = self.numbers()?;
        if let Some(other) = self.object.strings.first() {
            let what = format!("looks like `{other}` from afar; it is read as the mirror it is");
            self.warn(&what, "nothing needs to be done");
        }
        let finish = Finish::mirror(self.share([r, g, b])?);
        Ok(Made::Body(Body::Opaque { front: finish.clone(), back: finish }))
    }

    fn light(&mut self, count: usize) -> Result<Made, String> {
        let radiance = match self.object.numbers[..] {
            [r, g, b, ..] if self.object.numbers.len() == count => [r, g, b],
            _ => return Err(format!("does not have {count} real arguments")),
        };
        let front = Finish { luminance_cd_m2: Self::luminance(radiance)?, ..Finish::BLACK };
        Ok(Made::Body(Body::Opaque { front, back: Finish::BLACK }))
    }

    fn luminance(radiance: [f64; 3]) -> Result<Rgb, String> {
        if radiance.iter().any(|&c| c < 0.0) {
            return Err(format!("has a negative radiance in {radiance:?}"));
        }
        Ok(luminance_cd_m2(radiance))
    }

    fn illum(&mut self) -> Result<Made, String> {
        let made = self.light(3)?;
        let what = "is read as a light: what can be seen through it is hidden";
        self.warn(what, "remove it to calculate the light that it stands for");
        Ok(made)
    }

    fn glow(&mut self) -> Result<Made, String> {
        let made = self.light(4)?;
        if self.object.numbers[3] >= 0.0 {
            return Ok(made);
        }
        let what = "has a negative radius, which in Radiance lights nothing: it is read as black";
        self.warn(what, "give a radius of 0 or more if it is to give light");
        Ok(Made::Body(Body::Opaque { front: Finish::BLACK, back: Finish::BLACK }))
    }

    fn spotlight(&mut self) -> Result<Made, String> {
        let [r, g, b, angle_deg, x, y, z] = self.numbers()?;
        let luminance_cd_m2 = Self::luminance([r, g, b])?;
        if !(angle_deg > 0.0 && angle_deg <= 360.0) {
            return Err(format!("has a full angle of {angle_deg} degrees"));
        }
        if [x, y, z] == [0.0; 3] {
            return Err("has a direction of length zero".into());
        }
        Ok(Made::Spot(Spot { luminance_cd_m2, angle_deg, aim: [x, y, z] }))
    }
}
