//! Spheres of triangles that lie outside the sphere they stand for.
//!
//! Places on the sphere are then in front of the triangles seen from inside, never hidden behind
//! them, and the excess of area is what the closed forms must be forgiven.

use isolux::geometry::{Direction, Point, Triangle, Vector};
use isolux::scene::Shape;
use std::collections::BTreeMap;
use std::f64::consts::{FRAC_PI_2, PI};

/// Facets are moved out by this much more than needed: the ray kernel stores `f32`.
const F32_MARGIN: f64 = 2.0 * f32::EPSILON as f64;

/// A mesh around a sphere (or octant) about the origin, fronts inside.
#[derive(Clone, Debug, PartialEq)]
pub struct SphereMesh {
    /// Vertices, m.
    pub positions: Vec<[f64; 3]>,
    /// Corners, counter-clockwise seen from inside.
    pub triangles: Vec<[u32; 3]>,
    /// Radius of the sphere meant, m.
    pub radius_m: f64,
}

/// The octant `x, y, z >= 0` with `rows^2` triangles.
///
/// Weights `(a, b, c)` of a triangular lattice become the direction of
/// `(sin(a pi / 2), sin(b pi / 2), sin(c pi / 2))`: equal angles along the edges, triangles nearly alike inside.
pub fn octant(radius_m: f64, rows: u32) -> SphereMesh {
    let mut positions = Vec::new();
    let mut triangles = Vec::new();
    let sine = |k: u32| if k == rows { 1.0 } else { libm::sin(quarter_rad(k, rows)) };
    for i in 0..=rows {
        for j in 0..=i {
            let p = Vector::new(sine(i - j), sine(j), sine(rows - i));
            positions.push((p * (1.0 / p.length())).into());
        }
    }
    let vertex = |i: u32, j: u32| i * (i + 1) / 2 + j;
    for i in 0..rows {
        for j in 0..=i {
            triangles.push([vertex(i, j), vertex(i + 1, j + 1), vertex(i + 1, j)]);
            if j < i {
                triangles.push([vertex(i, j), vertex(i, j + 1), vertex(i + 1, j + 1)]);
            }
        }
    }
    let mut mesh = SphereMesh { positions, triangles, radius_m };
    mesh.circumscribe();
    mesh
}

/// The whole sphere with `8 rows^2` triangles: the octant and its mirror images.
pub fn sphere(radius_m: f64, rows: u32) -> SphereMesh {
    let part = octant(radius_m, rows);
    let mut mesh = SphereMesh { positions: Vec::new(), triangles: Vec::new(), radius_m };
    let mut known = BTreeMap::new();
    for signs in (0..8).map(|k| [0, 1, 2].map(|axis| if k >> axis & 1 == 1 { -1.0 } else { 1.0 })) {
        let turned = signs.iter().product::<f64>() < 0.0;
        for &corners in &part.triangles {
            let mut corners = corners.map(|v| {
                // Adding zero makes one zero of two.
                let p = [0, 1, 2].map(|axis| part.positions[v as usize][axis] * signs[axis] + 0.0);
                *known.entry(p.map(f64::to_bits)).or_insert_with(|| {
                    mesh.positions.push(p);
                    mesh.positions.len() as u32 - 1
                })
            });
            if turned {
                corners.swap(1, 2);
            }
            mesh.triangles.push(corners);
        }
    }
    mesh
}

/// `k / of` right angles.
fn quarter_rad(k: u32, of: u32) -> f64 {
    FRAC_PI_2 * f64::from(k) / f64::from(of)
}

impl SphereMesh {
    fn triangle(&self, corners: [u32; 3]) -> Triangle {
        Triangle { corners: corners.map(|v| Point::from(self.positions[v as usize])) }
    }

    /// Moves the vertices of a unit mesh outwards until no facet cuts the sphere: if all corners of
    /// a facet at height `h` are scaled by `1 / h` or more, so is every place on it.
    fn circumscribe(&mut self) {
        let mut scales = vec![1.0_f64; self.positions.len()];
        for &corners in &self.triangles {
            let triangle = self.triangle(corners);
            let Some(inward) = triangle.normal() else { continue };
            let height = -inward.to_vector().dot(triangle.corners[0].to_vector());
            for v in corners {
                scales[v as usize] = scales[v as usize].max(1.0 / height);
            }
        }
        for (position, scale) in self.positions.iter_mut().zip(scales) {
            *position = position.map(|x| x * scale * self.radius_m * (1.0 + F32_MARGIN));
        }
    }

    /// Area, m2.
    pub fn area_m2(&self) -> f64 {
        self.triangles.iter().map(|&corners| self.triangle(corners).area()).sum()
    }

    /// By how much the area exceeds that of the sphere, a fraction.
    pub fn area_excess(&self, share_of_sphere: f64) -> f64 {
        self.area_m2() / (share_of_sphere * 4.0 * PI * self.radius_m * self.radius_m) - 1.0
    }

