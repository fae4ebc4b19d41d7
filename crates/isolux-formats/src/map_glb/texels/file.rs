//! What a file is made of.

use crate::lightmap::Target;
use crate::map_glb::Preview;
use isolux::lightmap::Lightmap;
use isolux::map::IlluminationMap;
use isolux::scene::Scene;

/// What is to be written.
#[derive(Clone, Copy, Debug)]
pub struct TexelFile<'a> {
    /// The scene.
    pub scene: &'a Scene,
    /// Its map.
    pub map: &'a IlluminationMap,
    /// The same as texels.
    pub lightmap: &'a Lightmap,
    /// Exposure of colours that are tone mapped.
    pub preview: Preview,
    /// Who will read it.
    pub target: Target,
    /// Whether the map itself goes with it, and its texels with every digit, so that isolux can read them back.
    pub with_record: bool,
}
