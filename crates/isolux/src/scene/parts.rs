//! The plain description that readers fill.

use super::{CalculationGrid, Camera, Fitting, Luminaire, Maintenance, Material, Texture};
use isolux_geometry::Direction;
use serde::{Deserialize, Serialize};

/// Everything a scene is made of, unchecked.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SceneParts {
    /// Name of the scene.
    pub name: String,
    /// Which axis points up in the coordinates of the scene as written.
    pub up: UpAxis,
    /// Geometry.
    pub shapes: Vec<Shape>,
    /// Materials, referred to by index.
    pub materials: Vec<Material>,
    /// Textures, referred to by index.
    pub textures: Vec<Texture>,
    /// Luminaires without surface.
    pub luminaires: Vec<Luminaire>,
    /// What is known of each beside its light; of those beyond its end nothing is.
    pub fittings: Vec<Fitting>,
    /// The maintenance factors within the light of the luminaires; `None` where all of it is initial.
    pub maintenance: Option<Maintenance>,
    /// Names of light groups; luminaires without one are in group 0.
    pub groups: Vec<String>,
    /// Points of view.
    pub cameras: Vec<Camera>,
    /// Where illuminance is asked for.
    pub grids: Vec<CalculationGrid>,
}

/// A triangle mesh of one material, in world coordinates.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Shape {
    /// Name, as written in the scene.
    pub name: String,
    /// Vertex positions, m.
    pub positions: Vec<[f64; 3]>,
    /// Shading normals, one a vertex, or none: then every triangle is flat.
    pub normals: Option<Vec<[f64; 3]>>,
    /// Texture coordinates, one a vertex, `v` downwards.
    pub uvs: Option<Vec<[f64; 2]>>,
    /// A second set of them, one a vertex: the place in a lightmap, 0 to 1, as the file has it.
    pub lightmap_uvs: Option<Vec<[f32; 2]>>,
    /// Vertex indices, counter-clockwise seen from the front.
    pub triangles: Vec<[u32; 3]>,
    /// Index of the material.
    pub material: u32,
}

/// The axis that points up.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum UpAxis {
    /// +y, as in glTF.
    Y,
    /// +z, as in most lighting software.
    #[default]
    Z,
}

impl UpAxis {
    /// The direction that points up.
    pub const fn direction(self) -> Direction {
        match self {
            Self::Y => Direction::Y,
            Self::Z => Direction::Z,
        }
    }
}
