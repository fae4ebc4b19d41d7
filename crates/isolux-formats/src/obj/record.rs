//! OBJ and MTL as written.

use isolux::units::Rgb;

/// An OBJ file.
#[derive(Debug, Default)]
pub(super) struct ObjFile {
    pub(super) positions: Vec<[f64; 3]>,
    /// `v` upwards, as written.
    pub(super) uvs: Vec<[f64; 2]>,
    pub(super) normals: Vec<[f64; 3]>,
    /// What `mtllib` names.
    pub(super) libraries: Vec<Named>,
    pub(super) parts: Vec<Part>,
}

/// The faces of one object or group with one material.
#[derive(Debug)]
pub(super) struct Part {
    pub(super) name: String,
    /// What `usemtl` names.
    pub(super) material: Option<Named>,
    /// Corners of all faces, one after the other.
    pub(super) corners: Vec<Corner>,
    pub(super) faces: Vec<Face>,
}

/// Where a face starts in the corners of its part, and in the file.
#[derive(Clone, Copy, Debug)]
pub(super) struct Face {
    pub(super) first_corner: usize,
    pub(super) line: usize,
}

/// Indices from zero.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) struct Corner {
    pub(super) position: u32,
    pub(super) uv: Option<u32>,
    pub(super) normal: Option<u32>,
}

/// A name and the line it stands on.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Named {
    pub(super) name: String,
    pub(super) line: usize,
}

/// One material of an MTL file.
#[derive(Clone, Debug, Default)]
pub(super) struct MtlMaterial {
    pub(super) name: String,
    pub(super) line: usize,
    pub(super) kd: Option<Rgb>,
    pub(super) ks: Option<Rgb>,
    pub(super) ke: Option<Rgb>,
    pub(super) tf: Option<Rgb>,
    pub(super) ni: Option<f64>,
    /// Opacity.
    pub(super) d: Option<f64>,
    /// By the letter the complement of opacity.
    pub(super) tr: Option<f64>,
    pub(super) illum: Option<u32>,
    pub(super) map_kd: Option<Named>,
}

impl MtlMaterial {
    /// Opacity; `d` counts where both it and `Tr` are given, because writers disagree on the sense of `Tr`.
    pub(super) fn dissolve(&self) -> f64 {
        self.d.or(self.tr.map(|tr| 1.0 - tr)).unwrap_or(1.0)
    }

    /// Whether its `illum` lets light through.
    pub(super) fn is_transmitting(&self) -> bool {
        matches!(self.illum, Some(4 | 6 | 7 | 9))
    }
}

impl Part {
    /// The corners of a face.
    pub(super) fn corners_of(&self, face: usize) -> &[Corner] {
        let end = self.faces.get(face + 1).map_or(self.corners.len(), |next| next.first_corner);
        &self.corners[self.faces[face].first_corner..end]
    }
}
