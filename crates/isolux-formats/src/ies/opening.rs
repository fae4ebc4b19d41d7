//! Size and shape of the luminous opening.

use super::Edition;
use isolux::geometry::Vector;

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

/// More points than this fill no opening: they would be a millimetre apart in most.
const MOST_POINTS: usize = 100_000;

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

    /// Points that fill it evenly, at most so far apart, about its middle in the luminaire's frame (length
    /// along x, width along y, height along z), m: flat shapes their area, the others their volume.
    /// `None` if they would be more than a hundred thousand.
    ///
    /// The points are the middles of the cells of a grid, of which those inside the shape are kept; a
    /// shape is symmetric, and so are they.
    pub fn points_m(&self, spacing_m: f64) -> Option<Vec<Vector>> {
        if self.is_point() {
            return Some(vec![Vector::default()]);
        }
        let sizes = [self.length_m, self.width_m, self.height_m];
        let counts = sizes.map(|size| (size / spacing_m).ceil().max(1.0));
        let whole = counts.iter().product::<f64>();
        if whole > MOST_POINTS as f64 {
            return None;
        }
        let [nx, ny, nz] = counts.map(|count| count as usize);
        // Opposite places are opposite to the last bit.
        let middle = |k: usize, n: usize| (2.0 * k as f64 + 1.0 - n as f64) / (2.0 * n as f64);
        let mut points = Vec::new();
        for k in 0..nz {
            for j in 0..ny {
                for i in 0..nx {
                    let shares = [middle(i, nx), middle(j, ny), middle(k, nz)];
                    if self.holds(shares) {
                        let [x, y, z] = [0, 1, 2].map(|axis| shares[axis] * sizes[axis]);
                        points.push(Vector::new(x, y, z));
                    }
                }
            }
        }
        Some(points)
    }

    /// Whether a place, in shares of the sizes from the middle, lies inside the shape.
    fn holds(&self, [x, y, z]: [f64; 3]) -> bool {
        let round = |a: f64, b: f64, c: f64| a * a + b * b + c * c <= 0.25;
        match self.shape {
            Some(OpeningShape::Disc) => round(x, y, 0.0),
            Some(OpeningShape::Ellipsoid) => round(x, y, z),
            Some(OpeningShape::CylinderAlongLength | OpeningShape::UprightDisc) => round(0.0, y, z),
            Some(OpeningShape::CylinderAlongWidth) => round(x, 0.0, z),
            Some(OpeningShape::Point | OpeningShape::Rectangle) | None => true,
        }
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
    fn points_fill_every_shape_evenly() {
        let opening = |shape, [length_m, width_m, height_m]: [f64; 3]| LuminousOpening {
            shape: Some(shape),
            length_m,
            width_m,
            height_m,
        };
        // The mean of x^2 of a length, a circle and a ball of size 1: 1/12, 1/16, 1/20.
        for (shape, sizes, moments) in [
            (Rectangle, [1.0, 0.5, 0.0], [1.0 / 12.0, 0.25 / 12.0, 0.0]),
            (Rectangle, [1.0, 0.5, 0.25], [1.0 / 12.0, 0.25 / 12.0, 0.0625 / 12.0]),
            (Disc, [1.0, 1.0, 0.0], [1.0 / 16.0, 1.0 / 16.0, 0.0]),
            (Disc, [1.0, 0.5, 0.5], [1.0 / 16.0, 0.25 / 16.0, 0.25 / 12.0]),
            (Ellipsoid, [1.0, 1.0, 1.0], [0.05; 3]),
            (CylinderAlongLength, [1.0, 0.5, 0.5], [1.0 / 12.0, 0.25 / 16.0, 0.25 / 16.0]),
            (CylinderAlongWidth, [0.5, 1.0, 0.5], [0.25 / 16.0, 1.0 / 12.0, 0.25 / 16.0]),
            (UprightDisc, [0.0, 1.0, 1.0], [0.0, 1.0 / 16.0, 1.0 / 16.0]),
        ] {
            let points = opening(shape, sizes).points_m(0.025).unwrap();
            let count = points.len() as f64;
            let mean = |f: &dyn Fn(&Vector) -> f64| points.iter().map(f).sum::<f64>() / count;
            for (axis, moment) in moments.into_iter().enumerate() {
                let of = |v: &Vector| [v.x, v.y, v.z][axis];
                // Symmetric but for the rounding of thousands of additions; the moment of n cells lacks
                // 1/n^2 of it, 1 % of the 10 across the shortest side, and as much at curved borders.
                assert!(mean(&of).abs() < 1e-12, "{shape:?} {axis}");
                let square = mean(&|v| of(v) * of(v));
                assert!((square - moment).abs() <= 0.02 * moment, "{shape:?} {axis}: {square}");
            }
        }
        let coarse = opening(Disc, [0.2, 0.2, 0.0]).points_m(1.0).unwrap();
        assert_eq!(coarse, [Vector::default()]);
        assert_eq!(opening(Disc, [2.0, 2.0, 2.0]).points_m(1e-6), None);
        assert_eq!(opening(Point, [0.0; 3]).points_m(0.1).unwrap().len(), 1);
    }
}
