//! The table of a file of either kind, before anything is mirrored.

use crate::ies::PhotometricType;
use crate::photometric_file::PhotometricFile;

/// Rows of intensities, in units of the file.
pub(super) struct Table {
    pub(super) photometric_type: PhotometricType,
    /// Angle of each row, degrees: planes, or horizontal angles.
    pub(super) across_deg: Vec<f64>,
    /// Angle of each column, degrees: gamma, or vertical angles.
    pub(super) along_deg: Vec<f64>,
    /// `candela[row * columns + column]`.
    pub(super) candela: Vec<f64>,
    /// Line of each of them, from 1.
    lines: Lines,
    /// Lines where the angles begin.
    pub(super) across_line: usize,
    pub(super) along_line: usize,
}

enum Lines {
    Listed(Vec<u32>),
    /// One a line, from this one on.
    Successive(usize),
}

impl Table {
    pub(super) fn of(file: &PhotometricFile) -> Self {
        match file {
            PhotometricFile::Ies(file) => Self {
                photometric_type: file.photometric_type,
                across_deg: file.horizontal_deg.clone(),
                along_deg: file.vertical_deg.clone(),
                candela: file.candela.clone(),
                lines: Lines::Listed(file.intensity_lines.clone()),
                across_line: file.lines.horizontal,
                along_line: file.lines.vertical,
            },
            PhotometricFile::Ldt(file) => {
                let given = file.symmetry.given(file.planes_deg.len());
                Self {
                    photometric_type: PhotometricType::C,
                    across_deg: given.iter().map(|&k| file.planes_deg[k]).collect(),
                    along_deg: file.gammas_deg.clone(),
                    candela: file.candela_per_klm.clone(),
                    lines: Lines::Successive(file.lines.candela),
                    across_line: file.lines.planes,
                    along_line: file.lines.gammas,
                }
            }
        }
    }

    pub(super) fn rows(&self) -> usize {
        self.across_deg.len()
    }

    pub(super) fn columns(&self) -> usize {
        self.along_deg.len()
    }

    pub(super) fn at(&self, row: usize, column: usize) -> f64 {
        self.candela[row * self.columns() + column]
    }

    /// Line of a value, from 1.
    pub(super) fn line(&self, row: usize, column: usize) -> usize {
        let index = row * self.columns() + column;
        match &self.lines {
            Lines::Listed(lines) => lines.get(index).map_or(0, |line| *line as usize),
            Lines::Successive(first) => first + index,
        }
    }

    /// The greatest value.
    pub(super) fn most(&self) -> f64 {
        self.candela.iter().copied().fold(0.0, f64::max)
    }

    /// Name of a place.
    pub(super) fn place(&self, row: usize, column: usize) -> String {
        let (across, along) = (self.across_deg[row], self.along_deg[column]);
        match self.photometric_type {
            PhotometricType::C => format!("C {across}, gamma {along}"),
            PhotometricType::A | PhotometricType::B => format!("H {across}, V {along}"),
        }
    }
}
