//! Size and shape of the luminous opening.

use super::Edition;

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
}
