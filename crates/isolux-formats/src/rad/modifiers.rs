//! Modifiers by name: a name stands for what was last defined under it.

use super::limits;
use super::record::{Kind, Object, kind_of};
use crate::lines::At;
use isolux::geometry::{Transform, Vector};
use std::collections::HashMap;

/// A modifier as defined in its place.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Definition {
    pub(super) at: At,
    /// With directions in world coordinates.
    pub(super) object: Object,
    /// What modifies it.
    pub(super) modifier: Named,
    /// What an alias stands for; of a mixture the first that it mixes.
    pub(super) target: Named,
    /// The second that a mixture mixes.
    pub(super) background: Named,
    /// The place of a pattern.
    pub(super) world_from_file: Transform,
}

/// What a name means.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Named {
    /// `void`, `inherit`.
    Nothing,
    Known(usize),
    Unknown,
}

/// All modifiers so far.
#[derive(Default)]
pub(super) struct Modifiers {
    list: Vec<Definition>,
    latest: HashMap<String, usize>,
}

impl Modifiers {
    pub(super) fn get(&self, index: usize) -> &Definition {
        &self.list[index]
    }

    pub(super) fn find(&self, name: &str) -> Named {
        match self.latest.get(name) {
            _ if matches!(name, "void" | "inherit") => Named::Nothing,
            Some(&index) => Named::Known(index),
            None => Named::Unknown,
        }
    }

    /// Defines a modifier; whether there was room.
    pub(super) fn define(&mut self, object: &Object, at: At, map: &Transform) -> bool {
        let mut object = object.clone();
        if let ("spotlight", [.., x, y, z]) = (object.type_.as_str(), &mut object.numbers[..]) {
            [*x, *y, *z] = map.vector(Vector::new(*x, *y, *z)).into();
        }
        let is_placed = kind_of(&object.type_) == Some(Kind::Pattern);
        let definition = Definition {
            at,
            modifier: self.find(&object.modifier),
            target: object.strings.first().map_or(Named::Unknown, |name| self.find(name)),
            background: object.strings.get(1).map_or(Named::Unknown, |name| self.find(name)),
            world_from_file: if is_placed { *map } else { Transform::IDENTITY },
            object,
        };
        let name = definition.object.name.clone();
        // An array defines the same modifiers for every copy.
        if self.latest.get(&name).is_some_and(|&k| self.list[k] == definition) {
            return true;
        }
        self.latest.insert(name, self.list.len());
        self.list.push(definition);
        self.list.len() <= limits::MODIFIERS
    }
}
