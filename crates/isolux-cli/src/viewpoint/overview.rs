//! Where an eye looks, and the view of a whole scene.

use isolux::geometry::{Direction, Point, Vector};
use isolux::scene::{Camera, Scene, UpAxis};

/// Where the eye stands between the middle of the scene and a corner of the box around it: far back,
/// but inside of the walls.
const TOWARDS_CORNER: f64 = 0.86;
/// The cosine above which a view counts as along up: half a degree.
const PARALLEL_COS: f64 = 0.99996;
/// A wide angle, as of a 20 mm lens.
pub(super) const VERTICAL_FOV_RAD: f64 = 1.15;

/// Where an eye looks, and what is up for it.
pub(super) struct Gaze {
    pub(super) direction: Direction,
    pub(super) up: Direction,
}

/// A gaze by its axes, or what is wrong with them.
pub(super) fn gaze(towards: Vector, up: Vector) -> Result<Gaze, String> {
    let direction = towards.direction().ok_or("the eye looks nowhere")?;
    let up = up.direction().ok_or("up has no direction")?;
    if up.dot(direction).abs() > PARALLEL_COS {
        return Err("the view goes straight along up".to_owned());
    }
    Ok(Gaze { direction, up })
}

/// Up in a scene.
pub(super) fn up_of(scene: &Scene) -> Direction {
    match scene.up() {
        UpAxis::Y => Direction::Y,
        UpAxis::Z => Direction::Z,
    }
}

/// From a corner of the box around the scene towards its middle.
pub(super) fn overview(scene: &Scene) -> Camera {
    let (low, high) = scene.bvh().mesh().bounds().unwrap_or((Point::ORIGIN, Point::ORIGIN));
    let middle = low.lerp(high, 0.5);
    let half = (high - low) * (0.5 * TOWARDS_CORNER);
    // Eye height in a room rather than the ceiling.
    let step = match scene.up() {
        UpAxis::Y => Vector::new(half.x, 0.5 * half.y, half.z),
        UpAxis::Z => Vector::new(half.x, -half.y, 0.5 * half.z),
    };
    Camera {
        name: "overview".to_owned(),
        position: middle + step,
        direction: (-step).direction().unwrap_or(Direction::X),
        up: up_of(scene),
        vertical_fov_rad: VERTICAL_FOV_RAD,
    }
}
