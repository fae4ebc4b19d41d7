//! Closed solids and single sheets, divided into triangles.
//!
//! A division changes no surface: new vertices lie on the flat faces there are. Vertices on an edge
//! are computed in one way from both sides, so that solids stay closed to the last bit.

use super::surface::{self, Surface};
use isolux::geometry::{Point, Vector};
use isolux::scene::Shape;
use std::f64::consts::TAU;

/// A thing of one surface.
pub(super) struct Solid {
    pub(super) surface: Surface,
    pub(super) form: Form,
    /// How much longer its edges may be than those of furniture.
    pub(super) coarseness: f64,
}

pub(super) enum Form {
    /// A parallelepiped with right-handed edges, fronts outside.
    Box { corner: Point, edges: [Vector; 3] },
    /// A prism about the vertical through a foot: rings of so many corners, given by radius and
    /// height from the axis at the bottom to the axis at the top.
    Lathe { foot: Point, rings_m: Vec<[f64; 2]>, sides: u32 },
    /// A parallelogram, in front where `u x v` points, or behind if it is turned.
    Sheet { corner: Point, edges: [Vector; 2], is_turned: bool },
}

/// How often a length is divided if no part may be longer than another.
fn parts(length_m: f64, longest_m: f64) -> u32 {
    (length_m / longest_m).ceil().max(1.0) as u32
}

impl Solid {
    /// Number of triangles if no edge is longer.
    pub(super) fn triangles(&self, longest_m: f64) -> u64 {
        let longest_m = longest_m * self.coarseness;
        match &self.form {
            Form::Box { edges, .. } => {
                let [a, b, c] = edges.map(|e| u64::from(parts(e.length(), longest_m)));
                4 * (a * b + b * c + c * a)
            }
            Form::Lathe { rings_m, sides, .. } => {
                let lathe = Lathe::new(rings_m, *sides, longest_m);
                let rows = 2 * (lathe.rows.len() as u64 - 1) - 2;
                u64::from(lathe.around()) * rows
            }
            Form::Sheet { edges, .. } => {
                let [a, b] = edges.map(|e| u64::from(parts(e.length(), longest_m)));
                2 * a * b
            }
        }
    }

    fn add_to(&self, shape: &mut Shape, longest_m: f64) {
        let longest_m = longest_m * self.coarseness;
        match &self.form {
            Form::Box { corner, edges } => add_box(shape, *corner, *edges, longest_m),
            Form::Lathe { foot, rings_m, sides } => {
                add_lathe(shape, *foot, &Lathe::new(rings_m, *sides, longest_m));
            }
            Form::Sheet { corner, edges, is_turned } => {
                add_sheet(shape, *corner, *edges, *is_turned, longest_m);
            }
        }
    }
}

/// One shape for each surface, each solid with edges no longer than is said for it.
pub(super) fn shapes(solids: &[Solid], sizes_m: &[f64]) -> Vec<Shape> {
    let shape = |(index, name): (usize, &str)| Shape {
        name: name.into(),
        material: index as u32,
        ..Shape::default()
    };
    let mut shapes: Vec<Shape> = surface::names().enumerate().map(shape).collect();
    for (solid, &longest_m) in solids.iter().zip(sizes_m) {
        solid.add_to(&mut shapes[solid.surface.index()], longest_m);
    }
    shapes
}

/// The point `k / n` of the way along an edge.
fn along(edge: Vector, k: u32, n: u32) -> Vector {
    edge * (f64::from(k) / f64::from(n))
}

fn add_box(shape: &mut Shape, corner: Point, edges: [Vector; 3], longest_m: f64) {
    let counts = edges.map(|e| parts(e.length(), longest_m));
    let at = |cells: [u32; 3]| {
        (0..3).fold(corner, |p, axis| p + along(edges[axis], cells[axis], counts[axis]))
    };
    for axis in 0..3 {
        let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
        for is_far in [false, true] {
            let place = |i, j| {
                let mut cells = [0; 3];
                (cells[axis], cells[u], cells[v]) = (if is_far { counts[axis] } else { 0 }, i, j);
                at(cells)
            };
            add_grid(shape, [counts[u], counts[v]], is_far, place);
        }
    }
}

