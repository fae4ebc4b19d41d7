//! The rays of a view, in each of its projections.

use crate::image::Size;
use isolux::geometry::{Direction, Point, Ray, Vector};
use isolux::scene::Camera;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// An eye, where it looks, and how space around it comes to be a picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    /// Where the eye is.
    pub position: Point,
    /// Where it looks: the middle of the picture.
    pub direction: Direction,
    /// What is up in the picture, not along `direction`.
    pub up: Direction,
    /// How space comes to be a picture.
    pub projection: Projection,
}

/// The closed set of projections. All but the panorama are those of Radiance (`viewray` in its `image.c`). Angles and lengths are
/// those between opposite edges of the picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Projection {
    /// Straight lines stay straight (`-vtv`). The width of the picture follows from its shape.
    Perspective {
        /// The angle from the lower to the upper edge, less than pi.
        vertical_rad: f64,
    },
    /// Parallel rays through a rectangle about the eye: a plan or an elevation (`-vtl`).
    Parallel {
        /// From the left to the right edge.
        width_m: f64,
        /// From the lower to the upper edge.
        height_m: f64,
    },
    /// The sphere about the eye seen from far: a place lies at the sine of its angle from the middle (`-vth`). Areas of the
    /// picture are in proportion to the illuminance that they bring to a surface facing `direction`.
    Hemispherical {
        /// From the left to the right edge, at most pi.
        horizontal_rad: f64,
        /// From the lower to the upper edge, at most pi.
        vertical_rad: f64,
    },
    /// A place lies at its angle from the middle (`-vta`).
    Angular {
        /// From the left to the right edge, at most 2 pi.
        horizontal_rad: f64,
        /// From the lower to the upper edge, at most 2 pi.
        vertical_rad: f64,
    },
    /// A panorama on a cylinder about `up`: upright lines stay straight (`-vtc`).
    Cylindrical {
        /// From the left to the right edge, at most 2 pi.
        horizontal_rad: f64,
        /// From the lower to the upper edge, less than pi.
        vertical_rad: f64,
    },
    /// All that is around the eye, by longitude and latitude (equirectangular): the middle row is level, whatever the slope of
    /// `direction`, and the middle column looks its way.
    Panorama,
}

impl From<&Camera> for View {
    fn from(camera: &Camera) -> Self {
        let Camera { position, direction, up, vertical_fov_rad, .. } = *camera;
        let projection = Projection::Perspective { vertical_rad: vertical_fov_rad };
        Self { position, direction, up, projection }
    }
}

impl From<&Self> for View {
    fn from(view: &Self) -> Self {
        *view
    }
}

impl Projection {
    /// Width over height of the pictures that are not distorted; `None` if any shape will do.
    pub fn aspect(self) -> Option<f64> {
        match self {
            Self::Perspective { .. } => None,
            Self::Parallel { width_m, height_m } => Some(width_m / height_m),
            Self::Hemispherical { horizontal_rad, vertical_rad } => {
                Some(libm::sin(0.5 * horizontal_rad) / libm::sin(0.5 * vertical_rad))
            }
            Self::Angular { horizontal_rad, vertical_rad } => Some(horizontal_rad / vertical_rad),
            Self::Cylindrical { horizontal_rad, vertical_rad } => {
                Some(0.5 * horizontal_rad / libm::tan(0.5 * vertical_rad))
            }
            Self::Panorama => Some(2.0),
        }
    }
}

/// Rays through the pixels of a picture.
pub struct ViewRays {
    view: View,
    /// Unit vectors of the picture: to the right, upwards, and into it.
    right: Vector,
    top: Vector,
    forward: Vector,
    size: Size,
}

