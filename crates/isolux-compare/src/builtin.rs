//! Scenes known by name.

use crate::case::{cube, sphere};
use isolux::scene::SceneParts;

/// Names that [`builtin`] knows.
pub const BUILTIN_NAMES: [&str; 2] = ["cube", "sphere"];

/// A scene by its name.
pub fn builtin(name: &str) -> Option<SceneParts> {
    match name {
        "cube" => Some(cube::parts()),
        "sphere" => Some(sphere::parts()),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn knows_its_names_and_no_others() {
        for name in BUILTIN_NAMES {
            assert_eq!(builtin(name).unwrap().name, name);
        }
        assert_eq!(builtin("teapot"), None);
    }
}
