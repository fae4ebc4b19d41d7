//! Meshes as they come: slivers, doubled faces, coordinates far off, millimetres and kilometres.

use super::rooms;
use super::stage::Stage;
use isolux::scene::Shape;

/// A floor as a fan of needles, a wall in strips, and faces that are there twice.
pub(super) fn slivers_and_doubles(stage: &mut Stage) {
    let size = stage.room_size();
    let [x, y, z] = size;
    let [floor, wall, white] = [0.3, 0.6, 0.8].map(|r| stage.any_paint(r, r));
    let needles = stage.draw.count(100, 400);
    fan(stage, [x, y], needles, floor);
    stage.ceiling(size, white);
    stage.walls([0.0; 2], [x, y], [0.0, z], wall);
    // The wall again, and a strip of it of a tenth of a millimetre.
    stage.sheet("wall again", [0.0; 3], [0.0, y, 0.0], [0.0, 0.0, z], wall);
    stage.sheet("strip", [0.0, 0.0, 1.0], [0.0, y, 0.0], [0.0, 0.0, 1e-4], wall);
    let wood = stage.any_paint(0.3, 0.6);
    for _ in 0..2 {
        stage.solid("cupboard, twice", [1.0, 0.0, 0.0], [1.8, 0.5, 1.0], wood);
    }
    let panel = stage.any_paint(0.5, 0.7);
    let [u, v] = [[0.8, 0.0, 0.0], [0.0, 0.0, 1.0]];
    stage.sheet("one way", [1.0, 1.8, 0.0], u, v, panel);
    stage.sheet("the other way", [1.0, 1.8, 0.0], v, u, panel);
    stage.lamp([0.5 * x, 0.5 * y, z - 0.3], 150.0);
}

/// A floor of triangles that all meet in one corner.
fn fan(stage: &mut Stage, [x, y]: [f64; 2], needles: u32, material: u32) {
    let half = needles / 2;
    let share = |k: u32| f64::from(k) / f64::from(half);
    let rim = (0..=half)
        .map(|k| [x, y * share(k), 0.0])
        .chain((1..=half).map(|k| [x * (1.0 - share(k)), y, 0.0]));
    let positions: Vec<[f64; 3]> = std::iter::once([0.0; 3]).chain(rim).collect();
    let last = positions.len() as u32 - 1;
    let triangles = (1..last).map(|k| [0, k, k + 1]).collect();
    stage.shape(Shape { name: "floor".into(), positions, triangles, material, ..Shape::default() });
}

/// A furnished room in the coordinates of a survey.
pub(super) fn far_off(stage: &mut Stage) {
    rooms::furnished(stage);
    let [east, north] = [0, 0].map(|_| stage.draw.between(-1.0, 1.0));
    let reach_m = stage.draw.pick(&[1e3, 4e3, 8e3]);
    stage.remove(1.0, [reach_m * east, reach_m * north, 112.0]);
}

/// A furnished room of some millimetres, or of some kilometres.
pub(super) fn scaled(stage: &mut Stage) {
    rooms::furnished(stage);
    let scale = [1e-3, 1e3][stage.half];
    stage.remove(scale, [0.0; 3]);
}
