//! Materials with a lightmap beside all that they have.

use super::origins::{place, primitive};
use super::references::{index, list};
use crate::Problem;
use crate::gltf::{Opened, Origin};
use crate::lightmap::Target;
use serde_json::{Value, json};
use std::collections::{BTreeMap, HashMap, HashSet};

/// As Mozilla Hubs reads it.
pub(super) const LIGHTMAP: &str = "MOZ_lightmap";
/// Materials that a primitive may be shown with instead.
pub(super) const VARIANTS: &str = "KHR_materials_variants";

/// Which material, for what.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
pub(super) struct Use {
    pub(super) page: u32,
    /// Whether its backs have a place of their own, and are surfaces of their own.
    pub(super) is_parted: bool,
}

/// The materials of the new file.
pub(super) struct Materials {
    pub(super) all: Vec<Value>,
    /// Texture and factor of each page.
    pages: Vec<(usize, f64)>,
    /// The set of texture coordinates that are places in the lightmap.
    set: u32,
    known: HashMap<(Option<usize>, Use), usize>,
    /// Those that something needs as they are, or that are changed already.
    taken: HashSet<usize>,
}

impl Materials {
    /// Those of a document, of which primitives that stay as they are need some as they are.
    pub(super) fn of<'a>(
        document: &Value,
        staying: impl Iterator<Item = &'a Value>,
        (pages, set): (Vec<(usize, f64)>, u32),
    ) -> Self {
        let all = list(document, "materials").cloned().collect();
        let taken = staying.flat_map(of_primitive).flatten().collect();
        Self { all, pages, set, known: HashMap::new(), taken }
    }

    /// Gives a primitive the light of a page: its material and those it may be shown with instead.
    pub(super) fn light(&mut self, primitive: &mut Value, for_what: Use) {
        let own = index(primitive, "material");
        primitive["material"] = json!(self.lit(own, for_what));
        let mappings =
            primitive.get_mut("extensions").and_then(|e| e.get_mut(VARIANTS)?.get_mut("mappings"));
        for mapping in mappings.and_then(Value::as_array_mut).into_iter().flatten() {
            if let Some(other) = index(mapping, "material") {
                mapping["material"] = json!(self.lit(Some(other), for_what));
            }
        }
    }

    /// Index of a material with the light of a page: in its place where nothing else needs that, else a copy.
    fn lit(&mut self, material: Option<usize>, for_what: Use) -> usize {
        if let Some(&known) = self.known.get(&(material, for_what)) {
            return known;
        }
        let old = material.and_then(|index| self.all.get(index)).cloned();
        let mut new = old.unwrap_or_else(|| json!({}));
        let (texture, intensity) = self.pages[for_what.page as usize];
        new["extensions"][LIGHTMAP] =
            json!({"index": texture, "texCoord": self.set, "intensity": intensity});
        if for_what.is_parted {
            new["doubleSided"] = json!(false);
        }
        let in_place = material.filter(|&index| index < self.all.len() && self.taken.insert(index));
        let made = in_place.unwrap_or(self.all.len());
        match in_place {
            Some(index) => self.all[index] = new,
            None => self.all.push(new),
        }
        self.known.insert((material, for_what), made);
        made
    }
}

/// Materials of a primitive: its own, or none, and those it may be shown with instead.
fn of_primitive(primitive: &Value) -> Vec<Option<usize>> {
    let variants = primitive.get("extensions").and_then(|e| e.get(VARIANTS));
    let others =
        variants.into_iter().flat_map(|v| list(v, "mappings")).map(|m| index(m, "material"));
    std::iter::once(index(primitive, "material")).chain(others).collect()
}

/// The set of texture coordinates for places in the lightmap: the second, or the next that no texture of all that is lit is read
/// by. One for all: in three.js a texture, and so a page, has one.
pub(super) fn set_of(
    opened: &Opened,
    lit: impl Iterator<Item = Origin>,
    target: Target,
) -> Result<u32, Problem> {
    let mut users: BTreeMap<u32, Origin> = BTreeMap::new();
    for origin in lit {
        let mut used = HashSet::new();
        for material in of_primitive(primitive(opened, origin)).into_iter().flatten() {
            add_sets(&opened.json["materials"][material], &mut used);
        }
        for set in used {
            users.entry(set).or_insert(origin);
        }
    }
    let (most, why) = match target {
        Target::Bevy => (1, "Bevy reads lightmaps by no other set"),
        _ => (3, "three.js knows no more sets"),
    };
    let free = (1..=most).find(|set| !users.contains_key(set));
    free.ok_or_else(|| {
        let all: Vec<String> = (1..=most).map(|set| format!("TEXCOORD_{set}")).collect();
        let what = format!("textures are read by {}, and {why}", all.join(", "));
        let place = users.get(&1).map_or(String::new(), |&origin| place(origin));
        opened.problem(place, what, "read them by TEXCOORD_0, or name another --target")
    })
}

/// The sets that textures of a material are read by, but for a lightmap that it has.
fn add_sets(value: &Value, used: &mut HashSet<u32>) {
    match value {
        Value::Array(values) => values.iter().for_each(|value| add_sets(value, used)),
        Value::Object(members) => {
            let sets = [
                value.get("texCoord"),
                value.pointer("/extensions/KHR_texture_transform/texCoord"),
            ];
            used.extend(sets.into_iter().flatten().filter_map(Value::as_u64).map(|set| set as u32));
            let parts = members.iter().filter(|(key, _)| *key != "extras" && *key != LIGHTMAP);
            parts.for_each(|(_, value)| add_sets(value, used));
        }
        _ => {}
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sets_of_textures_are_found_wherever_they_stand() {
        let material = json!({
            "normalTexture": {"index": 0, "texCoord": 1},
            "occlusionTexture": {"index": 0, "extensions": {"KHR_texture_transform": {"texCoord": 2}}},
            "extensions": {
                "KHR_materials_sheen": {"sheenColorTexture": {"index": 1, "texCoord": 4}},
                "MOZ_lightmap": {"index": 3, "texCoord": 3},
            },
            "extras": {"texCoord": 5},
        });
        let mut used = HashSet::new();
        add_sets(&material, &mut used);
        assert_eq!(used, HashSet::from([1, 2, 4]));
    }
}
