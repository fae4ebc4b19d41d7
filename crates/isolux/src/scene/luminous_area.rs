//! The luminous area of a luminaire.

use isolux_geometry::{Direction, Vector};
use serde::{Deserialize, Serialize};
use std::f64::consts::{PI, TAU};

/// The places that the light of a luminaire leaves from, in the frame of the luminaire. From each
/// place leaves the same share of the light, with the whole intensity distribution: that is what a photometric file
/// says. Far away it is a point.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct LuminousArea {
    /// Outline.
    pub shape: AreaShape,
    /// Half of the extent along x, y and z, m. Zero where it is flat.
    pub half_m: [f64; 3],
    /// Its middle from the position of the luminaire, m: other than zero where a surface cuts off one side.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub middle_m: [f64; 3],
}

fn is_zero(middle_m: &[f64; 3]) -> bool {
    *middle_m == [0.0; 3]
}

/// Points around a border.
const AROUND: u32 = 32;

/// The outline of a luminous area within its extent.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum AreaShape {
    /// A box; a rectangle where it is flat.
    Box,
    /// A cylinder along x, round in y and z.
    CylinderX,
    /// A cylinder along y, round in x and z.
    CylinderY,
    /// An upright cylinder, round in x and y; a disc where it is flat.
    CylinderZ,
    /// An ellipsoid.
    Ellipsoid,
}

impl AreaShape {
    /// The axis of a cylinder and the two in which it is round.
    const fn axes(self) -> Option<[usize; 3]> {
        match self {
            Self::CylinderX => Some([0, 1, 2]),
            Self::CylinderY => Some([1, 2, 0]),
            Self::CylinderZ => Some([2, 0, 1]),
            Self::Box | Self::Ellipsoid => None,
        }
    }
}

impl LuminousArea {
    /// The place, from the position of the luminaire, for three numbers from 0 to 1. Even numbers give even places.
    pub fn place(&self, [a, b, c]: [f64; 3]) -> Vector {
        let share = if let Some([along, u, v]) = self.shape.axes() {
            let (s, t) = libm::sincos(TAU * b);
            let mut share = [0.0; 3];
            (share[u], share[v], share[along]) = (a.sqrt() * t, a.sqrt() * s, 2.0 * c - 1.0);
            share
        } else if self.shape == AreaShape::Box {
            [a, b, c].map(|x| 2.0 * x - 1.0)
        } else {
            let height = 2.0 * a - 1.0;
            let (s, t) = libm::sincos(TAU * b);
            let beside = (1.0 - height * height).max(0.0).sqrt();
            [beside * t, beside * s, height].map(|x| x * libm::cbrt(c))
        };
        let [x, y, z] = [0, 1, 2].map(|k| self.middle_m[k] + share[k] * self.half_m[k]);
        Vector::new(x, y, z)
    }

    /// Whether the third number of a place changes nothing: boxes and discs without height.
    pub fn is_flat(&self) -> bool {
        matches!(self.shape, AreaShape::Box | AreaShape::CylinderZ) && self.half_m[2] == 0.0
    }

    /// The radius of a sphere about the position that contains all places, m.
    pub fn radius_m(&self) -> f64 {
        let [x, y, z] = self.half_m;
        // Allowance for the rounding of a length and of the steps after it.
        let reach_m = match self.shape.axes() {
            Some([along, u, v]) => {
                libm::hypot(self.half_m[along], self.half_m[u].max(self.half_m[v]))
            }
            None if self.shape == AreaShape::Box => Vector::new(x, y, z).length(),
            None => x.max(y).max(z),
        };
        (reach_m + Vector::from(self.middle_m).length()) * (1.0 + 1e-12)
    }

