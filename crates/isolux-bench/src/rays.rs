//! The rays: incoherent, from surfaces, as light travels.

use crate::random::Random;
use isolux_geometry::{Direction, Normal, Point, Ray, TriangleMesh, Vector, offset_origin};

/// Points of the surfaces of a mesh, uniform over their area.
pub(crate) struct Surfaces<'a> {
    mesh: &'a TriangleMesh,
    /// Area of all triangles up to each.
    area_to_m2: Vec<f64>,
}

/// A point of a surface, seen from its front.
struct Place {
    point: Point,
    normal: Normal,
}

/// How far points are pulled towards the middle of their triangle: on its rim one could round to
/// the other side of the neighbour.
const OFF_THE_RIM: f64 = 1e-3;

impl<'a> Surfaces<'a> {
    pub(crate) fn new(mesh: &'a TriangleMesh) -> Self {
        let areas = (0..mesh.len() as u32).map(|k| mesh.triangle(k).area());
        let sums = areas.scan(0.0, |sum, area| {
            *sum += area;
            Some(*sum)
        });
        Self { mesh, area_to_m2: sums.collect() }
    }

    fn place(&self, random: &mut Random) -> Place {
        loop {
            let area_m2 = random.unit() * self.area_to_m2.last().copied().unwrap_or(0.0);
            let index = self.area_to_m2.partition_point(|&to| to <= area_m2);
            let triangle = self.mesh.triangle(index.min(self.mesh.len() - 1) as u32);
            let (u, v) = (random.unit(), random.unit());
            let (u, v) = if u + v > 1.0 { (1.0 - u, 1.0 - v) } else { (u, v) };
            let inwards = |weight: f64| weight + (1.0 / 3.0 - weight) * OFF_THE_RIM;
            if let Some(normal) = triangle.normal() {
                return Place { point: triangle.point(inwards(u), inwards(v)), normal };
            }
        }
    }

    /// Rays from random points, cosine-distributed about the normal.
    pub(crate) fn reflected(&self, count: usize, random: &mut Random) -> Vec<Ray> {
        let ray = |_| {
            let Place { point, normal } = self.place(random);
            Ray::new(offset_origin(point, normal), cosine_distributed(normal, random))
        };
        (0..count).map(ray).collect()
    }

    /// Segments between random points that face each other.
    pub(crate) fn segments(&self, count: usize, random: &mut Random) -> Vec<Ray> {
        let segment = |_| loop {
            let (from, to) = (self.place(random), self.place(random));
            let between = to.point - from.point;
            let faces = |normal: Normal| between.dot(normal.to_vector());
            if faces(from.normal) > 0.0 && faces(to.normal) < 0.0 {
                let origin = offset_origin(from.point, from.normal);
                break Ray::between(origin, offset_origin(to.point, to.normal));
            }
        };
        (0..count).map(segment).collect()
    }

    /// Rays from random points at a random point of a random edge, one in four at a corner.
    pub(crate) fn aimed_at_edges(&self, count: usize, random: &mut Random) -> Vec<Ray> {
        let ray = |_| loop {
            let Place { point, normal } = self.place(random);
            let target = self.edge_point(random);
            let origin = offset_origin(point, normal).to_f32();
            let direction = [0, 1, 2].map(|axis| target[axis] - origin[axis]);
            if direction.iter().any(|x| x.abs() > 1e-3) {
                break Ray { origin, direction, t_max: f32::INFINITY, skip: None };
            }
        };
        (0..count).map(ray).collect()
    }

    fn edge_point(&self, random: &mut Random) -> [f32; 3] {
        let corners = self.mesh.triangles[random.below(self.mesh.len())];
        let k = random.below(3);
        let [a, b] = [k, (k + 1) % 3].map(|k| self.mesh.positions[corners[k] as usize]);
        let weight = if random.below(4) == 0 { 0.0 } else { random.unit() as f32 };
        [0, 1, 2].map(|axis| a[axis] + (b[axis] - a[axis]) * weight)
    }
}

/// A point of the unit sphere around the tip of the normal is cosine-distributed as seen from its
/// foot.
fn cosine_distributed(normal: Normal, random: &mut Random) -> Direction {
    loop {
        let cube = Vector::from([0; 3].map(|_| random.between(-1.0, 1.0)));
        let sphere = cube.direction().filter(|_| cube.length_squared() < 1.0);
        let tip = sphere.and_then(|s| (normal.to_vector() + s.to_vector()).direction());
        if let Some(direction) = tip {
            return direction;
        }
    }
}
