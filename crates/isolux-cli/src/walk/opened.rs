//! A map as it is opened for the walk-through.

use super::fineness::finer;
use super::told::{ALL_LIGHT, told};
use crate::failure::Failure;
use crate::{mix, viewpoint};
use isolux::engine::{MixPart, Mixed, mix_apart};
use isolux::map::{IlluminationMap, Provenance, Unshot, VertexLight};
use isolux::scene::Scene;
use isolux_formats::map_glb::GroupLight;
use isolux_formats::walk::{self, Light, Mesh};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;

/// A map with what can be dimmed in it.
pub(crate) struct Opened {
    path: PathBuf,
    /// The scene in it.
    pub(crate) scene: Arc<Scene>,
    /// The map.
    pub(crate) map: Arc<IlluminationMap>,
    /// Names of the layers of its light.
    layers: Vec<String>,
    /// Of each layer the values at the vertices; none where there is one layer alone.
    values: Vec<Vec<Option<VertexLight>>>,
    /// The maps of the layers; none where there is one layer alone.
    parts: Vec<mix::Part>,
}

impl Opened {
    /// Reads a map; if it is the sum of those of groups that lie beside it, those, too.
    pub(crate) fn read(path: &Path) -> Result<Self, Failure> {
        let mut parts = mix::parts_of(path, 1.0)?;
        if parts.len() > 1 {
            return Self::of_groups(path, parts);
        }
        let part = parts.remove(0);
        Ok(Self::alone(path, (part.scene, part.map)))
    }

    /// A map whose light is not known by groups.
    pub(crate) fn alone(path: &Path, (scene, map): (Scene, IlluminationMap)) -> Self {
        let layers = vec![ALL_LIGHT.to_owned()];
        let (scene, map) = (Arc::new(scene), Arc::new(map));
        Self { path: path.to_owned(), scene, map, layers, values: Vec::new(), parts: Vec::new() }
    }

    fn of_groups(path: &Path, mut parts: Vec<mix::Part>) -> Result<Self, Failure> {
        parts.retain(|part| part.dimming > 0.0);
        let mixed = mixed(&parts)?;
        let dimmed = |(part, values): (&mix::Part, Vec<Option<VertexLight>>)| {
            values.into_iter().map(|value| value.map(|value| value.dimmed(part.dimming))).collect()
        };
        Ok(Self {
            path: path.to_owned(),
            scene: Arc::new(mixed.scene),
            map: Arc::new(mixed.map),
            layers: parts.iter().map(|part| mix::lit_groups(&part.scene).join(", ")).collect(),
            values: parts.iter().zip(mixed.parts).map(dimmed).collect(),
            parts,
        })
    }

    /// Scene and map with each layer dimmed, as `mix` makes them; those of the file if none is named. `None`: nothing is left of the light.
    #[cfg(feature = "serve")]
    pub(crate) fn dimmed(&self, dimming: &[f64]) -> Option<(Arc<Scene>, Arc<IlluminationMap>)> {
        if dimming.iter().all(|by| *by == 1.0) || !self.has_groups() {
            return Some((Arc::clone(&self.scene), Arc::clone(&self.map)));
        }
        let part = |(part, by): (&'_ mix::Part, &f64)| (part.dimming * by).max(0.0);
        let factors: Vec<f64> = self.parts.iter().zip(dimming).map(part).collect();
        let asked: Vec<MixPart<'_>> = self
            .parts
            .iter()
            .zip(factors)
            .map(|(part, dimming)| MixPart { dimming, ..part.asked() })
            .collect();
        let (scene, map) = isolux::engine::mix(&asked).ok()?;
        Some((Arc::new(scene), Arc::new(map)))
    }

    /// The name of its file.
    pub(crate) fn file(&self) -> String {
        self.path.file_name().map_or(String::new(), |name| name.to_string_lossy().into_owned())
    }

    /// Whether its light is known by groups.
    pub(crate) fn has_groups(&self) -> bool {
        !self.parts.is_empty()
    }

    /// The light of each group at the vertices of the map, known where that is.
    pub(crate) fn groups(&self) -> Vec<GroupLight> {
        let groups = self.layers.iter().zip(&self.values).zip(&self.parts);
        groups.map(|((name, values), part)| self.group(name, values, part)).collect()
    }

    fn group(&self, name: &str, values: &[Option<VertexLight>], part: &mix::Part) -> GroupLight {
        let value = |(sum, own): (&Option<VertexLight>, &Option<VertexLight>)| {
            let standing = sum.as_ref()?.standing;
            Some(VertexLight { standing, ..own.unwrap_or(VertexLight::NOTHING) })
        };
        let unshot = part.map.provenance.unshot;
        let unshot = unshot.map(|of| Unshot { ambient_lx: of.ambient_lx * part.dimming, ..of });
        let map = IlluminationMap {
            elements: self.map.elements.clone(),
            values: self.map.values.iter().zip(values).map(value).collect(),
            provenance: Provenance { unshot, ..self.map.provenance.clone() },
        };
        GroupLight { name: name.to_owned(), map }
    }

    /// Whether another map is of the same surfaces.
    pub(crate) fn is_alike(&self, other: &Self) -> bool {
        self.scene.surfaces_hash() == other.scene.surfaces_hash()
    }

    /// Container of the scene.
    pub(crate) fn scene_bytes(&self, other: Option<&Self>) -> Result<Vec<u8>, Failure> {
        let camera = viewpoint::camera(&self.scene, None).map_err(Failure::bad_input)?;
        let other = other.filter(|other| self.is_alike(other)).map(Self::file);
        let names = (self.file(), other);
        let names = (names.0.as_str(), names.1.as_deref());
        let told = told((&self.scene, &self.map), &camera, names, self.layers.clone());
        Ok(walk::scene(&self.scene, &told))
    }

    /// The mesh of its elements, and their light.
    pub(crate) fn drawn(&self, other: Option<&Self>) -> (Mesh, Light) {
        let mesh = Mesh::new(&self.scene, &self.map, 1);
        let mut light = Light::new(&mesh, &self.map);
        if self.has_groups() {
            light = light.with_layers(&mesh, &self.values);
        }
        if let Some(other) = other.filter(|other| self.is_alike(other)) {
            light = light.beside((&self.scene, &mesh), &self.map, &other.map);
        }
        (mesh, light)
    }

    /// The same with finer shadows, as far as they are found within a time.
    pub(crate) fn drawn_finer(&self, limit: Duration) -> (Mesh, Light) {
        let map = finer(&self.scene, &self.map, limit);
        let mesh = Mesh::new(&self.scene, &map, 1);
        let light = Light::new(&mesh, &map);
        (mesh, light)
    }
}

fn mixed(parts: &[mix::Part]) -> Result<Mixed, Failure> {
    let asked: Vec<MixPart<'_>> = parts.iter().map(mix::Part::asked).collect();
    mix_apart(&asked).map_err(|error| mix::failure(&error, parts))
}
