//! STL as written, but for its corners: those at one place are one.

use crate::bare::Weld;

/// One solid.
#[derive(Default)]
pub(super) struct Solid {
    pub(super) name: String,
    pub(super) vertices: Weld,
    pub(super) triangles: Vec<[u32; 3]>,
    /// Facets whose written normal points away from where their corners turn counter-clockwise.
    pub(super) reversed: usize,
}

impl Solid {
    /// Adds a facet with finite corners.
    pub(super) fn add(&mut self, normal: [f64; 3], corners: [[f64; 3]; 3]) {
        let [a, b, c] = corners;
        let arm = |p: [f64; 3]| -> [f64; 3] { std::array::from_fn(|k| p[k] - a[k]) };
        let (u, v) = (arm(b), arm(c));
        let turn = |k: usize| {
            let (i, j) = ((k + 1) % 3, (k + 2) % 3);
            u[i] * v[j] - u[j] * v[i]
        };
        let facing: f64 = (0..3).map(|k| turn(k) * normal[k]).sum();
        self.reversed += usize::from(facing < 0.0);
        self.triangles.push(corners.map(|p| self.vertices.vertex(p)));
    }
}
