//! What in a glTF document refers to accessors and buffer views.
//!
//! Nothing of a file is ever removed from its lists, as extensions that nobody here knows may count on numbers in them. Places
//! of what a replaced primitive alone needed are used again.

use crate::gltf::MESHOPT_NAMES;
use serde_json::Value;
use std::collections::HashSet;

/// Extensions whose whole numbers are none of accessors and buffer views.
const WITHOUT_DATA: [&str; 4] =
    ["KHR_lights_punctual", "KHR_texture_transform", "KHR_node_visibility", "MOZ_lightmap"];
const MATERIALS: &str = "KHR_materials_";

/// Numbers of what something refers to.
#[derive(Default)]
pub(super) struct Referenced {
    pub(super) accessors: HashSet<usize>,
    pub(super) views: HashSet<usize>,
}

impl Referenced {
    /// All that is referred to, but for accessors whose views only those need that are left out.
    pub(super) fn of(document: &Value, is_left_out: &dyn Fn(usize) -> bool) -> Self {
        let mut found = Self::default();
        for primitive in list(document, "meshes").flat_map(|mesh| list(mesh, "primitives")) {
            found.add_primitive(primitive);
        }
        found
            .accessors
            .extend(list(document, "skins").filter_map(|s| index(s, "inverseBindMatrices")));
        for sampler in list(document, "animations").flat_map(|a| list(a, "samplers")) {
            found
                .accessors
                .extend(["input", "output"].iter().filter_map(|key| index(sampler, key)));
        }
        found.views.extend(list(document, "images").filter_map(|image| index(image, "bufferView")));
        for (number, accessor) in list(document, "accessors").enumerate() {
            if !is_left_out(number) {
                found.add_views(accessor);
            }
        }
        found.add_extensions(document);
        found
    }

    /// Accessors of a primitive.
    pub(super) fn add_primitive(&mut self, primitive: &Value) {
        let targets = list(primitive, "targets");
        let attributes = targets.chain(primitive.get("attributes"));
        let values = attributes.filter_map(Value::as_object).flat_map(|a| a.values());
        self.accessors.extend(values.filter_map(number));
        self.accessors.extend(index(primitive, "indices"));
    }

    /// Views of an accessor.
    pub(super) fn add_views(&mut self, accessor: &Value) {
        self.views.extend(index(accessor, "bufferView"));
        let sparse = accessor.get("sparse");
        let parts = sparse.and_then(|s| Some([s.get("indices")?, s.get("values")?]));
        self.views.extend(parts.iter().flatten().filter_map(|part| index(part, "bufferView")));
    }

    /// Every whole number in extensions that may be one of ours.
    pub(super) fn add_extensions(&mut self, value: &Value) {
        match value {
            Value::Array(values) => values.iter().for_each(|value| self.add_extensions(value)),
            Value::Object(object) => {
                for (key, value) in object.iter().filter(|(key, _)| *key != "extras") {
                    match value.as_object().filter(|_| key == "extensions") {
                        None => self.add_extensions(value),
                        Some(all) => all.iter().for_each(|(name, value)| {
                            if !is_without_data(name) {
                                self.add_numbers(value);
                            }
                        }),
                    }
                }
            }
            _ => {}
        }
    }

    fn add_numbers(&mut self, value: &Value) {
        match value {
            Value::Array(values) => values.iter().for_each(|value| self.add_numbers(value)),
            Value::Object(object) => object.values().for_each(|value| self.add_numbers(value)),
            other => {
                self.accessors.extend(number(other));
                self.views.extend(number(other));
            }
        }
    }
}

fn is_without_data(name: &str) -> bool {
    name.starts_with(MATERIALS) || WITHOUT_DATA.contains(&name) || MESHOPT_NAMES.contains(&name)
}

/// A list of a document, or of a part of it.
pub(super) fn list<'a>(of: &'a Value, key: &str) -> impl Iterator<Item = &'a Value> {
    of.get(key).and_then(Value::as_array).into_iter().flatten()
}

/// An index in an object.
pub(super) fn index(of: &Value, key: &str) -> Option<usize> {
    of.get(key).and_then(number)
}

/// A whole number.
pub(super) fn number(value: &Value) -> Option<usize> {
    value.as_u64().and_then(|value| usize::try_from(value).ok())
}

/// Whether an extension of that name stands anywhere.
pub(super) fn has_extension(value: &Value, name: &str) -> bool {
    match value {
        Value::Array(values) => values.iter().any(|value| has_extension(value, name)),
        Value::Object(object) => {
            object.iter().filter(|(key, _)| *key != "extras").any(|(key, value)| {
                (key == "extensions" && value.get(name).is_some()) || has_extension(value, name)
            })
        }
        _ => false,
    }
}

/// Takes an extension off an object.
pub(super) fn take_extension(of: &mut Value, name: &str) -> Option<Value> {
    let extensions = of.get_mut("extensions").and_then(Value::as_object_mut)?;
    let taken = extensions.remove(name);
    if extensions.is_empty() && taken.is_some() {
        of.as_object_mut()?.remove("extensions");
    }
    taken
}
