//! From `bsdf` to what a surface is made of.

use super::fresnel::{conductor, dielectric, mean};
use super::property::{boolean, float, positive, string};
use super::record::{Element, Wrong};
use super::scope::Scope;
use super::spectrum::{Of, colour};
use super::substances;
use super::texture::{Paint, Picture, Pictures};
use isolux::geometry::Transform;
use isolux::scene::{Body, Dielectric, Finish, Gloss, Reflectance};
use isolux::units::Rgb;

/// What a surface is made of.
#[derive(Clone, Debug)]
pub(super) struct Made {
    /// `None` where there is nothing to see.
    pub(super) body: Option<Body>,
    /// Takes texture coordinates of the shape to those of its picture.
    pub(super) to_uv: Transform,
}

/// One side, and where its picture lies.
struct Side {
    finish: Finish,
    to_uv: Option<Transform>,
}

/// Materials one in the other.
const DEPTH: usize = 16;
/// Of a surface of which nothing is said.
pub(super) const USUAL: Rgb = Rgb::grey(0.5);
/// Facets so even that the reflection is a mirror's.
const SMOOTH: f64 = 1e-3;

/// What a `bsdf` is; `None` after a problem.
pub(super) fn make<'a>(
    bsdf: &'a Element,
    pictures: &mut Pictures,
    scope: &mut Scope<'a, '_>,
) -> Option<Made> {
    Maker { pictures, scope }.make(bsdf, 0)
}

struct Maker<'m, 'a, 'n> {
    pictures: &'m mut Pictures,
    scope: &'m mut Scope<'a, 'n>,
}

impl Side {
    fn one(self) -> Made {
        let back = Finish::BLACK;
        let body = Some(Body::Opaque { front: self.finish, back });
        Made { body, to_uv: self.to_uv.unwrap_or(Transform::IDENTITY) }
    }
}

impl<'a> Maker<'_, 'a, '_> {
    fn make(&mut self, bsdf: &'a Element, depth: usize) -> Option<Made> {
        if depth > DEPTH {
            self.scope.refuse(bsdf, "lies in too many others", "nest materials less");
            return None;
        }
        let made = match bsdf.kind() {
            "diffuse" => self.diffuse(bsdf).map(Side::one),
            "conductor" | "roughconductor" => self.metal(bsdf).map(Side::one),
            "plastic" | "roughplastic" => self.plastic(bsdf).map(Side::one),
            "principled" => self.principled(bsdf).map(Side::one),
            "dielectric" | "thindielectric" => self.glass(bsdf),
            "null" => Some(Made { body: None, to_uv: Transform::IDENTITY }),
            "twosided" => self.two_sided(bsdf, depth),
            "mask" => self.mask(bsdf, depth),
            "bumpmap" | "normalmap" => {
                self.scope.warn(
                    bsdf,
                    "is left out: the surface is smooth",
                    "model its shape where it matters",
                );
                bsdf.children.iter().filter(|c| c.tag != "bsdf").for_each(|c| c.is_used.set(true));
                self.inner(bsdf, depth)
            }
            _ => {
                let remedy = "use diffuse, conductor, dielectric, plastic, their rough or thin forms, \
                              principled or twosided";
                self.scope.refuse(bsdf, "is not read", remedy);
                None
            }
        };
        self.scope.finish(bsdf);
        made
    }

    /// The one material that another holds.
    fn inner(&mut self, bsdf: &'a Element, depth: usize) -> Option<Made> {
        match self.scope.objects(bsdf, "bsdf")[..] {
            [inner] => self.make(inner, depth + 1),
            _ => {
                self.scope.refuse(bsdf, "does not hold one bsdf", "give it one");
                None
            }
        }
    }

    fn two_sided(&mut self, bsdf: &'a Element, depth: usize) -> Option<Made> {
        let inner = self.scope.objects(bsdf, "bsdf");
        if inner.is_empty() || inner.len() > 2 {
            self.scope.refuse(bsdf, "does not hold one or two bsdfs", "give it one for each side");
            return None;
        }
        let mut sides = Vec::new();
        for side in inner {
            let made = self.make(side, depth + 1)?;
            let Some(Body::Opaque { front, .. }) = made.body else {
                self.scope.refuse(bsdf, "holds what light passes", "use it without `twosided`");
                return None;
            };
            sides.push((front, made.to_uv));
        }
        let (front, to_uv) = sides.remove(0);
        let (back, other) = sides.pop().unwrap_or_else(|| (front.clone(), to_uv));
        if back.diffuse.texture.is_some() && other != to_uv {
            self.scope.warn(
                bsdf,
                "lays the picture of its back as that of its front",
                "use one `to_uv`",
            );
        }
        Some(Made { body: Some(Body::Opaque { front, back }), to_uv })
    }

    fn mask(&mut self, bsdf: &'a Element, depth: usize) -> Option<Made> {
        let opacity = self.pictures.paint(bsdf, "opacity", USUAL, self.scope)?;
        let made = self.inner(bsdf, depth)?;
        if opacity.picture.is_none() && opacity.colour.is_black() {
            return Some(Made { body: None, ..made });
        }
        if opacity.picture.is_some() || opacity.colour.min_channel() < 1.0 {
            self.scope.warn(
                bsdf,
                "lets light through its gaps, which is left out",
                "cut the gaps out of the shape",
            );
        }
        Some(made)
    }

