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

pub use csv::csv;

use crate::map_glb::{self, Preview};
use isolux::map::IlluminationMap;
use isolux::scene::Scene;
use isolux::units::Digits;
use std::fs::File;
use std::io::Read;
use std::path::Path;

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
        ExportKind::Csv => csv(map, Digits::ByError).into_bytes(),
    }
}

/// Whether nothing is lost with a file whose name says that it may be a scene or a map (`.glb`, `.ply`): it holds what was
/// exported from a map. Files of other kinds may always be replaced.
pub fn may_be_replaced(path: &Path) -> bool {
    let extension = path.extension().map(|e| e.to_string_lossy().to_lowercase());
    match extension.as_deref() {
        Some("glb") => map_glb::is_export(path),
        Some("ply") => is_ply_of_ours(path),
        _ => true,
    }
}

fn is_ply_of_ours(path: &Path) -> bool {
    let mut start = vec![0; ply::START.len()];
    let read = File::open(path).and_then(|mut file| file.read_exact(&mut start));
    read.is_ok() && start == ply::START.as_bytes()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_no_export_wrote_is_not_to_be_replaced() {
        let home = tempfile::tempdir().unwrap();
        let may = |name: &str, contents: &[u8]| {
            let path = home.path().join(name);
            std::fs::write(&path, contents).unwrap();
            may_be_replaced(&path)
        };
        assert!(!may("scan.ply", b"ply\nformat ascii 1.0\nend_header\n"));
        assert!(may("map.ply", ply::header(0, 0).as_bytes()));
        assert!(may("map.csv", b"anything"));
        let glb = |extras: &str| {
            let mut json = format!("{{\"asset\":{{\"version\":\"2.0\"}},\"extras\":{extras}}}");
            json += &" ".repeat(json.len().next_multiple_of(4) - json.len());
            let words = [2, json.len() as u32 + 20, json.len() as u32];
            let words = words.map(u32::to_le_bytes).concat();
            [b"glTF", &words[..], b"JSON", json.as_bytes()].concat()
        };
        for (extras, expected) in [
            ("{}", false),
            ("{\"isolux\":{}}", false),
            ("{\"isolux\":{},\"isolux_lightmap\":{}}", false),
            ("{\"isolux_lightmap\":{}}", true),
            ("{\"isolux_vertices\":{}}", true),
        ] {
            assert_eq!(may("m.glb", &glb(extras)), expected, "{extras}");
        }
        assert!(!may("cut.glb", b"glTF"));
    }
}
