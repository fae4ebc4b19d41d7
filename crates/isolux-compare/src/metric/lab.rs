//! Colours as CIE 1976 L\*a\*b\* has them.

use serde::Serialize;

/// Relative luminance where the cube root takes over from a straight line: (6 / 29)^3.
const EPSILON: f64 = 216.0 / 24389.0;

/// Slope of L\* over relative luminance below that: (29 / 3)^3.
const KAPPA: f64 = 24389.0 / 27.0;

/// Tristimulus values of CIE 1931 are in any unit that their white shares.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Xyz {
    /// X.
    pub x: f64,
    /// Y, a luminance or in proportion to one.
    pub y: f64,
    /// Z.
    pub z: f64,
}

impl From<[f64; 3]> for Xyz {
    fn from([x, y, z]: [f64; 3]) -> Self {
        Self { x, y, z }
    }
}

/// A white is a colour that others are seen beside: all of its components are above zero.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct White(Xyz);

impl White {
    /// The white of these values; `None` unless each is finite and above zero.
    pub fn new(xyz: Xyz) -> Option<Self> {
        [xyz.x, xyz.y, xyz.z].iter().all(|&v| v.is_finite() && v > 0.0).then_some(Self(xyz))
    }
}

/// A colour of CIE 1976 L\*a\*b\* has no unit; white is at (100, 0, 0).
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Lab {
    /// Lightness L\*, 0 of black to 100 of the white, and more above it.
    pub l: f64,
    /// From green to red, a\*.
    pub a: f64,
    /// From blue to yellow, b\*.
    pub b: f64,
}

impl Lab {
    /// The colour beside its white: CIE 15:2004, with constants as quotients of integers, at which
    /// the line and the cube root meet. The line goes on below zero.
    pub fn from_xyz(xyz: Xyz, White(white): White) -> Self {
        let [x, y, z] = [xyz.x / white.x, xyz.y / white.y, xyz.z / white.z].map(compressed);
        Self { l: 116.0 * y - 16.0, a: 500.0 * (x - y), b: 200.0 * (y - z) }
    }

    /// The chroma C\*ab, the distance from grey of the same lightness.
    pub fn chroma(&self) -> f64 {
        (self.a * self.a + self.b * self.b).sqrt()
    }
}

impl From<[f64; 3]> for Lab {
    fn from([l, a, b]: [f64; 3]) -> Self {
        Self { l, a, b }
    }
}

/// The cube root of a share of white, a straight line near black.
fn compressed(share: f64) -> f64 {
    if share > EPSILON { libm::cbrt(share) } else { (KAPPA * share + 16.0) / 116.0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tolerance::ROUNDING;

    const DAYLIGHT: Xyz = Xyz { x: 95.047, y: 100.0, z: 108.883 };

    fn lab(share_of_white: f64) -> Lab {
        let Xyz { x, y, z } = DAYLIGHT;
        let xyz = [x, y, z].map(|v| v * share_of_white).into();
        Lab::from_xyz(xyz, White::new(DAYLIGHT).unwrap())
    }

    #[test]
    fn white_has_lightness_100_and_black_0() {
        assert_eq!(lab(1.0), Lab { l: 100.0, a: 0.0, b: 0.0 });
        assert!(lab(0.0).l.abs() < ROUNDING && lab(0.0).chroma() < ROUNDING);
    }

    #[test]
    fn the_line_meets_the_cube_root_at_lightness_8() {
        for share in [EPSILON * (1.0 - f64::EPSILON), EPSILON, EPSILON * (1.0 + f64::EPSILON)] {
            assert!((lab(share).l - 8.0).abs() < ROUNDING, "{share}");
        }
        assert!((lab(0.5 * EPSILON).l - 4.0).abs() < ROUNDING);
        assert!((lab(-EPSILON).l + 8.0).abs() < ROUNDING);
    }

    #[test]
    fn more_red_than_white_is_positive_a() {
        let white = White::new(DAYLIGHT).unwrap();
        let red = Lab::from_xyz(Xyz { x: 50.0, y: 30.0, z: 5.0 }, white);
        assert!(red.a > 0.0 && red.b > 0.0, "{red:?}");
    }

    #[test]
    fn what_gives_no_light_is_no_white() {
        for broken in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert_eq!(White::new([broken, 1.0, 1.0].into()), None);
            assert_eq!(White::new([1.0, 1.0, broken].into()), None);
        }
    }
}
