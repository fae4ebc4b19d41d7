//! A hall with columns, luminaires, desks, chairs, balls and clutter.

use super::solids::{Fronts, add_box, add_lathed, ball, box_triangles, lathed_triangles, turned};
use crate::random::Random;
use isolux_geometry::TriangleMesh;

/// Into how many pieces the parts are divided.
pub(super) struct Fineness {
    shell_cells: [usize; 3],
    column_sides: usize,
    column_rings: usize,
    part_cells: usize,
    ball_cells: usize,
}

/// For about ten thousand triangles.
pub(super) const COARSE: Fineness = Fineness {
    shell_cells: [16, 12, 3],
    column_sides: 24,
    column_rings: 6,
    part_cells: 1,
    ball_cells: 4,
};

/// For about a million triangles.
pub(super) const FINE: Fineness = Fineness {
    shell_cells: [64, 48, 12],
    column_sides: 96,
    column_rings: 40,
    part_cells: 5,
    ball_cells: 32,
};

const ROOM_M: [f32; 3] = [16.0, 12.0, 3.2];
/// Between floor or ceiling and what stands there: a solid that reached through the shell would
/// let rays start outside.
pub(super) const GAP_M: f32 = 0.001;
const PLACES: usize = 60;
/// Boxes of a desk with its screen and chair.
const DESK_PARTS: usize = 9;
/// The smallest solid: a double pyramid over a triangle.
const LEAST: usize = lathed_triangles(3, 1);

/// The hall with exactly so many triangles, an even number: as many desks as fit, then clutter.
pub(super) fn furnished(triangles: usize, fineness: &Fineness) -> TriangleMesh {
    let mut mesh = TriangleMesh::default();
    let mut random = Random::new(1);
    let place = |unit: [f32; 3]| [0, 1, 2].map(|axis| unit[axis] * ROOM_M[axis]);
    add_box(&mut mesh, fineness.shell_cells, Fronts::Inside, place);
    add_columns(&mut mesh, fineness);
    add_luminaires(&mut mesh);
    let part = box_triangles([fineness.part_cells; 3]);
    let set = DESK_PARTS * part + box_triangles([fineness.ball_cells; 3]);
    let free = triangles.saturating_sub(mesh.len() + LEAST);
    for k in 0..PLACES.min(free / set) {
        // All over the hall: 37 has no factor in common with the number of places.
        add_set(&mut mesh, fineness, k * 37 % PLACES, &mut random);
    }
    add_clutter(&mut mesh, triangles, &mut random);
    mesh
}

fn add_columns(mesh: &mut TriangleMesh, fineness: &Fineness) {
    let height_m = ROOM_M[2] - 2.0 * GAP_M;
    let rings: Vec<[f32; 2]> = (0..fineness.column_rings)
        .map(|ring| ring as f32 / (fineness.column_rings - 1) as f32)
        .map(|up| [0.25 - 0.2 * up * (1.0 - up), up * height_m])
        .collect();
    for k in 0..6 {
        let foot = [3.45 + (k % 3) as f32 * 4.5, 4.05 + (k / 3) as f32 * 3.8, GAP_M];
        add_lathed(mesh, foot, &rings, height_m, fineness.column_sides);
    }
}

fn add_luminaires(mesh: &mut TriangleMesh) {
    for k in 0..40 {
        let low = [1.0 + (k % 8) as f32 * 1.9, 1.0 + (k / 8) as f32 * 2.4, 3.0];
        add_box(mesh, [1; 3], Fronts::Outside, turned(low, [1.2, 0.2, 0.06], 0.0));
    }
}

/// A desk, a screen, a chair and a ball.
fn add_set(mesh: &mut TriangleMesh, fineness: &Fineness, place: usize, random: &mut Random) {
    let (x, y) = (1.0 + (place % 10) as f32 * 1.5, 1.0 + (place / 10) as f32 * 1.9);
    let angle_rad = random.between(-0.4, 0.4) as f32;
    let parts: [([f32; 3], [f32; 3]); DESK_PARTS] = [
        ([x - 0.6, y - 0.4, 0.72], [1.2, 0.8, 0.03]),
        ([x - 0.55, y - 0.35, GAP_M], [0.05, 0.05, 0.72]),
        ([x + 0.5, y - 0.35, GAP_M], [0.05, 0.05, 0.72]),
        ([x - 0.55, y + 0.3, GAP_M], [0.05, 0.05, 0.72]),
        ([x + 0.5, y + 0.3, GAP_M], [0.05, 0.05, 0.72]),
        ([x - 0.25, y + 0.1, 0.8], [0.5, 0.03, 0.35]),
        ([x - 0.22, y - 0.7, 0.42], [0.44, 0.44, 0.05]),
        ([x - 0.22, y - 0.75, 0.46], [0.44, 0.03, 0.5]),
        ([x - 0.05, y - 0.53, GAP_M], [0.1, 0.1, 0.43]),
    ];
    for (low, size) in parts {
        let place = turned(low, size, angle_rad);
        add_box(mesh, [fineness.part_cells; 3], Fronts::Outside, place);
    }
    let centre = [x + 0.35, y - 0.1, random.between(0.9, 2.6) as f32];
    add_box(mesh, [fineness.ball_cells; 3], Fronts::Outside, ball(centre, 0.12));
}

/// Small boxes at random, and one spinning top that makes the number exact.
fn add_clutter(mesh: &mut TriangleMesh, triangles: usize, random: &mut Random) {
    let [mut low, mut size] = [[0.0; 3]; 2];
    while mesh.len() + box_triangles([1; 3]) + LEAST <= triangles {
        for axis in 0..3 {
            size[axis] = random.between(0.03, 0.25) as f32;
            low[axis] = random.between(0.3, f64::from(ROOM_M[axis]) - 0.6) as f32;
        }
        let angle_rad = random.between(0.0, 1.5) as f32;
        add_box(mesh, [1; 3], Fronts::Outside, turned(low, size, angle_rad));
    }
    let sides = triangles.saturating_sub(mesh.len()) / lathed_triangles(1, 1);
    add_lathed(mesh, [8.0, 0.3, 1.5], &[[0.1, 0.1]], 0.3, sides);
}
