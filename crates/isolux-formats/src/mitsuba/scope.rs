//! What every step of reading one scene shares.

use super::property::string;
use super::record::{Element, Names, Wrong};
use crate::lines::{At, Notes};
use crate::reach::Root;
use std::path::PathBuf;

/// The named objects of a scene and what was found in it.
pub(super) struct Scope<'a, 'n> {
    pub(super) names: Names<'a>,
    pub(super) notes: &'n mut Notes,
    /// The directory in whose tree all files must lie.
    pub(super) root: Root,
}

impl<'a> Scope<'a, '_> {
    /// An object, or what a `ref` stands for; `None` after a problem.
    pub(super) fn object(&mut self, element: &'a Element) -> Option<&'a Element> {
        element.is_used.set(true);
        if element.tag != "ref" {
            return Some(element);
        }
        let id = element.attribute("id").unwrap_or_default();
        let found = self.names.get(id).copied();
        match found {
            Some(object) => object.is_used.set(true),
            None => {
                let what =
                    format!("there is no object `{}`", id.chars().take(60).collect::<String>());
                self.notes.problem(&element.at, what, "define it, or remove the reference");
            }
        }
        found
    }

    /// The objects of one kind that an object holds.
    pub(super) fn objects(&mut self, of: &'a Element, tag: &str) -> Vec<&'a Element> {
        let is_one = |child: &&Element| match child.tag.as_str() {
            "ref" => {
                let id = child.attribute("id").unwrap_or_default();
                self.names.get(id).is_none_or(|object| object.tag == tag)
            }
            own => own == tag,
        };
        let found: Vec<&'a Element> = of.children.iter().filter(is_one).collect();
        found.into_iter().filter_map(|child| self.object(child)).collect()
    }

    /// The file that an object names; `None` after a problem.
    pub(super) fn file(&mut self, object: &Element) -> Option<PathBuf> {
        let Some(name) = string(object, "filename") else {
            self.refuse(object, "names no file", "give it a string `filename`");
            return None;
        };
        match self.root.file(name) {
            Ok(path) => Some(path),
            Err(why) => {
                let (what, remedy) = why.explain(name);
                self.notes.problem(&object.at, what, remedy);
                None
            }
        }
    }

    /// The value, or `None` after a problem at a place.
    pub(super) fn take<T>(&mut self, at: &At, read: Result<T, Wrong>) -> Option<T> {
        match read {
            Ok(value) => Some(value),
            Err((what, remedy)) => {
                self.notes.problem(at, what, remedy);
                None
            }
        }
    }

    /// Something of an object that keeps the scene from being used.
    pub(super) fn refuse(&mut self, object: &Element, what: &str, remedy: &str) {
        self.notes.problem(&object.at, format!("{} {what}", object.label()), remedy);
    }

    /// Something of an object that is left out or guessed.
    pub(super) fn warn(&mut self, object: &Element, what: &str, remedy: &str) {
        self.notes.warning(&object.at, format!("{} {what}", object.label()), remedy);
    }

    /// Says which properties of an object that has been read were not.
    pub(super) fn finish(&mut self, object: &Element) {
        for child in object.children.iter().filter(|child| !child.is_used.get()) {
            let label =
                if child.slot().is_empty() { child.label() } else { format!("`{}`", child.slot()) };
            let shown: String = label.chars().take(80).collect();
            let what = format!("{}: {shown} is not used", object.label());
            self.notes.warning(
                &child.at,
                what,
                "nothing needs to be done if it does not change the light",
            );
            child.is_used.set(true);
        }
    }
}
