//! What a plan says.

/// The words of a plan in a language.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PlanWords {
    /// What the values are, with their unit.
    pub values: &'static str,
    /// What a level plane cuts.
    pub cut_at_height: &'static str,
    /// What another plane cuts.
    pub cut_by_plane: &'static str,
    /// What lies closely below a level plane.
    pub below: &'static str,
    /// What lies closely behind another plane.
    pub behind: &'static str,
    /// A luminaire.
    pub luminaire: &'static str,
    /// The border of the grid.
    pub grid: &'static str,
    /// One of its points.
    pub point: &'static str,
    /// Between the whole and the broken part of numbers.
    pub decimal_point: char,
}

impl PlanWords {
    /// Illuminance, in English.
    pub const ENGLISH: Self = Self {
        values: "Illuminance in lx",
        cut_at_height: "cut at this height",
        cut_by_plane: "cut by this plane",
        below: "just below",
        behind: "just behind",
        luminaire: "luminaire",
        grid: "grid",
        point: "grid point",
        decimal_point: '.',
    };

    /// A number with the point of the language.
    pub fn local(&self, number: &str) -> String {
        number.replace('.', self.decimal_point.encode_utf8(&mut [0; 4]))
    }
}
