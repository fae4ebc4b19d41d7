//! The scene as written: elements with parameters filled in and included files in their place.

use crate::lines::At;
use std::cell::Cell;
use std::collections::HashMap;

/// What is wrong, and how to mend it.
pub(super) type Wrong = (String, &'static str);

/// An element: an object (`shape`, `bsdf`, ...) or a property (`float`, `rgb`, ...).
#[derive(Debug)]
pub(super) struct Element {
    pub(super) tag: String,
    pub(super) attributes: Vec<(String, String)>,
    pub(super) children: Vec<Self>,
    pub(super) at: At,
    /// Whether something was made of it.
    pub(super) is_used: Cell<bool>,
}

impl Element {
    pub(super) fn attribute(&self, name: &str) -> Option<&str> {
        self.attributes.iter().find(|(key, _)| key == name).map(|(_, value)| value.as_str())
    }

    /// The plugin it asks for.
    pub(super) fn kind(&self) -> &str {
        self.attribute("type").unwrap_or_default()
    }

    /// The slot of its parent that it fills.
    pub(super) fn slot(&self) -> &str {
        self.attribute("name").unwrap_or_default()
    }

    /// What messages call it.
    pub(super) fn label(&self) -> String {
        let shown = |text: &str| text.chars().take(60).collect::<String>();
        match (self.kind(), self.attribute("id")) {
            ("", _) => shown(&self.tag),
            (kind, None) => format!("{} `{}`", shown(&self.tag), shown(kind)),
            (kind, Some(id)) => format!("{} `{}` (`{}`)", shown(&self.tag), shown(kind), shown(id)),
        }
    }

    /// A child by the slot it fills.
    pub(super) fn child(&self, slot: &str) -> Option<&Self> {
        let found = self.children.iter().find(|child| child.slot() == slot)?;
        found.is_used.set(true);
        Some(found)
    }
}

/// Objects by what other objects call them.
pub(super) type Names<'a> = HashMap<&'a str, &'a Element>;

/// All objects of a tree that have names; of two of one name the first.
pub(super) fn names(root: &Element) -> Names<'_> {
    let mut names = HashMap::new();
    let mut open = vec![root];
    while let Some(element) = open.pop() {
        if let Some(id) =
            element.attribute("id").filter(|_| !matches!(element.tag.as_str(), "ref" | "alias"))
        {
            names.entry(id).or_insert(element);
        }
        open.extend(element.children.iter().rev());
    }
    for alias in root.children.iter().filter(|child| child.tag == "alias") {
        let ends = (alias.attribute("id"), alias.attribute("as"));
        if let (Some(id), Some(other)) = ends
            && let Some(&object) = names.get(id)
        {
            names.entry(other).or_insert(object);
        }
    }
    names
}
