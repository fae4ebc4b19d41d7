//! Points of view.

use isolux::geometry::{Direction, Point};
use isolux::scene::Camera;

/// Name, eye, what it looks at (m), vertical opening angle (degrees).
const VIEWS: [(&str, [f64; 3], [f64; 3], f64); 6] = [
    ("overview", [35.4, 13.4, 3.3], [12.0, 9.8, 0.4], 58.0),
    ("colonnade", [32.3, 6.7, 1.7], [8.0, 8.2, 1.7], 55.0),
    ("nave", [25.8, 10.7, 1.7], [0.0, 12.4, 1.6], 55.0),
    ("desk", [10.4, 1.3, 1.55], [12.6, 4.4, 0.85], 55.0),
    ("mirror", [6.2, 13.6, 1.65], [0.0, 11.6, 1.5], 60.0),
    ("meeting", [30.6, 7.2, 1.7], [35.0, 2.6, 0.9], 60.0),
];

pub(super) fn cameras() -> Vec<Camera> {
    VIEWS
        .iter()
        .map(|&(name, eye, target, fov_deg)| {
            let position = Point::from(eye);
            let direction = (Point::from(target) - position).direction();
            Camera {
                name: name.into(),
                position,
                direction: direction.expect("a view looks somewhere"),
                up: Direction::Z,
                vertical_fov_rad: fov_deg.to_radians(),
            }
        })
        .collect()
}
