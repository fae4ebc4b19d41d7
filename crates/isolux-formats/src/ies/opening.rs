//! Size and shape of the luminous opening.

use super::Edition;
use isolux::scene::{AreaShape, LuminousArea};

/// The part of a luminaire that shines, in its own frame: length lies in the plane C0-C180, width
/// in C90-C270, height along the vertical.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LuminousOpening {
    /// Outline; `None` where the signs of the sizes follow no table of the standard.
    pub shape: Option<OpeningShape>,
    /// Extent along C0-C180, m.
    pub length_m: f64,
    /// Extent along C90-C270, m.
    pub width_m: f64,
    /// Extent along the vertical, m.
    pub height_m: f64,
}

/// Shapes the standard can tell by the signs of width, length and height.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OpeningShape {
    /// No extent.
    Point,
    /// A rectangle, or a box if it has a height.
    Rectangle,
    /// A horizontal circle or ellipse, or an upright cylinder if it has a height.
    Disc,
    /// A sphere or ellipsoid.
    Ellipsoid,
    /// A cylinder lying along C0-C180.
    CylinderAlongLength,
    /// A cylinder lying along C90-C270.
    CylinderAlongWidth,
    /// An upright circle or ellipse facing C0.
    UprightDisc,
}

impl LuminousOpening {
    /// A rectangle, or a box if it has a height.
    pub(crate) fn rectangle([length_m, width_m, height_m]: [f64; 3]) -> Self {
        let is_point = [length_m, width_m, height_m] == [0.0; 3];
        let shape = if is_point { OpeningShape::Point } else { OpeningShape::Rectangle };
        Self { shape: Some(shape), length_m, width_m, height_m }
    }

    /// A level circle, or an upright cylinder if it has a height.
    pub(crate) fn disc(diameter_m: f64, height_m: f64) -> Self {
        let shape = Some(OpeningShape::Disc);
        Self { shape, length_m: diameter_m, width_m: diameter_m, height_m }
    }

    /// Whether it has no extent, or none that is known.
    pub fn is_point(&self) -> bool {
        let sizes = [self.length_m, self.width_m, self.height_m];
        sizes == [0.0; 3] || matches!(self.shape, None | Some(OpeningShape::Point))
    }

    /// The luminous area in the frame of the luminaire: length along x, width along y, height along z. `None` for a
    /// point.
    pub fn area(&self) -> Option<LuminousArea> {
        let shape = match self.shape {
            _ if self.is_point() => return None,
            Some(OpeningShape::Disc) => AreaShape::CylinderZ,
            Some(OpeningShape::Ellipsoid) => AreaShape::Ellipsoid,
            Some(OpeningShape::CylinderAlongLength | OpeningShape::UprightDisc) => {
                AreaShape::CylinderX
            }
            Some(OpeningShape::CylinderAlongWidth) => AreaShape::CylinderY,
            Some(OpeningShape::Point | OpeningShape::Rectangle) | None => AreaShape::Box,
        };
        let sizes_m = [self.length_m, self.width_m, self.height_m];
        Some(LuminousArea { shape, half_m: sizes_m.map(|size| 0.5 * size), middle_m: [0.0; 3] })
    }

    /// From the numbers as written, in metres, with their signs.
    pub(super) fn from_signed([width, length, height]: [f64; 3], edition: Edition) -> Self {
        let signs = [width, length, height].map(|size| (size > 0.0) as i8 - (size < 0.0) as i8);
        let later = shape_since_2002(signs);
        let earlier = shape_until_1995(signs);
        let shape = if edition >= Edition::E2002 { later.or(earlier) } else { earlier.or(later) };
        let [mut width_m, mut length_m, mut height_m] = [width, length, height].map(f64::abs);
        // A size left at zero repeats the other one of a circle.
        match shape {
            Some(OpeningShape::Disc) if length == 0.0 => length_m = width_m,
            Some(OpeningShape::Disc) if width == 0.0 => width_m = length_m,
            Some(OpeningShape::Ellipsoid) if length == 0.0 => length_m = width_m,
            Some(OpeningShape::CylinderAlongLength) if width == 0.0 => width_m = height_m,
            Some(OpeningShape::CylinderAlongWidth) if length == 0.0 => length_m = height_m,
            _ => {}
        }
        if shape == Some(OpeningShape::Point) {
            (width_m, length_m, height_m) = (0.0, 0.0, 0.0);
        }
        Self { shape, length_m, width_m, height_m }
    }
}