fn add_sheet(
    shape: &mut Shape,
    corner: Point,
    [u, v]: [Vector; 2],
    is_turned: bool,
    longest_m: f64,
) {
    let counts = [u, v].map(|e| parts(e.length(), longest_m));
    let place = |i, j| corner + along(u, i, counts[0]) + along(v, j, counts[1]);
    add_grid(shape, counts, !is_turned, place);
}

/// A grid of cells of two triangles, in front where the first direction turns to the second.
fn add_grid(
    shape: &mut Shape,
    [across, down]: [u32; 2],
    is_front: bool,
    place: impl Fn(u32, u32) -> Point,
) {
    let first = shape.positions.len() as u32;
    for j in 0..=down {
        shape.positions.extend((0..=across).map(|i| <[f64; 3]>::from(place(i, j))));
    }
    let at = |i: u32, j: u32| first + j * (across + 1) + i;
    for j in 0..down {
        for i in 0..across {
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            shape.triangles.extend(if is_front {
                [[a, b, c], [a, c, d]]
            } else {
                [[a, c, b], [a, d, c]]
            });
        }
    }
}

/// The rows and columns of vertices of a lathe.
struct Lathe {
    sides: u32,
    cells_per_side: u32,
    /// Radius and height, m, the first and the last on the axis.
    rows: Vec<[f64; 2]>,
}

impl Lathe {
    fn new(rings_m: &[[f64; 2]], sides: u32, longest_m: f64) -> Self {
        let widest_m = rings_m.iter().fold(0.0, |widest: f64, ring| widest.max(ring[0]));
        let side_m = 2.0 * widest_m * libm::sin(0.5 * TAU / f64::from(sides));
        let mut rows = vec![rings_m[0]];
        for ends in rings_m.windows(2) {
            let [from, to] = [ends[0], ends[1]];
            let step = [to[0] - from[0], to[1] - from[1]];
            let count = parts((step[0] * step[0] + step[1] * step[1]).sqrt(), longest_m);
            rows.extend((1..count).map(|k| {
                let share = f64::from(k) / f64::from(count);
                [from[0] + step[0] * share, from[1] + step[1] * share]
            }));
            rows.push(to);
        }
        Self { sides, cells_per_side: parts(side_m, longest_m), rows }
    }

    fn around(&self) -> u32 {
        self.sides * self.cells_per_side
    }

    /// Corner `k` of the ring of radius one, on a side of the prism.
    fn on_ring(&self, k: u32) -> [f64; 2] {
        let (side, cell) = (k / self.cells_per_side % self.sides, k % self.cells_per_side);
        let share = f64::from(cell) / f64::from(self.cells_per_side);
        let corner = |side: u32| {
            let (sin, cos) =
                libm::sincos(TAU * f64::from(side % self.sides) / f64::from(self.sides));
            [cos, sin]
        };
        let (from, to) = (corner(side), corner(side + 1));
        [0, 1].map(|axis| from[axis] + (to[axis] - from[axis]) * share)
    }
}

fn add_lathe(shape: &mut Shape, foot: Point, lathe: &Lathe) {
    let around = lathe.around();
    let ring: Vec<[f64; 2]> = (0..around).map(|k| lathe.on_ring(k)).collect();
    let last = lathe.rows.len() - 1;
    let bottom = shape.positions.len() as u32;
    shape.positions.push((foot + Vector::new(0.0, 0.0, lathe.rows[0][1])).into());
    for &[radius, height] in &lathe.rows[1..last] {
        let place = |[x, y]: &[f64; 2]| foot + Vector::new(x * radius, y * radius, height);
        shape.positions.extend(ring.iter().map(|c| <[f64; 3]>::from(place(c))));
    }
    let top = shape.positions.len() as u32;
    shape.positions.push((foot + Vector::new(0.0, 0.0, lathe.rows[last][1])).into());
    let at = |row: usize, k: u32| bottom + 1 + (row as u32 - 1) * around + k % around;
    for k in 0..around {
        shape.triangles.push([bottom, at(1, k + 1), at(1, k)]);
        for row in 1..last - 1 {
            let [a, b] = [at(row, k), at(row, k + 1)];
            let [c, d] = [at(row + 1, k + 1), at(row + 1, k)];
            shape.triangles.extend([[a, b, c], [a, c, d]]);
        }
        shape.triangles.push([top, at(last - 1, k), at(last - 1, k + 1)]);
    }
}
