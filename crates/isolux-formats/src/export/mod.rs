//! Maps for other software: scenes to walk through (VRML97, X3D), data to analyse (VTK, PLY, CSV).
//!
//! All are made from the vertices of the map; none of them can be read back. Positions are in metres in
//! the axes of the scene as written; VRML97 and X3D turn a z-up scene by a transform about it.

mod csv;
mod ply;
mod shown;
mod vrml;
mod vtu;
mod x3d;

use crate::map_glb::Preview;
use isolux::map::IlluminationMap;
use isolux::scene::Scene;

/// A kind of file, by its extension.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ExportKind {
    /// VRML97 (ISO/IEC 14772-1), colours unlit.
    Vrml,
    /// X3D 3.3 (ISO/IEC 19775-1, XML encoding), colours unlit.
    X3d,
    /// An unstructured grid of VTK, for ParaView.
    Vtu,
    /// Stanford PLY, binary.
    Ply,
    /// A row a vertex.
    Csv,
}

impl ExportKind {
    /// All of them, with their extensions.
    pub const ALL: [(Self, &str); 5] = [
        (Self::Vrml, "wrl"),
        (Self::X3d, "x3d"),
        (Self::Vtu, "vtu"),
        (Self::Ply, "ply"),
        (Self::Csv, "csv"),
    ];
}

/// The bytes of a file of a map. The same map gives the same bytes.
pub fn export(
    scene: &Scene,
    map: &IlluminationMap,
    preview: &Preview,
    kind: ExportKind,
) -> Vec<u8> {
    match kind {
        ExportKind::Vrml => vrml::write(&shown::Shown::of(scene, map, preview)).into_bytes(),
        ExportKind::X3d => x3d::write(&shown::Shown::of(scene, map, preview)).into_bytes(),
        ExportKind::Vtu => vtu::write(scene, map),
        ExportKind::Ply => ply::write(scene, map, preview),
        ExportKind::Csv => csv::write(map).into_bytes(),
    }
}
