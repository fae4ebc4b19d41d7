//! The same surfaces in other light.

use super::{Body, Finish, Fitting, Luminaire, LuminaireKind, Maintenance, Material, Scene};
use crate::photometry::{IntensityDistribution, PhotometricWeb};
use crate::units::Rgb;
use std::sync::Arc;

/// The group of surfaces that shine, and of light that names none.
const UNGROUPED: u32 = 0;

impl Scene {
    /// The same scene with the light of one group alone; surfaces that shine are in the first. `None` where
    /// there is no such light.
    pub fn lit_by(&self, group: u32) -> Option<Self> {
        let all = self.luminaires().iter().zip(self.fittings());
        let (luminaires, fittings): (Vec<Luminaire>, Vec<Fitting>) =
            all.filter(|(l, _)| l.group == group).map(|(l, of)| (l.clone(), *of)).unzip();
        let shine = if group == UNGROUPED { 1.0 } else { 0.0 };
        let materials = self.materials().iter().map(|m| shining(m, [(m, shine)])).collect();
        let scene = self.relit(luminaires, self.groups().to_vec(), materials).fitted(fittings);
        let is_lit = !scene.luminaires().is_empty() || !scene.area_luminaires().is_empty();
        is_lit.then_some(scene)
    }

    /// The same surfaces in the light of one luminaire alone.
    #[must_use]
    pub fn below(&self, luminaire: Luminaire) -> Self {
        let materials = self.materials().iter().map(|m| shining(m, [(m, 0.0)])).collect();
        self.relit(vec![Luminaire { group: 0, ..luminaire }], Vec::new(), materials)
    }

    /// The same surfaces, which reflect and emit nothing, in the light of emergency lighting alone; `None` if no luminaire is part
    /// of that.
    pub fn in_emergency(&self) -> Option<Self> {
        let share = |(luminaire, fitting): (&Luminaire, &Fitting)| {
            let mut dimmer = Dimmer { factor: fitting.emergency_share?, webs: Vec::new() };
            let kind = dimmer.dimmed(&luminaire.kind);
            Some((Luminaire { kind, ..luminaire.clone() }, *fitting))
        };
        let all = self.luminaires().iter().zip(self.fittings()).filter_map(share);
        let (luminaires, fittings): (Vec<Luminaire>, Vec<Fitting>) = all.unzip();
        let is_lit = !luminaires.is_empty();
        let materials = self.materials().iter().map(black).collect();
        is_lit.then(|| self.relit(luminaires, self.groups().to_vec(), materials).fitted(fittings))
    }

    /// The surfaces of the first of several scenes in the light of all of them, each times a factor >= 0.
    /// They must have the same [`Scene::surfaces_hash`]. Groups are told apart by name; the light of a
    /// scene without groups is in one named after it.
    ///
    /// # Panics
    ///
    /// Without any scene.
    pub fn mixed(parts: &[(&Self, f64)]) -> Self {
        let (first, _) = parts[0];
        let mut groups: Vec<String> = Vec::new();
        let (mut luminaires, mut fittings) = (Vec::new(), Vec::new());
        for &(scene, factor) in parts.iter().filter(|(_, factor)| *factor > 0.0) {
            let own = [scene.name().to_owned()];
            let names = if scene.groups().is_empty() { &own } else { scene.groups() };
            let numbers: Vec<u32> = names.iter().map(|name| number(&mut groups, name)).collect();
            fittings.extend_from_slice(scene.fittings());
            let mut dimmer = Dimmer { factor, webs: Vec::new() };
            luminaires.extend(scene.luminaires().iter().map(|luminaire| Luminaire {
                group: numbers[luminaire.group as usize],
                kind: dimmer.dimmed(&luminaire.kind),
                ..luminaire.clone()
            }));
        }
        let mixed = |(k, material): (usize, &Material)| {
            shining(material, parts.iter().map(|&(scene, by)| (&scene.materials()[k], by)))
        };
        let materials = first.materials().iter().enumerate().map(mixed).collect();
        let range = |m: Maintenance| [m.least, m.greatest];
        let factors =
            parts.iter().flat_map(|(scene, _)| scene.maintenance().map_or([1.0; 2], range));
        let maintenance = Maintenance::of(factors);
        first.relit(luminaires, groups, materials).fitted(fittings).maintained(maintenance)
    }
}

/// The number of a name, which is added where it is new.
fn number(names: &mut Vec<String>, name: &str) -> u32 {
    let known = names.iter().position(|n| n == name);
    known.unwrap_or_else(|| {
        names.push(name.to_owned());
        names.len() - 1
    }) as u32
}

/// A material with the light that others have of their own, each times a factor.
fn shining<'a>(
    material: &Material,
    others: impl IntoIterator<Item = (&'a Material, f64)> + Clone,
) -> Material {
    let Body::Opaque { front, back } = &material.body else { return material.clone() };
    let side = |finish: &Finish, back: bool| {
        let others = others.clone().into_iter();
        let light = others.filter_map(|(m, by)| Some(m.finish(back)?.luminance_cd_m2 * by));
        Finish { luminance_cd_m2: light.sum::<Rgb>(), ..finish.clone() }
    };
    let body = Body::Opaque { front: side(front, false), back: side(back, true) };
    Material { body, ..material.clone() }
}

/// A material without light of its own or of others; panes let light pass all the same.
fn black(material: &Material) -> Material {
    let body = match &material.body {
        Body::Opaque { .. } => Body::Opaque { front: Finish::BLACK, back: Finish::BLACK },
        glass @ Body::Dielectric(_) => glass.clone(),
    };
    Material { body, ..material.clone() }
}

/// Dims luminaires; those that share a web go on sharing one.
struct Dimmer {
    factor: f64,
    webs: Vec<(Arc<PhotometricWeb>, IntensityDistribution)>,
}

impl Dimmer {
    fn dimmed(&mut self, kind: &LuminaireKind) -> LuminaireKind {
        match kind.clone() {
            kind if self.factor == 1.0 => kind,
            LuminaireKind::Point { position, world_from_luminaire, intensity, area } => {
                let intensity = self.scaled(&intensity);
                LuminaireKind::Point { position, world_from_luminaire, intensity, area }
            }
            LuminaireKind::Directional { direction, illuminance_lx, half_angle_rad } => {
                let illuminance_lx = illuminance_lx * self.factor;
                LuminaireKind::Directional { direction, illuminance_lx, half_angle_rad }
            }
            LuminaireKind::Sky { world_from_sky, sky } => {
                LuminaireKind::Sky { world_from_sky, sky: sky.scaled(self.factor) }
            }
        }
    }

    fn scaled(&mut self, intensity: &IntensityDistribution) -> IntensityDistribution {
        let IntensityDistribution::Web(web) = intensity else {
            return intensity.scaled(self.factor);
        };
        let known = self.webs.iter().find(|(of, _)| Arc::ptr_eq(of, web));
        known.map(|(_, scaled)| scaled.clone()).unwrap_or_else(|| {
            let scaled = intensity.scaled(self.factor);
            self.webs.push((Arc::clone(web), scaled.clone()));
            scaled
        })
    }
}