impl ViewRays {
    /// The rays of a view for a picture of this size.
    pub fn new(view: impl Into<View>, size: Size) -> Self {
        let view = view.into();
        let ahead = view.direction.to_vector();
        // A camera of a scene never looks along its up; any other picks a frame by itself.
        let right = ahead.cross(view.up.to_vector()).direction();
        let right = right.unwrap_or_else(|| view.direction.frame().0).to_vector();
        let (top, forward) = match view.projection {
            Projection::Panorama => (view.up.to_vector(), view.up.to_vector().cross(right)),
            _ => (right.cross(ahead), ahead),
        };
        Self { view, right, top, forward, size }
    }

    /// The ray through a place of the picture, in pixels from the top left corner; `None` beside the round picture of a fisheye.
    pub fn through(&self, x: f64, y: f64) -> Option<(Ray, Direction)> {
        // From -1 to 1 between the edges.
        let across = 2.0 * x / f64::from(self.size.width()) - 1.0;
        let up = 1.0 - 2.0 * y / f64::from(self.size.height());
        let View { position, projection, .. } = self.view;
        let along = |right: f64, top: f64, forward: f64| {
            (self.right * right + self.top * top + self.forward * forward).direction()
        };
        let towards = match projection {
            Projection::Perspective { vertical_rad } => {
                let half = libm::tan(0.5 * vertical_rad);
                let aspect = f64::from(self.size.width()) / f64::from(self.size.height());
                along(across * half * aspect, up * half, 1.0)
            }
            Projection::Parallel { width_m, height_m } => {
                let beside =
                    self.right * (0.5 * across * width_m) + self.top * (0.5 * up * height_m);
                let forward = self.view.direction;
                return Some((Ray::new(position + beside, forward), forward));
            }
            Projection::Hemispherical { horizontal_rad, vertical_rad } => {
                let x = across * libm::sin(0.5 * horizontal_rad);
                let y = up * libm::sin(0.5 * vertical_rad);
                let left = 1.0 - x * x - y * y;
                (left >= 0.0).then(|| along(x, y, libm::sqrt(left))).flatten()
            }
            Projection::Angular { horizontal_rad, vertical_rad } => {
                let (x, y) = (0.5 * across * horizontal_rad, 0.5 * up * vertical_rad);
                let angle = libm::hypot(x, y);
                let (sin, cos) = libm::sincos(angle);
                let share = if angle > 0.0 { sin / angle } else { 1.0 };
                (angle <= PI).then(|| along(x * share, y * share, cos)).flatten()
            }
            Projection::Cylindrical { horizontal_rad, vertical_rad } => {
                let (sin, cos) = libm::sincos(0.5 * across * horizontal_rad);
                along(sin, up * libm::tan(0.5 * vertical_rad), cos)
            }
            Projection::Panorama => {
                let (sin, cos) = libm::sincos(0.5 * across * TAU);
                let (height, level) = libm::sincos(up * FRAC_PI_2);
                along(sin * level, height, cos * level)
            }
        };
        towards.map(|direction| (Ray::new(position, direction), direction))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Checks where rays go from an eye that looks along y, by places of a picture of 200 x 100 pixels.
    #[track_caller]
    fn check(projection: Projection, expected: &[([f64; 2], Option<Vector>)]) {
        let view =
            View { position: Point::ORIGIN, direction: Direction::Y, up: Direction::Z, projection };
        let rays = ViewRays::new(view, Size::new(200, 100).unwrap());
        for &([x, y], wanted) in expected {
            let found = rays.through(x, y).map(|(_, direction)| direction.to_vector());
            let wanted = wanted.and_then(Vector::direction).map(Direction::to_vector);
            match (found, wanted) {
                // A dozen roundings of unit numbers.
                (Some(a), Some(b)) => {
                    assert!((a - b).length() < 1e-15 * 12.0, "{x} {y}: {a:?} for {b:?}");
                }
                (found, wanted) => assert_eq!(found.is_some(), wanted.is_some(), "{x} {y}"),
            }
        }
    }

    fn to(x: f64, y: f64, z: f64) -> Option<Vector> {
        Some(Vector::new(x, y, z))
    }

    #[test]
    fn edges_of_a_perspective_are_at_the_opening_angle() {
        check(
            Projection::Perspective { vertical_rad: FRAC_PI_2 },
            &[
                ([100.0, 50.0], to(0.0, 1.0, 0.0)),
                ([100.0, 0.0], to(0.0, 1.0, 1.0)),
                ([200.0, 50.0], to(2.0, 1.0, 0.0)),
                ([0.0, 100.0], to(-2.0, 1.0, -1.0)),
            ],
        );
    }

    #[test]
    fn parallel_rays_start_beside_the_eye() {
        let projection = Projection::Parallel { width_m: 8.0, height_m: 4.0 };
        check(projection, &[([0.0, 0.0], to(0.0, 1.0, 0.0)), ([200.0, 9.0], to(0.0, 1.0, 0.0))]);
        let view =
            View { position: Point::ORIGIN, direction: Direction::Y, up: Direction::Z, projection };
        let rays = ViewRays::new(view, Size::new(200, 100).unwrap());
        let (ray, _) = rays.through(200.0, 0.0).unwrap();
        assert_eq!(<[f64; 3]>::from(ray.origin), [4.0, 0.0, 2.0]);
    }

    #[test]
    fn fisheyes_end_at_their_circle() {
        let root = libm::sqrt(0.5);
        let angles = (PI, FRAC_PI_2);
        let (horizontal_rad, vertical_rad) = angles;
        check(
            Projection::Hemispherical { horizontal_rad, vertical_rad },
            &[
                ([100.0, 50.0], to(0.0, 1.0, 0.0)),
                ([150.0, 50.0], to(0.5, libm::sqrt(0.75), 0.0)),
                ([100.0, 0.0], to(0.0, root, root)),
                ([0.0, 0.0], None),
            ],
        );
        check(
            Projection::Angular { horizontal_rad: TAU, vertical_rad: PI },
            &[
                ([100.0, 50.0], to(0.0, 1.0, 0.0)),
                ([150.0, 50.0], to(1.0, 0.0, 0.0)),
                ([100.0, 0.0], to(0.0, 0.0, 1.0)),
                ([0.0, 50.0], to(0.0, -1.0, 0.0)),
                ([0.0, 0.0], None),
            ],
        );
    }

    #[test]
    fn panoramas_go_round() {
        check(
            Projection::Cylindrical { horizontal_rad: TAU, vertical_rad: FRAC_PI_2 },
            &[
                ([100.0, 0.0], to(0.0, 1.0, 1.0)),
                ([150.0, 50.0], to(1.0, 0.0, 0.0)),
                ([0.0, 50.0], to(0.0, -1.0, 0.0)),
            ],
        );
        check(
            Projection::Panorama,
            &[
                ([100.0, 50.0], to(0.0, 1.0, 0.0)),
                ([50.0, 50.0], to(-1.0, 0.0, 0.0)),
                ([100.0, 25.0], to(0.0, 1.0, 1.0)),
                ([100.0, 0.0], to(0.0, 0.0, 1.0)),
                ([7.0, 100.0], to(0.0, 0.0, -1.0)),
            ],
        );
    }

    #[test]
    fn a_panorama_is_level_however_the_eye_looks() {
        let direction = Vector::new(0.0, 1.0, -0.7).direction().unwrap();
        let (up, projection) = (Direction::Z, Projection::Panorama);
        let view = View { position: Point::ORIGIN, direction, up, projection };
        let (_, level) = ViewRays::new(view, Size::new(2, 1).unwrap()).through(1.0, 0.5).unwrap();
        assert!((level.to_vector() - Vector::new(0.0, 1.0, 0.0)).length() < 1e-15 * 12.0);
    }

    #[test]
    fn shapes_of_pictures() {
        let half = Projection::Hemispherical { horizontal_rad: PI, vertical_rad: PI };
        assert_eq!((half.aspect(), Projection::Panorama.aspect()), (Some(1.0), Some(2.0)));
        assert_eq!(Projection::Perspective { vertical_rad: 1.0 }.aspect(), None);
    }
}