    /// The place of the mesh that is seen from the origin in a direction.
    pub fn place_towards(&self, direction: Direction) -> Option<Point> {
        let ray = direction.to_vector();
        self.triangles.iter().find_map(|&corners| {
            let [a, b, c] = self.triangle(corners).corners.map(Point::to_vector);
            // Weights of the corners, up to a common factor: all of one sign inside.
            let weights = [ray.dot(b.cross(c)), ray.dot(c.cross(a)), ray.dot(a.cross(b))];
            let inside = weights.iter().all(|&w| w <= 0.0);
            let sum = weights.iter().sum::<f64>();
            let place = a * weights[0] + b * weights[1] + c * weights[2];
            (inside && sum < 0.0).then(|| Point::ORIGIN + place / sum)
        })
    }

    /// Length of the longest edge, m.
    pub fn longest_edge_m(&self) -> f64 {
        let edges = self.triangles.iter().flat_map(|&corners| {
            let [a, b, c] = self.triangle(corners).corners;
            [(b - a).length(), (c - b).length(), (a - c).length()]
        });
        edges.fold(0.0, f64::max)
    }

    /// How far out of the sphere the mesh reaches, m.
    pub fn thickness_m(&self) -> f64 {
        let outermost = self.positions.iter().map(|&p| Vector::from(p).length());
        outermost.fold(0.0, f64::max) - self.radius_m
    }

    /// As a shape with the normals of the sphere, pointing inwards. `keep` chooses triangles by
    /// their centroids.
    pub fn shape(&self, name: &str, material: u32, keep: impl Fn(Point) -> bool) -> Shape {
        let kept = |corners: &&[u32; 3]| keep(self.triangle(**corners).centroid());
        Shape {
            name: name.into(),
            positions: self.positions.clone(),
            normals: Some(self.positions.iter().map(|p| p.map(|x| -x)).collect()),
            triangles: self.triangles.iter().filter(kept).copied().collect(),
            material,
            ..Shape::default()
        }
    }

    /// The sector of the plane through the origin where coordinate `axis` is zero, as far as the
    /// edge of an octant mesh there; its front looks along the positive axis.
    pub fn sector(&self, name: &str, axis: usize, material: u32) -> Shape {
        let (b, c) = ((axis + 1) % 3, (axis + 2) % 3);
        let mut edge: Vec<[f64; 3]> =
            self.positions.iter().filter(|p| p[axis] == 0.0).copied().collect();
        edge.sort_by(|p, q| (p[c] / (p[b] + p[c])).total_cmp(&(q[c] / (q[b] + q[c]))));
        let corners: Vec<Point> =
            std::iter::once(Point::ORIGIN).chain(edge.into_iter().map(Point::from)).collect();
        super::polygon(name, &corners, material)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every edge of a closed surface is run through once in each direction.
    fn open_edges(shapes: &[Shape]) -> usize {
        let mut balance: BTreeMap<[[u64; 3]; 2], i32> = BTreeMap::new();
        for shape in shapes {
            let bits = |v: u32| shape.positions[v as usize].map(f64::to_bits);
            for t in &shape.triangles {
                for (a, b) in [(t[0], t[1]), (t[1], t[2]), (t[2], t[0])] {
                    let (a, b) = (bits(a), bits(b));
                    let (key, sign) = if a < b { ([a, b], 1) } else { ([b, a], -1) };
                    *balance.entry(key).or_default() += sign;
                }
            }
        }
        balance.values().filter(|&&count| count != 0).count()
    }

    #[test]
    fn the_octant_and_its_sectors_close() {
        let mesh = octant(1.0, 12);
        let mut shapes = vec![mesh.shape("sphere", 0, |_| true)];
        shapes.extend((0..3).map(|axis| mesh.sector("mirror", axis, 1)));
        assert_eq!(open_edges(&shapes), 0);
        assert_eq!(mesh.triangles.len(), 144);
    }

    #[test]
    fn the_sphere_closes_and_lies_outside() {
        let mesh = sphere(2.0, 10);
        assert_eq!(open_edges(&[mesh.shape("sphere", 0, |_| true)]), 0);
        assert_eq!(mesh.triangles.len(), 800);
        for &corners in &mesh.triangles {
            let triangle = mesh.triangle(corners);
            let inward = triangle.normal().unwrap().to_vector();
            assert!(-inward.dot(triangle.corners[0].to_vector()) >= 2.0);
        }
    }

    #[test]
    fn places_of_the_mesh_are_where_they_are_sought() {
        let mesh = sphere(2.0, 10);
        for (x, y, z) in [(0.3, 0.4, 0.5), (-0.1, 0.9, -0.2), (1.0, 0.0, 0.0), (0.2, -0.7, 0.7)] {
            let direction = Vector::new(x, y, z).direction().unwrap();
            let place = mesh.place_towards(direction).unwrap().to_vector();
            assert!(place.cross(direction.to_vector()).length() < crate::tolerance::ROUNDING);
            assert!((2.0..2.0 + mesh.thickness_m()).contains(&place.length()), "{place:?}");
        }
    }

    #[test]
    fn excess_falls_with_the_square_of_the_rows() {
        let ratio = sphere(1.0, 10).area_excess(1.0) / sphere(1.0, 20).area_excess(1.0);
        assert!((3.6..4.4).contains(&ratio), "{ratio}");
    }
}
