//! OBJ and MTL as written.

use isolux::units::Rgb;

/// An OBJ file.
#[derive(Debug, Default)]
pub(super) struct ObjFile {
    pub(super) positions: Vec<[f64; 3]>,
    /// Colours that stand behind positions.
    pub(super) colours: Colours,
    /// `v` upwards, as written.
    pub(super) uvs: Vec<[f64; 2]>,
    pub(super) normals: Vec<[f64; 3]>,
    /// What `mtllib` names.
    pub(super) libraries: Vec<Named>,
    pub(super) parts: Vec<Part>,
}

/// Colours of vertices, as written.
#[derive(Debug, Default)]
pub(super) struct Colours {
    /// By vertex, up to the last that has one.
    list: Vec<Option<[f32; 3]>>,
    largest: f32,
    /// The line of the first.
    pub(super) first_line: usize,
    pub(super) count: usize,
}

impl Colours {
    /// Takes the colour of a vertex.
    pub(super) fn push(&mut self, vertex: usize, colour: [f64; 3], line: usize) {
        if self.count == 0 {
            self.first_line = line;
        }
        self.count += 1;
        let colour = colour.map(|c| c as f32);
        self.largest = colour.into_iter().fold(self.largest, f32::max);
        self.list.resize(vertex, None);
        self.list.push(Some(colour));
    }

    /// The sRGB codes of a vertex. Programs write shares of the code range; where a number of the file is above 1, codes.
    pub(super) fn codes(&self, vertex: u32) -> Option<[u8; 3]> {
        let scale = if self.largest > 1.0 { 1.0 } else { 255.0 };
        let colour = self.list.get(vertex as usize).copied().flatten()?;
        // Casts keep within the range.
        Some(colour.map(|c| (scale * c).round() as u8))
    }
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
