//! Photometric files behind the distributions of luminaires.

use super::file::SceneFile;
use super::numbers::shortest;
use crate::ies::{self, Photometry};
use isolux::photometry::{IntensityDistribution, PhotometricWeb};
use isolux::scene::{LuminaireKind, SceneParts};
use std::path::Path;
use std::sync::Arc;

/// A photometric file that luminaires may have been made from.
#[derive(Clone, Debug, PartialEq)]
pub struct NamedPhotometry {
    /// Name of the file, `lamp.ies`.
    pub name: String,
    /// What is in it.
    pub photometry: Photometry,
}

/// A file, its text, and the distribution it is read as.
struct Entry {
    name: String,
    text: String,
    base: IntensityDistribution,
}

/// The files of a scene, and which of its distributions is which of them, dimmed.
pub(super) struct Catalogue {
    entries: Vec<Entry>,
    /// Webs met, with the index of the file and the dimming.
    dimmed: Vec<(Arc<PhotometricWeb>, usize, f64)>,
}

impl Catalogue {
    pub(super) fn of(parts: &SceneParts, known: &[NamedPhotometry]) -> Self {
        let mut catalogue = Self { entries: Vec::new(), dimmed: Vec::new() };
        let known: Vec<Entry> =
            known.iter().filter_map(|k| entry(&k.name, &k.photometry)).collect();
        let mut known: Vec<Option<Entry>> = known.into_iter().map(Some).collect();
        for luminaire in &parts.luminaires {
            let LuminaireKind::Point { intensity, .. } = &luminaire.kind else { continue };
            if let IntensityDistribution::Web(web) = intensity {
                catalogue.add(web, &mut known);
            }
        }
        catalogue
    }

    fn add(&mut self, web: &Arc<PhotometricWeb>, known: &mut [Option<Entry>]) {
        if self.find(web).is_some() {
            return;
        }
        for (index, entry) in self.entries.iter().enumerate() {
            if let Some(dimming) = dimming(web, &entry.base) {
                self.dimmed.push((web.clone(), index, dimming));
                return;
            }
        }
        let is_base = |entry: &Option<Entry>| {
            entry.as_ref().is_some_and(|entry| dimming(web, &entry.base).is_some())
        };
        let made = known.iter_mut().find(|entry| is_base(entry)).and_then(Option::take);
        let made = made.or_else(|| self.file_of(web));
        let Some(made) = made else { return };
        let dimming = dimming(web, &made.base).unwrap_or(1.0);
        self.dimmed.push((web.clone(), self.entries.len(), dimming));
        self.entries.push(made);
    }

    /// A file made of a distribution alone.
    fn file_of(&self, web: &PhotometricWeb) -> Option<Entry> {
        let name = format!("luminaire-{}.ies", self.entries.len() + 1);
        let mut photometry = Photometry::of_web(web);
        let is_whole = |entry: &Entry| dimming(web, &entry.base) == Some(1.0);
        if let Some(entry) = entry(&name, &photometry).filter(is_whole) {
            return Some(entry);
        }
        if !web.system().is_c() {
            return None;
        }
        // Part of a circle would be mirrored: close it.
        photometry.planes_deg.push(photometry.planes_deg.first()? + 360.0);
        let first = photometry.candela[..web.gammas_deg().len()].to_vec();
        photometry.candela.extend(first);
        entry(&name, &photometry)
    }

    /// The file and the dimming of a distribution.
    pub(super) fn find(&self, web: &Arc<PhotometricWeb>) -> Option<(&str, f64)> {
        let same = |(known, _, _): &&(Arc<PhotometricWeb>, usize, f64)| {
            Arc::ptr_eq(known, web) || known == web
        };
        let (_, file, dimming) = self.dimmed.iter().find(same)?;
        Some((&self.entries[*file].name, *dimming))
    }

    pub(super) fn files(&self) -> impl Iterator<Item = SceneFile> {
        self.entries.iter().map(|entry| SceneFile::new(entry.name.clone(), entry.text.clone()))
    }
}

/// A file and what it is read as; `None` where LM-63 cannot say it.
fn entry(name: &str, photometry: &Photometry) -> Option<Entry> {
    let text = ies::write(photometry);
    let mut no_tilt = |_: &str| Err(crate::Problem::new(Path::new(name), "", "no tilt", "none"));
    let file = ies::parse(text.as_bytes(), Path::new(name), &mut no_tilt).ok()?;
    let base = file.value.resolve().ok()?;
    Some(Entry { name: name.to_owned(), text, base })
}

/// The factor that makes a web of a base, to the last bit of every intensity.
fn dimming(web: &PhotometricWeb, base: &IntensityDistribution) -> Option<f64> {
    let IntensityDistribution::Web(base) = base else { return None };
    let ratio = web.max_intensity_cd() / base.max_intensity_cd();
    let makes = |factor: f64| base.scaled(factor) == *web;
    let same_angles = web.system() == base.system()
        && web.planes_deg() == base.planes_deg()
        && web.gammas_deg() == base.gammas_deg();
    (same_angles && ratio.is_finite())
        .then(|| shortest(ratio, makes))
        .filter(|&factor| makes(factor))
}
