//! Closed, welded surfaces: every edge belongs to two triangles that pass it in opposite directions.

use isolux_geometry::TriangleMesh;
use std::collections::HashMap;

/// On which side of a box its fronts are.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Fronts {
    Inside,
    Outside,
}

/// Triangles of a box with so many cells along each axis.
pub(super) fn box_triangles([a, b, c]: [usize; 3]) -> usize {
    4 * (a * b + b * c + c * a)
}

/// Adds a box whose sides have so many cells; `place` maps the unit cube to where it stands.
pub(super) fn add_box(
    mesh: &mut TriangleMesh,
    cells: [usize; 3],
    fronts: Fronts,
    place: impl Fn([f32; 3]) -> [f32; 3],
) {
    let mut welded = HashMap::new();
    for (axis, side) in (0..6).map(|face| (face / 2, face % 2)) {
        let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
        for (i, j) in (0..cells[u]).flat_map(|i| (0..cells[v]).map(move |j| (i, j))) {
            let mut quad = [[0, 0], [1, 0], [1, 1], [0, 1]].map(|[di, dj]| {
                let mut at = [0; 3];
                (at[axis], at[u], at[v]) = (side * cells[axis], i + di, j + dj);
                *welded.entry(at).or_insert_with(|| {
                    let unit = [0, 1, 2].map(|k| at[k] as f32 / cells[k] as f32);
                    add_vertex(mesh, place(unit))
                })
            });
            if (side == 0) == (fronts == Fronts::Outside) {
                quad.reverse();
            }
            add_quad(mesh, quad);
        }
    }
}

/// Triangles of a lathed solid.
pub(super) const fn lathed_triangles(sides: usize, rings: usize) -> usize {
    2 * sides * rings
}

/// Adds a solid of revolution about the vertical through `foot`: from a tip at the foot through
/// rings of so many corners, given by radius and height in metres, to a tip at `height_m`.
pub(super) fn add_lathed(
    mesh: &mut TriangleMesh,
    foot: [f32; 3],
    rings: &[[f32; 2]],
    height_m: f32,
    sides: usize,
) {
    let above = |h: f32| [foot[0], foot[1], foot[2] + h];
    let (bottom, top) = (add_vertex(mesh, foot), add_vertex(mesh, above(height_m)));
    let first = mesh.positions.len() as u32;
    for &[radius, height] in rings {
        for side in 0..sides {
            let angle_rad = std::f32::consts::TAU * side as f32 / sides as f32;
            let [x, y, z] = above(height);
            let (sin, cos) = (libm::sinf(angle_rad), libm::cosf(angle_rad));
            add_vertex(mesh, [x + radius * cos, y + radius * sin, z]);
        }
    }
    let at = |ring: usize, side: usize| first + (ring * sides + side % sides) as u32;
    for side in 0..sides {
        let next = side + 1;
        mesh.triangles.push([bottom, at(0, next), at(0, side)]);
        for ring in 1..rings.len() {
            let lower = ring - 1;
            add_quad(mesh, [at(lower, side), at(lower, next), at(ring, next), at(ring, side)]);
        }
        mesh.triangles.push([top, at(rings.len() - 1, side), at(rings.len() - 1, next)]);
    }
}

/// Where a box of so many metres stands, turned about the vertical through its middle.
pub(super) fn turned(
    low: [f32; 3],
    size: [f32; 3],
    angle_rad: f32,
) -> impl Fn([f32; 3]) -> [f32; 3] {
    let (sin, cos) = (libm::sinf(angle_rad), libm::cosf(angle_rad));
    move |unit| {
        let (x, y) = ((unit[0] - 0.5) * size[0], (unit[1] - 0.5) * size[1]);
        [
            low[0] + 0.5 * size[0] + cos * x - sin * y,
            low[1] + 0.5 * size[1] + sin * x + cos * y,
            low[2] + unit[2] * size[2],
        ]
    }
}

/// A box blown up to a ball.
pub(super) fn ball(centre: [f32; 3], radius_m: f32) -> impl Fn([f32; 3]) -> [f32; 3] {
    move |unit| {
        let v = unit.map(|x| 2.0 * x - 1.0);
        let scale = radius_m / (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).sqrt();
        [0, 1, 2].map(|axis| centre[axis] + v[axis] * scale)
    }
}

fn add_vertex(mesh: &mut TriangleMesh, position: [f32; 3]) -> u32 {
    mesh.positions.push(position);
    mesh.positions.len() as u32 - 1
}

fn add_quad(mesh: &mut TriangleMesh, [a, b, c, d]: [u32; 4]) {
    mesh.triangles.extend([[a, b, c], [a, c, d]]);
}
