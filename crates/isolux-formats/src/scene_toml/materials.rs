//! Materials.

use super::context::Context;
use super::quantity::Colour;
use super::record::{CoatRecord, FinishRecord, GlassRecord, GlossRecord, MaterialRecord, Sided};
use super::spans::{At, Span};
use isolux::scene::{Body, Coat, Dielectric, Finish, Gloss, Material, Reflectance, SceneParts};
use isolux::units::Rgb;
use std::collections::HashMap;
use std::path::PathBuf;

/// Window glass.
const USUAL_INDEX: f64 = 1.5;
/// Reflectances may exceed one by this much: the rounding of decimal fractions.
const ENERGY_ROUNDING: f64 = 1e-6;

/// The materials of the scene by name.
#[derive(Debug, Default)]
pub(super) struct Palette {
    of_name: HashMap<String, Swatch>,
}

#[derive(Debug)]
struct Swatch {
    index: u32,
    at: Span,
    is_used: bool,
}

impl Palette {
    /// Makes the materials of the file. One that is wrong keeps its place and its name.
    pub(super) fn resolve(
        records: Vec<(At<String>, Option<MaterialRecord>)>,
        scene: &mut SceneParts,
        context: &mut Context,
    ) -> Self {
        let mut palette = Self::default();
        let mut pictures = HashMap::new();
        for (name, record) in records {
            let at = name.span();
            let name = name.into_inner();
            let body = record.and_then(|record| {
                Maker { scene, pictures: &mut pictures, context }.body(&name, &at, record)
            });
            let index = scene.materials.len() as u32;
            scene.materials.push(match body {
                Some(body) => Material { name: name.clone(), body },
                None => Material::two_sided(name.clone(), Finish::BLACK),
            });
            palette.of_name.insert(name, Swatch { index, at, is_used: false });
        }
        palette
    }

    /// The index of a material that geometry names.
    pub(super) fn index_of(&mut self, name: &At<String>, context: &mut Context) -> Option<u32> {
        if let Some(swatch) = self.of_name.get_mut(name.get_ref()) {
            swatch.is_used = true;
            return Some(swatch.index);
        }
        let what = format!("there is no material `{}`", name.get_ref());
        let remedy = format!("define it: [materials.{:?}]", name.get_ref());
        context.problem(&name.span(), what, remedy);
        None
    }

    /// Warns of materials that nothing is made of.
    pub(super) fn warn_of_unused(&self, context: &mut Context) {
        let mut unused: Vec<_> = self.of_name.iter().filter(|(_, s)| !s.is_used).collect();
        unused.sort_by_key(|(_, swatch)| swatch.at.start);
        for (name, swatch) in unused {
            let what = format!("nothing is made of material `{name}`");
            context.warning(&swatch.at, what, "assign it to geometry, or remove it");
        }
    }
}

/// What making one material needs.
struct Maker<'a> {
    scene: &'a mut SceneParts,
    pictures: &'a mut HashMap<PathBuf, u32>,
    context: &'a mut Context,
}