    /// Places of its border, from the position: the corners of a box, points around ends, or over an ellipsoid. No other
    /// place lies far beyond their hull.
    pub fn border(&self) -> Vec<Vector> {
        let steps = |k: u32, of: u32| f64::from(k) / f64::from(of);
        let all = |of: [u32; 3], number: &dyn Fn([u32; 3]) -> [f64; 3]| {
            let count = of[0] * of[1] * of[2];
            let split = |k: u32| [k % of[0], k / of[0] % of[1], k / of[0] / of[1]];
            (0..count).map(|k| self.place(number(split(k)))).collect()
        };
        match self.shape {
            AreaShape::Box => all([2, 2, 2], &|k| k.map(f64::from)),
            AreaShape::Ellipsoid => {
                all([7, AROUND, 1], &|[i, j, _]| [steps(i, 6), steps(j, AROUND), 1.0])
            }
            _ => all([AROUND, 2, 1], &|[i, j, _]| [1.0, steps(i, AROUND), f64::from(j)]),
        }
    }

    /// The area of its outline as seen along a direction in the frame of the luminaire, m2. Intensity over it is
    /// luminance.
    pub fn seen_m2(&self, along: Direction) -> f64 {
        let d = along.to_vector();
        let d = [d.x, d.y, d.z];
        let h = self.half_m;
        let face = |k: usize, i: usize, j: usize| d[k].abs() * h[i] * h[j];
        if let Some([k, i, j]) = self.shape.axes() {
            return PI * face(k, i, j) + 4.0 * h[k] * libm::hypot(h[j] * d[i], h[i] * d[j]);
        }
        let faces = [face(0, 1, 2), face(1, 2, 0), face(2, 0, 1)];
        match self.shape {
            AreaShape::Ellipsoid => PI * faces.iter().map(|f| f * f).sum::<f64>().sqrt(),
            _ => 4.0 * faces.iter().sum::<f64>(),
        }
    }

    /// The range of distances at which a ray is inside, in lengths of `direction`; `None` where it misses. Both are
    /// in the frame of the luminaire.
    pub fn crossed(&self, origin: Vector, direction: Vector) -> Option<[f64; 2]> {
        let (origin, d) = (origin - Vector::from(self.middle_m), direction);
        let (o, d) = ([origin.x, origin.y, origin.z], [d.x, d.y, d.z]);
        let slab = |k: usize| between(o[k], d[k], self.half_m[k]);
        let both = |a: [f64; 2], b: [f64; 2]| {
            let range = [a[0].max(b[0]), a[1].min(b[1])];
            (range[0] <= range[1]).then_some(range)
        };
        if let Some([along, u, v]) = self.shape.axes() {
            return both(slab(along)?, round(&[u, v], (o, d), self.half_m)?);
        }
        match self.shape {
            AreaShape::Ellipsoid => round(&[0, 1, 2], (o, d), self.half_m),
            _ => both(both(slab(0)?, slab(1)?)?, slab(2)?),
        }
    }
}

/// Where a ray is between two planes at plus and minus half of the thickness.
fn between(origin: f64, step: f64, half: f64) -> Option<[f64; 2]> {
    if step == 0.0 {
        return (origin.abs() <= half).then_some([f64::NEG_INFINITY, f64::INFINITY]);
    }
    let ends = [(-half - origin) / step, (half - origin) / step];
    Some([ends[0].min(ends[1]), ends[0].max(ends[1])])
}

