//! CUBE in numbers.

use isolux::units::Rgb;

/// Half the edge of the cube, m.
pub const HALF_EDGE_M: f64 = 5.0;
/// Intensity of the luminaire, cd.
pub const INTENSITY_CD: f64 = 50_000.0;
/// Reflectance of the walls.
pub const REFLECTANCE: f64 = 2.0 / 3.0;
/// Reflectances of the coloured cube: red, green, blue.
pub const COLOURED_REFLECTANCE: Rgb = Rgb::new(0.8, 2.0 / 3.0, 0.3);

/// A point of Table 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TablePoint {
    /// Its letter.
    pub name: char,
    /// Place on the face, edges at +-1.
    pub x: f64,
    /// Place on the face, edges at +-1.
    pub y: f64,
    /// Luminance as printed, cd/m2.
    pub luminance_cd_m2: f64,
    /// Number of points like it among the 25 of the grid.
    pub weight: f64,
}

const fn point(name: char, x: f64, y: f64, luminance_cd_m2: f64, weight: f64) -> TablePoint {
    TablePoint { name, x, y, luminance_cd_m2, weight }
}

/// Table 1 as printed.
pub const TABLE_1: [TablePoint; 6] = [
    point('A', 0.0, 0.0, 892.8, 1.0),
    point('B', 0.5, 0.0, 768.7, 4.0),
    point('C', 0.5, 0.5, 686.6, 4.0),
    point('D', 1.0, 0.0, 565.1, 4.0),
    point('E', 1.0, 0.5, 522.4, 8.0),
    point('F', 1.0, 1.0, 388.4, 4.0),
];
