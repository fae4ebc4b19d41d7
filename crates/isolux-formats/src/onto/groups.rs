//! The places of meshes: each that carries light gets a mesh of its own.

use super::corners::{Sides, is_lit};
use super::matching::Matched;
use super::materials::VARIANTS;
use super::references::{Referenced, index, list};
use crate::gltf::{DRACO, Opened};
use serde_json::{Map, Value, json};
use std::collections::{BTreeMap, BTreeSet};

/// One place of a mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Group {
    pub(super) mesh: usize,
    pub(super) node: usize,
    /// Its number where the node has several.
    pub(super) copy: Option<usize>,
}

/// Places of meshes that carry light.
pub(super) struct Groups {
    /// In each, the shapes of the primitives that do, by the number of the primitive.
    pub(super) lit: BTreeMap<Group, BTreeMap<usize, usize>>,
    /// Meshes that other nodes need as they are.
    needed: BTreeSet<usize>,
}

impl Groups {
    pub(super) fn of(opened: &Opened, matched: &Matched, sides: &Sides<'_>) -> Self {
        let mut lit: BTreeMap<Group, BTreeMap<usize, usize>> = BTreeMap::new();
        for (number, (origin, _)) in opened.shapes.iter().enumerate() {
            if is_lit(&matched.triangles[number], sides) {
                let group = Group { mesh: origin.mesh, node: origin.node, copy: origin.copy };
                lit.entry(group).or_default().insert(origin.primitive, number);
            }
        }
        let nodes: BTreeSet<usize> = lit.keys().map(|group| group.node).collect();
        let others =
            list(&opened.json, "nodes").enumerate().filter(|(node, _)| !nodes.contains(node));
        let needed = others.filter_map(|(_, node)| index(node, "mesh")).collect();
        Self { lit, needed }
    }

    /// Whether a mesh may become that of the first place where it carries light.
    pub(super) fn may_change(&self, mesh: usize) -> bool {
        !self.needed.contains(&mesh)
    }

    /// Whether nothing needs a primitive as it is.
    fn is_replaced(&self, mesh: usize, primitive: usize) -> bool {
        let all = || self.lit.iter().filter(|(group, _)| group.mesh == mesh);
        self.may_change(mesh)
            && all().next().is_some()
            && all().all(|(_, lit)| lit.contains_key(&primitive))
    }

    /// Takes primitives out of the document that nothing needs as they are, and tells what they were made of.
    pub(super) fn take_replaced(&self, document: &mut Value) -> Referenced {
        let mut lost = Referenced::default();
        let meshes: BTreeSet<usize> = self.lit.keys().map(|group| group.mesh).collect();
        for mesh in meshes {
            let primitives = document.pointer_mut(&format!("/meshes/{mesh}/primitives"));
            let primitives = primitives.and_then(Value::as_array_mut);
            for (number, primitive) in primitives.into_iter().flatten().enumerate() {
                if self.is_replaced(mesh, number) {
                    lost.add_primitive(primitive);
                    let draco = primitive.get("extensions").and_then(|e| e.get(DRACO));
                    lost.views.extend(draco.and_then(|draco| index(draco, "bufferView")));
                    *primitive = what_stays(primitive);
                }
            }
        }
        lost
    }
}

/// What a new primitive has of a replaced one that may refer to data: its extensions, but for those that are replaced, too.
fn what_stays(primitive: &Value) -> Value {
    let extensions = primitive.get("extensions").and_then(Value::as_object);
    let is_replaced = |name: &str| name == DRACO || name == VARIANTS;
    let others = extensions.into_iter().flatten().filter(|(name, _)| !is_replaced(name));
    let others: Map<String, Value> = others.map(|(k, v)| (k.clone(), v.clone())).collect();
    json!({"extensions": others})
}