impl Maker<'_> {
    fn body(&mut self, name: &str, at: &Span, mut record: MaterialRecord) -> Option<Body> {
        let front = record.take_front();
        let MaterialRecord { sided, back, glass, .. } = record;
        if let Some(glass) = glass {
            if !front.is_empty() || back.is_some() || sided.is_some() {
                let what = format!("material `{name}` is glass and has an opaque property too");
                self.context.problem(at, what, "keep `glass` alone, or remove it");
                return None;
            }
            return self.glass(&glass).map(Body::Dielectric);
        }
        if front.is_empty() {
            let what = format!("material `{name}` has no property");
            let remedy = "give `diffuse`, `mirror`, `gloss`, `coat`, `texture`, `luminance_cd_m2` or `glass`";
            self.context.problem(at, what, remedy);
            return None;
        }
        if let (Some(sided), Some(_)) = (&sided, &back) {
            let what = format!("material `{name}` has `sided` and a `back`");
            self.context.problem(&sided.span(), what, "give one of them");
        }
        let front = self.finish(name, at, &front);
        let back = match (back, sided.map(At::into_inner)) {
            (Some(back), _) => self.finish(name, &back.span(), back.get_ref()),
            (None, Some(Sided::One)) => Some(Finish::BLACK),
            (None, Some(Sided::Two) | None) => front.clone(),
        };
        Some(Body::Opaque { front: front?, back: back? })
    }

    fn glass(&mut self, record: &At<GlassRecord>) -> Option<Dielectric> {
        let GlassRecord { ior, thin, transmittance } = record.get_ref();
        let transmittance = self.share("transmittance", transmittance.as_ref(), Rgb::WHITE)?;
        Some(Dielectric { ior: ior.map_or(USUAL_INDEX, |n| n.0), transmittance, thin: *thin })
    }

    fn finish(&mut self, name: &str, at: &Span, record: &FinishRecord) -> Option<Finish> {
        let untinted = if record.texture.is_some() { Rgb::WHITE } else { Rgb::BLACK };
        let colour = self.share("diffuse reflectance", record.diffuse.as_ref(), untinted);
        let mirror = self.share("mirror reflectance", record.mirror.as_ref(), Rgb::BLACK);
        let gloss = record.gloss.as_ref().map(|gloss| self.gloss(gloss.get_ref()));
        let texture = record.texture.as_ref().map(|file| self.texture(file));
        let (colour, mirror) = (colour?, mirror?);
        let gloss = transpose(gloss)?;
        let coat = transpose(record.coat.as_ref().map(|coat| self.coat(coat)))?;
        if let (Some(at), false) = (&record.coat, mirror.is_black()) {
            let what = format!("material `{name}` has a coat over a mirror");
            self.context.problem(
                &at.span(),
                what,
                "use `gloss` of a small roughness in place of `mirror`",
            );
            return None;
        }
        let diffuse = Reflectance { colour, texture: None };
        let finish = Finish { diffuse, mirror, gloss, coat, ..Finish::BLACK };
        let sum = colour + mirror + finish.glossy_f0();
        if sum.max_channel() > 1.0 + ENERGY_ROUNDING {
            let what = format!(
                "material `{name}` reflects {:.3} of the light it receives",
                sum.max_channel()
            );
            let remedy = "lower `diffuse` (1 under a texture unless given), `mirror` or `gloss.f0` \
                          until they, and 0.04 of a coat, sum to at most 1";
            self.context.problem(at, what, remedy);
            return None;
        }
        let luminance_cd_m2 = record.luminance_cd_m2.as_ref().map_or(Rgb::BLACK, |l| l.get_ref().0);
        let diffuse = Reflectance { colour, texture: transpose(texture)? };
        Some(Finish { diffuse, luminance_cd_m2, ..finish })
    }

    fn coat(&mut self, record: &At<CoatRecord>) -> Option<Coat> {
        let CoatRecord { cover, roughness } = record.get_ref();
        let alpha = roughness.get_ref().0 * roughness.get_ref().0;
        let cover = cover.as_ref().map_or(1.0, |cover| cover.get_ref().0);
        if alpha == 0.0 || cover == 0.0 {
            let what = "a coat of roughness or cover 0";
            let remedy =
                "give a small roughness for a smooth coat, and leave one out that covers nothing";
            self.context.problem(&record.span(), what, remedy);
            return None;
        }
        Some(Coat { cover, alpha })
    }

    fn gloss(&mut self, record: &GlossRecord) -> Option<Gloss> {
        let f0 = self.share("reflectance at normal incidence", Some(&record.f0), Rgb::BLACK)?;
        let roughness = record.roughness.get_ref().0;
        if roughness * roughness == 0.0 {
            let what = "gloss of roughness 0";
            self.context.problem(&record.roughness.span(), what, "use `mirror`");
            return None;
        }
        Some(Gloss { f0, alpha: roughness * roughness })
    }

    fn share(&mut self, what: &str, value: Option<&At<Colour>>, absent: Rgb) -> Option<Rgb> {
        let Some(value) = value else { return Some(absent) };
        let Colour(colour) = *value.get_ref();
        if colour.max_channel() > 1.0 {
            let what = format!("{what} {} is above 1", colour.max_channel());
            self.context.problem(&value.span(), what, "write shares of the light: 50 % is 0.5");
            return None;
        }
        Some(colour)
    }

    fn texture(&mut self, file: &At<String>) -> Option<u32> {
        let path = self.context.path_of(&file.span(), file.get_ref())?;
        if let Some(&known) = self.pictures.get(&path) {
            return Some(known);
        }
        match self.context.pictures.read(&path) {
            Ok(texture) => {
                let index = self.scene.textures.len() as u32;
                self.scene.textures.push(texture);
                self.pictures.insert(path, index);
                Some(index)
            }
            Err(problem) => {
                let what = format!("`{}` {}", file.get_ref(), problem.what);
                self.context.problem(&file.span(), what, problem.remedy);
                None
            }
        }
    }
}

/// `None` if something was asked for and is wrong; `Some(None)` if nothing was asked for.
fn transpose<T>(asked: Option<Option<T>>) -> Option<Option<T>> {
    match asked {
        None => Some(None),
        Some(made) => made.map(Some),
    }
}
