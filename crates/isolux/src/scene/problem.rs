//! What can be wrong with a scene.

/// What is wrong with a scene, and with which part.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{place}: {what}; {remedy}")]
pub struct SceneProblem {
    /// Which part.
    pub place: Place,
    /// What is wrong.
    pub what: String,
    /// How to mend it.
    pub remedy: String,
}

/// A part of a scene, by its index in [`SceneParts`] and its name.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Place {
    /// The scene as a whole.
    #[error("scene")]
    Scene,
    /// A shape.
    #[error("shape `{name}`")]
    Shape {
        /// Index.
        index: usize,
        /// Name.
        name: String,
    },
    /// A material.
    #[error("material `{name}`")]
    Material {
        /// Index.
        index: usize,
        /// Name.
        name: String,
    },
    /// A texture.
    #[error("texture {index}")]
    Texture {
        /// Index.
        index: usize,
    },
    /// A luminaire.
    #[error("luminaire `{name}`")]
    Luminaire {
        /// Index.
        index: usize,
        /// Name.
        name: String,
    },
    /// A calculation grid.
    #[error("grid `{name}`")]
    Grid {
        /// Index.
        index: usize,
        /// Name.
        name: String,
    },
    /// A camera.
    #[error("camera `{name}`")]
    Camera {
        /// Index.
        index: usize,
        /// Name.
        name: String,
    },
}
