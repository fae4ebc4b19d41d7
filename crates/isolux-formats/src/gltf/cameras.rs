//! Perspective cameras.

use super::buffers::Document;
use super::nodes::{self, Placed};
use super::notes::{Flaw, Notes, no_such};
use super::orientation;
use isolux::geometry::{Direction, Point};
use isolux::scene::Camera;

/// The cameras of the scene. One that cannot be used is left out with a warning: nothing is lit
/// by it.
pub(super) fn cameras(document: &Document, placed: &[Placed], notes: &mut Notes) -> Vec<Camera> {
    let mut cameras = Vec::new();
    for instance in placed {
        let root = &document.root;
        let Some(index) = root.nodes[instance.node].camera.map(|c| c.value()) else { continue };
        let Some(record) = root.cameras.get(index) else {
            let flaw = no_such("cameras", index, root.cameras.len());
            notes.problem(flaw.at("camera").rooted(format!("nodes[{}]", instance.node)));
            continue;
        };
        let named = root.nodes[instance.node].name.as_ref().or(record.name.as_ref());
        let name = named.cloned().unwrap_or_else(|| nodes::name(root, instance.node));
        match camera(name, record, instance) {
            Ok(camera) => cameras.push(camera),
            Err(flaw) => notes.warn(flaw.at(format!("cameras[{index}]"))),
        }
    }
    cameras
}

fn camera(name: String, record: &gltf_json::Camera, instance: &Placed) -> Result<Camera, Flaw> {
    let Some(perspective) = &record.perspective else {
        let what = "a camera without perspective is left out";
        return Err(Flaw::new(what, "use a perspective camera"));
    };
    let vertical_fov_rad = f64::from(perspective.yfov);
    if !(vertical_fov_rad > 0.0 && vertical_fov_rad < std::f64::consts::PI) {
        let what = format!("a camera with an opening angle of {vertical_fov_rad} rad is left out");
        return Err(Flaw::new(what, "use an angle between 0 and pi"));
    }
    let world_from_node = &instance.world_from_node;
    let direction = orientation::forward(world_from_node)?;
    let up = upwards(direction, world_from_node.columns[1].direction());
    let position = world_from_node.point(Point::ORIGIN);
    Ok(Camera { name, position, direction, up, vertical_fov_rad })
}

/// The part of the node's y axis across the view; any direction across it where there is none.
fn upwards(direction: Direction, y: Option<Direction>) -> Direction {
    let across = |y: Direction| (y.to_vector() - direction * y.dot(direction)).direction();
    y.and_then(across).unwrap_or_else(|| direction.frame().0)
}
