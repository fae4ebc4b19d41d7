//! Files that a `scene.toml` places.