/// Where a ray is inside of an ellipsoid, or of a cylinder, that is round in some axes.
fn round(axes: &[usize], (o, d): ([f64; 3], [f64; 3]), half: [f64; 3]) -> Option<[f64; 2]> {
    let [mut square, mut linear, mut rest] = [0.0, 0.0, -1.0];
    for &k in axes {
        let (o, d) = (o[k] / half[k], d[k] / half[k]);
        square += d * d;
        linear += o * d;
        rest += o * o;
    }
    if square == 0.0 {
        return (rest <= 0.0).then_some([f64::NEG_INFINITY, f64::INFINITY]);
    }
    let root = linear * linear - square * rest;
    (root >= 0.0).then(|| [-1.0, 1.0].map(|sign| (sign * root.sqrt() - linear) / square))
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "tests stop at the first surprise")]

    use super::*;
    use crate::sampling::Key;

    const SHAPES: [AreaShape; 5] = [
        AreaShape::Box,
        AreaShape::CylinderX,
        AreaShape::CylinderY,
        AreaShape::CylinderZ,
        AreaShape::Ellipsoid,
    ];

    fn numbers(k: u64) -> [f64; 3] {
        [0, 1, 2].map(|n| Key::new(3).with(k).with(n).uniform())
    }

    #[test]
    fn places_lie_inside_and_fill_it_evenly() {
        for shape in SHAPES {
            let area = LuminousArea { shape, half_m: [0.6, 0.2, 0.1], middle_m: [0.0; 3] };
            let (mut mean, mut square) = (Vector::ZERO, [0.0; 3]);
            const PLACES: u64 = 20_000;
            for k in 0..PLACES {
                let p = area.place(numbers(k));
                assert!(p.length() <= area.radius_m());
                let inside = area.crossed(p, Vector::new(0.3, -0.5, 0.8)).unwrap();
                assert!(inside[0] <= 1e-9 && inside[1] >= -1e-9, "{shape:?} {p:?}");
                mean += p / PLACES as f64;
                square =
                    std::array::from_fn(|k| square[k] + p.component(k).powi(2) / PLACES as f64);
            }
            assert!(mean.length() < 0.02, "{shape:?} {mean:?}");
            // The second moment along an axis: a third for a box, a quarter for a disc, a fifth for a ball.
            for (axis, found) in square.into_iter().enumerate() {
                let is_round = match shape.axes() {
                    Some([along, ..]) => axis != along,
                    None => false,
                };
                let share = match shape {
                    AreaShape::Ellipsoid => 0.2,
                    _ if is_round => 0.25,
                    _ => 1.0 / 3.0,
                };
                let expected = share * area.half_m[axis] * area.half_m[axis];
                assert!((found / expected - 1.0).abs() < 0.03, "{shape:?} {axis}");
            }
        }
    }

    /// The outline as seen along a direction, by counting parallel rays that meet it.
    #[test]
    fn the_outline_is_what_rays_meet() {
        for shape in SHAPES {
            let area = LuminousArea { shape, half_m: [0.6, 0.2, 0.1], middle_m: [0.0; 3] };
            for [x, y, z] in [[0.0, 0.0, -1.0], [0.5, 0.4, -0.7], [1.0, 0.2, 0.1]] {
                let along = Vector::new(x, y, z).direction().unwrap();
                let (u, v) = along.frame();
                const RAYS: u64 = 40_000;
                let meets = |k: &u64| {
                    let [a, b, _] = numbers(*k).map(|x| 2.0 * x - 1.0);
                    let start = u * a + v * b - along.to_vector() * 5.0;
                    area.crossed(start, along.to_vector()).is_some()
                };
                let counted = 4.0 * (0..RAYS).filter(meets).count() as f64 / RAYS as f64;
                let told = area.seen_m2(along);
                // Five standard deviations of the count.
                let sigma = 4.0 * (told / 4.0 / RAYS as f64).sqrt();
                assert!((counted - told).abs() < 5.0 * sigma, "{shape:?} {counted} {told}");
            }
        }
    }

    #[test]
    fn borders_reach_the_whole_extent() {
        for shape in SHAPES {
            let area = LuminousArea { shape, half_m: [0.6, 0.2, 0.1], middle_m: [0.0; 3] };
            let border = area.border();
            for (axis, half) in area.half_m.into_iter().enumerate() {
                let reach =
                    |sign: f64| border.iter().map(|p| sign * p.component(axis)).fold(0.0, f64::max);
                for found in [reach(1.0), reach(-1.0)] {
                    assert!((found - half).abs() < 1e-9, "{shape:?} {axis} {found}");
                }
            }
        }
    }

    #[test]
    fn flat_areas_are_met_from_below_and_missed_from_the_side() {
        let disc = LuminousArea {
            shape: AreaShape::CylinderZ,
            half_m: [0.2, 0.2, 0.0],
            middle_m: [0.0; 3],
        };
        let down = Vector::new(0.0, 0.0, -1.0);
        assert_eq!(disc.crossed(Vector::new(0.1, 0.0, 2.0), down), Some([2.0, 2.0]));
        assert_eq!(disc.crossed(Vector::new(0.3, 0.0, 2.0), down), None);
        assert_eq!(disc.crossed(Vector::new(1.0, 0.0, 0.1), Vector::new(-1.0, 0.0, 0.0)), None);
    }
}
