//! The rays of a perspective camera.

use crate::image::Size;
use isolux::geometry::{Direction, Ray, Vector};
use isolux::scene::Camera;

/// Rays through the pixels of a picture.
pub struct ViewRays {
    camera: Camera,
    /// From the middle of the picture plane at distance 1 to its right edge and to its top.
    right: Vector,
    top: Vector,
    size: Size,
}

impl ViewRays {
    /// The rays of a camera for a picture of this size.
    pub fn new(camera: &Camera, size: Size) -> Self {
        let forward = camera.direction.to_vector();
        // A camera of a scene never looks along its up; any other picks a frame by itself.
        let right = forward.cross(camera.up.to_vector()).direction();
        let right = right.unwrap_or_else(|| camera.direction.frame().0).to_vector();
        let half_height = libm::tan(0.5 * camera.vertical_fov_rad);
        let half_width = half_height * f64::from(size.width()) / f64::from(size.height());
        Self {
            camera: camera.clone(),
            right: right * half_width,
            top: right.cross(forward) * half_height,
            size,
        }
    }

    /// The ray through a place of the picture, in pixels from the top left corner.
    pub fn through(&self, x: f64, y: f64) -> (Ray, Direction) {
        let across = 2.0 * x / f64::from(self.size.width()) - 1.0;
        let up = 1.0 - 2.0 * y / f64::from(self.size.height());
        let forward = self.camera.direction;
        let towards = forward.to_vector() + self.right * across + self.top * up;
        let direction = towards.direction().unwrap_or(forward);
        (Ray::new(self.camera.position, direction), direction)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use isolux::geometry::Point;
    use std::f64::consts::FRAC_PI_2;

    #[test]
    fn edges_of_the_picture_are_at_the_opening_angle() {
        let camera = Camera {
            name: "c".into(),
            position: Point::ORIGIN,
            direction: Direction::Y,
            up: Direction::Z,
            vertical_fov_rad: FRAC_PI_2,
        };
        let rays = ViewRays::new(&camera, Size::new(200, 100).unwrap());
        for (x, y, expected) in [
            (100.0, 50.0, Vector::new(0.0, 1.0, 0.0)),
            (100.0, 0.0, Vector::new(0.0, 1.0, 1.0)),
            (200.0, 50.0, Vector::new(2.0, 1.0, 0.0)),
            (0.0, 100.0, Vector::new(-2.0, 1.0, -1.0)),
        ] {
            let (_, direction) = rays.through(x, y);
            let wanted = expected.direction().unwrap();
            // A dozen roundings of unit numbers.
            assert!((direction.to_vector() - wanted.to_vector()).length() < 1e-15 * 12.0);
        }
    }
}
