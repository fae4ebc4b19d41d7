//! Scenes known by name.

use crate::case::{cube, sphere};
use crate::hall::{self, Variant, VariantError};
use crate::truth::TruthScene;
use isolux::scene::SceneParts;

/// Names that [`builtin`] knows beside those of [`TruthScene`].
pub const BUILTIN_NAMES: [&str; 3] = ["cube", "sphere", "hall"];

/// Why there is no scene of a name.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum BuiltinError {
    /// No scene is called so.
    #[error("there is no such scene")]
    Unknown,
    /// The scene has no such variant.
    #[error(transparent)]
    Variant(#[from] VariantError),
}

/// A scene by its name: `cube`, `sphere`, `hall` or a [`Variant`] of it, or a [`TruthScene`].
pub fn builtin(name: &str) -> Result<SceneParts, BuiltinError> {
    match name {
        "cube" => Ok(cube::parts()),
        "sphere" => Ok(sphere::parts()),
        _ => {
            if let Some(scene) = TruthScene::parse(name) {
                return Ok(scene.parts());
            }
            let settings = name.strip_prefix("hall").ok_or(BuiltinError::Unknown)?;
            if !settings.is_empty() && !settings.starts_with(',') {
                return Err(BuiltinError::Unknown);
            }
            Ok(hall::parts(Variant::parse(settings)?))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn knows_its_names_and_no_others() {
        for name in BUILTIN_NAMES.into_iter().chain([
            "hall,triangles=20000,luminaires=100",
            "truth-07",
            "truth-07,seed=3",
        ]) {
            assert_eq!(builtin(name).unwrap().name, name);
        }
        for name in ["teapot", "hallway", "cube,triangles=9", "truth-60", ""] {
            assert_eq!(builtin(name), Err(BuiltinError::Unknown), "{name}");
        }
        assert!(matches!(builtin("hall,luminaires=1"), Err(BuiltinError::Variant(_))));
    }
}
