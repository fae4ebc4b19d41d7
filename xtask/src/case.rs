//! Scenes that benches of the command solve.

/// The Cornell box with its boxes.
pub(crate) const MCGUIRE: &str = "scenes/cornell_mcguire/scene.toml";

/// A scene, and how it is solved.
pub(crate) struct Case {
    pub(crate) name: &'static str,
    /// As `isolux solve` takes it, from the root of the workspace.
    pub(crate) scene: &'static str,
    pub(crate) method: &'static str,
    pub(crate) accuracy: &'static str,
    pub(crate) flags: &'static [&'static str],
}

pub(crate) const fn case(
    name: &'static str,
    scene: &'static str,
    method: &'static str,
    accuracy: &'static str,
) -> Case {
    Case { name, scene, method, accuracy, flags: &[] }
}

impl Case {
    pub(crate) const fn with(mut self, flags: &'static [&'static str]) -> Self {
        self.flags = flags;
        self
    }
}
