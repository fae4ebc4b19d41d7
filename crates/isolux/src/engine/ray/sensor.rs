//! Receivers with a bent surface, so small that light is the same all over them: cylinders, half cylinders and hemispheres.

use isolux_geometry::{Direction, Normal, Vector};
use std::f64::consts::{PI, TAU};

/// A small receiver with a bent surface. Its illuminance is the mean over that surface, as CIE S 017 defines it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sensor {
    shape: Shape,
    /// The axis, or the pole of a hemisphere.
    up: Direction,
    /// At right angles to it: the way that a half cylinder faces.
    ahead: Direction,
    /// At right angles to both.
    aside: Direction,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Shape {
    Cylinder,
    HalfCylinder,
    Hemisphere,
}

impl Sensor {
    /// The side of a cylinder about `up`, without its ends: the mean of planar illuminances over all azimuths.
    pub fn cylinder(up: Direction) -> Self {
        Self::about(up, Shape::Cylinder)
    }

    /// The bent side of half a cylinder about `up`, whose flat side looks away from `facing`; `None` if that is along `up`.
    pub fn half_cylinder(up: Direction, facing: Vector) -> Option<Self> {
        let ahead = (facing - up * facing.dot(up.to_vector())).direction()?;
        let aside = up.to_vector().cross(ahead.to_vector()).direction()?;
        Some(Self { shape: Shape::HalfCylinder, up, ahead, aside })
    }

    /// The bent side of half a ball that lies on its flat side, with its pole at `up`.
    pub fn hemisphere(up: Direction) -> Self {
        Self::about(up, Shape::Hemisphere)
    }

    fn about(up: Direction, shape: Shape) -> Self {
        let (ahead, aside) = up.frame();
        Self { shape, up, ahead, aside }
    }

    /// The axis, or the pole of a hemisphere.
    pub const fn up(&self) -> Direction {
        self.up
    }

    /// The normal at a place of the surface: maps the unit square, evenly by area.
    pub(crate) fn normal(&self, [a, b]: [f64; 2]) -> Normal {
        let (level, height) = match self.shape {
            Shape::Cylinder => (TAU * a, 0.0),
            Shape::HalfCylinder => (PI * (a - 0.5), 0.0),
            // Zones of a ball have areas in proportion to their heights (Archimedes).
            Shape::Hemisphere => (TAU * a, b),
        };
        let (sin, cos) = libm::sincos(level);
        let flat = (1.0 - height * height).sqrt();
        let way = self.ahead * (flat * cos) + self.aside * (flat * sin) + self.up * height;
        way.normal().unwrap_or_else(|| self.ahead.to_normal())
    }

    /// The illuminance by parallel light from a direction, as a share of that of a plane that faces it: the outline as seen from
    /// there over the bent area. EN 13201-3 has the half cylinder and the hemisphere.
    pub(crate) fn share(&self, towards: Direction) -> f64 {
        let height = towards.dot(self.up);
        let flat = (1.0 - height * height).max(0.0).sqrt();
        match self.shape {
            Shape::Cylinder => flat / PI,
            Shape::HalfCylinder => (flat + towards.dot(self.ahead)).max(0.0) / PI,
            Shape::Hemisphere => 0.25 * (1.0 + height).max(0.0),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sensors() -> [Sensor; 3] {
        let up = Vector::new(0.2, -0.3, 0.9).direction().unwrap();
        let facing = Vector::new(1.0, 0.5, 0.0);
        [Sensor::cylinder(up), Sensor::half_cylinder(up, facing).unwrap(), Sensor::hemisphere(up)]
    }

    /// The mean of planar illuminances over the surface is what the outline takes of parallel light. The midpoint rule errs in
    /// proportion to the square of the step where a cosine has a bend: 1e-5 with 400 steps (measured for these, November 2026: 3e-6).
    #[test]
    fn shares_are_means_over_normals() {
        const STEPS: u32 = 400;
        let middle = |k: u32| (f64::from(k) + 0.5) / f64::from(STEPS);
        for sensor in sensors() {
            for towards in [[0.3, 0.1, 1.0], [1.0, 0.2, -0.1], [-1.0, 0.4, 0.2], [0.1, 0.0, -1.0]] {
                let towards = Vector::from(towards).direction().unwrap();
                let of = |(a, b)| towards.cos(sensor.normal([middle(a), middle(b)])).max(0.0);
                let all = (0..STEPS).flat_map(|a| (0..STEPS).map(move |b| (a, b)));
                let mean = all.map(of).sum::<f64>() / f64::from(STEPS * STEPS);
                let share = sensor.share(towards);
                assert!((mean - share).abs() < 1e-5, "{sensor:?} {towards:?}: {mean}, {share}");
            }
        }
    }

    #[test]
    fn a_half_cylinder_looks_level() {
        let up = Direction::Z;
        assert_eq!(Sensor::half_cylinder(up, Vector::new(0.0, 0.0, 2.0)), None);
        let sensor = Sensor::half_cylinder(up, Vector::new(1.0, 0.0, 5.0)).unwrap();
        // From ahead and from behind: 2 / pi, and nothing.
        assert!((sensor.share(Direction::X) - 2.0 / PI).abs() < 1e-15);
        assert!(sensor.share(-Direction::X) < 1e-15);
    }
}
