//! Cameras.

use isolux_geometry::{Direction, Point};
use serde::{Deserialize, Serialize};

/// A named point of view with perspective projection.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Camera {
    /// Name, as written in the scene.
    pub name: String,
    /// Eye.
    pub position: Point,
    /// Where it looks.
    pub direction: Direction,
    /// Roughly upwards in the picture; not parallel to `direction`.
    pub up: Direction,
    /// Full vertical opening angle, rad.
    pub vertical_fov_rad: f64,
}