/// A negative size is round in its plane (LM-63-02 and LM-63-19, table 1).
fn shape_since_2002(signs: [i8; 3]) -> Option<OpeningShape> {
    match signs {
        [0, 0, 0] => Some(OpeningShape::Point),
        [0 | 1, 0 | 1, 0 | 1] => Some(OpeningShape::Rectangle),
        [-1, -1, 0 | 1] => Some(OpeningShape::Disc),
        [-1, -1, -1] => Some(OpeningShape::Ellipsoid),
        [-1, 1, -1] => Some(OpeningShape::CylinderAlongLength),
        [1, -1, -1] => Some(OpeningShape::CylinderAlongWidth),
        [-1, 0, -1] => Some(OpeningShape::UprightDisc),
        _ => None,
    }
}

/// A circle is one negative size beside a zero (LM-63-1995).
fn shape_until_1995(signs: [i8; 3]) -> Option<OpeningShape> {
    match signs {
        [0, 0, 0] => Some(OpeningShape::Point),
        [0 | 1, 0 | 1, 0 | 1] => Some(OpeningShape::Rectangle),
        [-1, 0 | 1, 0 | 1] | [0 | 1, -1, 0 | 1] => Some(OpeningShape::Disc),
        [-1, 0 | 1, -1] | [1, -1, -1] => Some(OpeningShape::Ellipsoid),
        [0, 1, -1] => Some(OpeningShape::CylinderAlongLength),
        [1, 0, -1] => Some(OpeningShape::CylinderAlongWidth),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use OpeningShape::*;

    #[test]
    fn signs_mean_shapes_by_edition() {
        let (old, new) = (Edition::E1995, Edition::E2002);
        for (edition, [w, l, h], shape, [width, length, height]) in [
            (old, [0.0, 0.0, 0.0], Some(Point), [0.0, 0.0, 0.0]),
            (new, [0.3, 1.2, 0.0], Some(Rectangle), [0.3, 1.2, 0.0]),
            (old, [0.3, 1.2, 0.1], Some(Rectangle), [0.3, 1.2, 0.1]),
            (old, [-0.2, 0.0, 0.0], Some(Disc), [0.2, 0.2, 0.0]),
            (new, [-0.2, 0.0, 0.0], Some(Disc), [0.2, 0.2, 0.0]),
            (new, [-0.2, -0.2, 0.4], Some(Disc), [0.2, 0.2, 0.4]),
            (old, [-0.2, -0.2, 0.4], Some(Disc), [0.2, 0.2, 0.4]),
            (old, [-0.2, 0.5, 0.1], Some(Disc), [0.2, 0.5, 0.1]),
            (old, [-0.2, 0.0, -0.2], Some(Ellipsoid), [0.2, 0.2, 0.2]),
            (new, [-0.2, -0.3, -0.4], Some(Ellipsoid), [0.2, 0.3, 0.4]),
            (old, [-0.2, 0.5, -0.1], Some(Ellipsoid), [0.2, 0.5, 0.1]),
            (new, [-0.2, 0.5, -0.2], Some(CylinderAlongLength), [0.2, 0.5, 0.2]),
            (old, [0.0, 0.5, -0.2], Some(CylinderAlongLength), [0.2, 0.5, 0.2]),
            (new, [0.5, -0.2, -0.2], Some(CylinderAlongWidth), [0.5, 0.2, 0.2]),
            (old, [0.5, 0.0, -0.2], Some(CylinderAlongWidth), [0.5, 0.2, 0.2]),
            (new, [-0.2, 0.0, -0.2], Some(UprightDisc), [0.2, 0.0, 0.2]),
            (new, [0.0, 0.0, -0.2], None, [0.0, 0.0, 0.2]),
        ] {
            let opening = LuminousOpening::from_signed([w, l, h], edition);
            assert_eq!(opening.shape, shape, "{edition:?} {w} {l} {h}");
            let sizes = [opening.width_m, opening.length_m, opening.height_m];
            assert_eq!(sizes, [width, length, height], "{edition:?} {w} {l} {h}");
        }
    }

    #[test]
    fn areas_have_the_shapes_of_openings() {
        let area = |shape, [length_m, width_m, height_m]: [f64; 3]| {
            LuminousOpening { shape, length_m, width_m, height_m }.area()
        };
        for (shape, expected) in [
            (Rectangle, AreaShape::Box),
            (Disc, AreaShape::CylinderZ),
            (Ellipsoid, AreaShape::Ellipsoid),
            (CylinderAlongLength, AreaShape::CylinderX),
            (UprightDisc, AreaShape::CylinderX),
            (CylinderAlongWidth, AreaShape::CylinderY),
        ] {
            let found = area(Some(shape), [0.6, 0.2, 0.1]);
            assert_eq!(
                found,
                Some(LuminousArea {
                    shape: expected,
                    half_m: [0.3, 0.1, 0.05],
                    middle_m: [0.0; 3]
                })
            );
        }
        for (shape, sizes) in [(Some(Point), [0.1; 3]), (None, [0.1; 3]), (Some(Disc), [0.0; 3])] {
            assert_eq!(area(shape, sizes), None);
        }
    }
}
