//! Cameras.

use super::{FLOOR, problems, read};
use isolux::geometry::{Direction, Point};
use isolux::scene::{Camera, Scene};

fn camera(head: &str, keys: &str) -> Camera {
    let mut parts = read(&format!("{head}\n[[camera]]\n{keys}\n{FLOOR}"));
    Scene::assemble(parts.clone()).unwrap();
    parts.cameras.remove(0)
}

#[test]
fn target_direction_and_defaults() {
    let found =
        camera("", "name = 'door'\nposition = [0,0,1]\ntarget = [0,5,1]\nvertical_fov_deg = 90");
    assert_eq!(found.name, "door");
    assert_eq!((found.position, found.direction), (Point::new(0.0, 0.0, 1.0), Direction::Y));
    assert_eq!((found.up, found.vertical_fov_rad), (Direction::Z, std::f64::consts::FRAC_PI_2));
    let found = camera("", "position = [0,0,9]\ndirection = [0,0,-2]");
    assert_eq!((found.name.as_str(), found.direction), ("camera 1", -Direction::Z));
    assert_eq!(found.up, Direction::Y, "north is up on a plan");
    let found = camera("up = 'y'", "position = [0,9,0]\ndirection = [0,-1,0]");
    assert_eq!(found.up, -Direction::Z);
    let found = camera("up = 'y'", "position = [0,9,0]\ndirection = [1,0,0]\nup = [0,0,1]");
    assert_eq!(found.up, Direction::Z);
}

#[test]
fn wrong_cameras() {
    for (keys, expected) in [
        ("target = [1,1,1]", "`position` is missing"),
        ("position = [1,1,1]", "give one of `target`, `direction`"),
        ("position = [1,1,1]\ntarget = [1,1,1]", "looks nowhere"),
        ("position = [1,1,1]\ntarget = [1,1,2]\ndirection = [1,0,0]", "both"),
        ("position = [1,1,1]\ndirection = [1,0,0]\nup = [-2,0,0]", "along the line of sight"),
        ("position = [1,1,1]\ndirection = [1,0,0]\nup = [0,0,0]", "along the line of sight"),
        ("position = [1,1,1]\ndirection = [1,0,0]\nvertical_fov_deg = 180", "below 180"),
        ("position = [1,1,1]\ndirection = [1,0,0]\nvertical_fov_deg = 0", "above 0"),
        ("position = [1,1]\ndirection = [1,0,0]", "array of length 3"),
    ] {
        let found = problems(&format!("[[camera]]\n{keys}\n{FLOOR}"));
        assert!(found.iter().any(|p| p.contains(expected)), "{keys}: {found:?}");
    }
}