    /// A colour of which no channel is above what is left of the light.
    fn share(&mut self, bsdf: &'a Element, slot: &str, usual: Rgb) -> Option<Paint> {
        let mut paint = self.pictures.paint(bsdf, slot, usual, self.scope)?;
        if paint.colour.max_channel() > 1.0 {
            self.scope.warn(
                bsdf,
                &format!("has a `{slot}` above 1, which is cut"),
                "write shares of the light",
            );
            paint.colour = paint.colour.map(|c| c.min(1.0));
        }
        Some(paint)
    }

    /// A colour without a picture.
    fn plain(&mut self, bsdf: &'a Element, slot: &str, usual: Rgb) -> Option<Rgb> {
        let paint = self.share(bsdf, slot, usual)?;
        if paint.picture.is_some() {
            self.scope.warn(
                bsdf,
                &format!("has a texture as `{slot}`: its mean is taken"),
                "nothing needs to be done where its mean will do",
            );
        }
        Some(paint.colour)
    }

    fn diffuse(&mut self, bsdf: &'a Element) -> Option<Side> {
        let paint = self.share(bsdf, "reflectance", USUAL)?;
        Some(side(&paint, 1.0))
    }

    fn metal(&mut self, bsdf: &'a Element) -> Option<Side> {
        let [f0, mean] = self.metal_reflectances(bsdf)?;
        let factor = self.plain(bsdf, "specular_reflectance", Rgb::WHITE)?;
        let alpha = self.alpha(bsdf)?;
        let finish = match alpha {
            None => Finish::mirror(mean * factor),
            Some(alpha) => {
                Finish { gloss: Some(Gloss { f0: f0 * factor, alpha }), ..Finish::BLACK }
            }
        };
        Some(Side { finish, to_uv: None })
    }

    /// At normal incidence, and in the mean over the hemisphere.
    fn metal_reflectances(&mut self, bsdf: &'a Element) -> Option<[Rgb; 2]> {
        let given = |slot: &str| bsdf.child(slot).map(|child| (child, colour(child, Of::Surface)));
        let (eta, k) = match (given("eta"), given("k")) {
            (Some((at_eta, eta)), Some((at_k, k))) => {
                let eta = self.scope.take(&at_eta.at, eta);
                let k = self.scope.take(&at_k.at, k);
                (eta?.0, k?.0)
            }
            (None, None) => {
                let name = string(bsdf, "material").unwrap_or("Cu");
                if name == "none" {
                    return Some([Rgb::WHITE; 2]);
                }
                let Some(found) = substances::metal(name) else {
                    let remedy = format!(
                        "give `eta` and `k` as rgb, or one of none, {}",
                        substances::metals()
                    );
                    self.scope.refuse(
                        bsdf,
                        &format!("is of `{name}`, which is not known"),
                        &remedy,
                    );
                    return None;
                };
                found
            }
            _ => {
                self.scope.refuse(bsdf, "has one of `eta` and `k`", "give both, or `material`");
                return None;
            }
        };
        let at = |channel: usize, cos: f64| conductor(cos, eta[channel], k[channel]);
        let f0 = Rgb(std::array::from_fn(|channel| at(channel, 1.0)));
        let mean = Rgb(std::array::from_fn(|channel| mean(|cos| at(channel, cos))));
        // A metal of index 0 reflects 0 / 0.
        if !(f0.is_finite() && mean.is_finite()) {
            self.scope.refuse(bsdf, "has no reflectance", "give positive `eta` and `k`");
            return None;
        }
        Some([f0, mean])
    }

    /// The width of the facets of a rough form; `Some(None)` of a smooth one.
    fn alpha(&mut self, bsdf: &'a Element) -> Option<Option<f64>> {
        if !bsdf.kind().starts_with("rough") {
            return Some(None);
        }
        string(bsdf, "distribution");
        string(bsdf, "sample_visible");
        let read = |name: &str| float(bsdf, name);
        let both = self.scope.take(&bsdf.at, read("alpha"))?;
        let u = self.scope.take(&bsdf.at, read("alpha_u"))?;
        let v = self.scope.take(&bsdf.at, read("alpha_v"))?;
        let alpha = match (u, v) {
            (Some(u), Some(v)) if u != v => {
                self.scope.warn(
                    bsdf,
                    "is brushed: it is read as equally rough in all directions",
                    "use one `alpha`",
                );
                (u * v).max(0.0).sqrt()
            }
            (Some(alpha), _) | (None, Some(alpha)) => alpha,
            (None, None) => both.unwrap_or(0.1),
        };
        if !(0.0..=1.0).contains(&alpha) {
            self.scope.refuse(
                bsdf,
                &format!("has the roughness {alpha}"),
                "give `alpha` from 0 to 1",
            );
            return None;
        }
        Some((alpha >= SMOOTH).then_some(alpha))
    }

    /// The index inside over the one outside.
    fn index(&mut self, bsdf: &'a Element, inside: &str) -> Option<f64> {
        let inner = self.scope.take(&bsdf.at, ior(bsdf, "int_ior", inside))?;
        let outer = self.scope.take(&bsdf.at, ior(bsdf, "ext_ior", "air"))?;
        Some(inner / outer)
    }

    fn glass(&mut self, bsdf: &'a Element) -> Option<Made> {
        let ior = self.index(bsdf, "bk7")?;
        let transmittance = self.plain(bsdf, "specular_transmittance", Rgb::WHITE)?;
        let reflectance = self.plain(bsdf, "specular_reflectance", Rgb::WHITE)?;
        if reflectance != Rgb::WHITE {
            self.scope.warn(
                bsdf,
                "has a `specular_reflectance`, which is left out",
                "leave it out: Fresnel's equations hold",
            );
        }
        let thin = bsdf.kind() == "thindielectric";
        let body = Some(Body::Dielectric(Dielectric { ior, transmittance, thin }));
        Some(Made { body, to_uv: Transform::IDENTITY })
    }

    /// A diffuse base under a clear coat: what the coat lets in and, after reflections within, out.
    fn plastic(&mut self, bsdf: &'a Element) -> Option<Side> {
        let ior = self.index(bsdf, "polypropylene")?;
        let paint = self.share(bsdf, "diffuse_reflectance", USUAL)?;
        let factor = self.plain(bsdf, "specular_reflectance", Rgb::WHITE)?;
        let nonlinear = self.scope.take(&bsdf.at, boolean(bsdf, "nonlinear", false))?;
        let alpha = self.alpha(bsdf)?;
        let outer = mean(|cos| dielectric(cos, ior));
        let inner = mean(|cos| dielectric(cos, 1.0 / ior));
        let (paint, share) = if nonlinear {
            if paint.picture.is_some() {
                self.scope.warn(
                    bsdf,
                    "is `nonlinear` under a texture, which is left out",
                    "nothing needs to be done: only its saturation changes",
                );
                (paint, 1.0 - outer)
            } else {
                let colour = paint.colour.map(|d| (1.0 - inner) * d / (1.0 - d * inner));
                (Paint { colour, picture: None }, 1.0 - outer)
            }
        } else {
            (paint, 1.0 - outer)
        };
        let mut made = side(&paint, share);
        match alpha {
            None => made.finish.mirror = factor * outer,
            Some(alpha) => {
                made.finish.gloss = Some(Gloss { f0: factor * dielectric(1.0, ior), alpha });
            }
        }
        Some(made)
    }

    fn principled(&mut self, bsdf: &'a Element) -> Option<Side> {
        let paint = self.share(bsdf, "base_color", USUAL)?;
        let mut read = |name: &str, usual: f64| {
            let value = float(bsdf, name).map(|value| value.unwrap_or(usual));
            self.scope.take(&bsdf.at, value)
        };
        let (metallic, roughness) = (read("metallic", 0.0)?, read("roughness", 0.5)?);
        let (specular, transmission) = (read("specular", 0.5)?, read("spec_trans", 0.0)?);
        if transmission > 0.0 {
            self.scope.refuse(bsdf, "transmits light", "use a dielectric");
            return None;
        }
        let are_shares = [metallic, roughness, specular].iter().all(|x| (0.0..=1.0).contains(x));
        if !are_shares {
            self.scope.refuse(bsdf, "has a property that is not between 0 and 1", "correct it");
            return None;
        }
        self.scope.warn(bsdf, "is read as a diffuse part and GGX gloss of its base colour, metallic, specular and roughness", "use diffuse, plastic or conductor where its look matters");
        let coat = 0.08 * specular * (1.0 - metallic);
        let f0 = Rgb::grey(coat) + paint.colour * metallic;
        let mut made = side(&paint, (1.0 - metallic) * (1.0 - coat));
        let alpha = roughness * roughness;
        if alpha < SMOOTH {
            made.finish.mirror = f0;
        } else if !f0.is_black() {
            made.finish.gloss = Some(Gloss { f0, alpha });
        }
        Some(made)
    }
}

/// A diffuse side that keeps a share of what its paint reflects.
fn side(paint: &Paint, share: f64) -> Side {
    let texture = paint.picture.map(|Picture { index, .. }| index);
    let colour = if texture.is_some() { Rgb::WHITE } else { paint.colour };
    let diffuse = Reflectance { colour: colour * share, texture };
    let finish = Finish { diffuse, ..Finish::BLACK };
    Side { finish, to_uv: paint.picture.map(|picture| picture.to_uv) }
}

/// A refractive index, by number or by name.
fn ior(bsdf: &Element, slot: &str, usual: &str) -> Result<f64, Wrong> {
    let named = |name: &str| {
        let unknown =
            || (format!("there is no substance `{name}`"), "give its refractive index as a float");
        substances::index(name).ok_or_else(unknown)
    };
    match bsdf.child(slot) {
        None => named(usual),
        Some(child) if child.tag == "string" => named(child.attribute("value").unwrap_or_default()),
        Some(_) => positive(bsdf, slot, 1.0),
    }
}
