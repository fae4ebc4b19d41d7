//! The rays: incoherent, from surfaces, as light travels.

use crate::random::Random;
use isolux_geometry::{Bvh, Direction, End, Normal, Point, Ray, Vector};

/// Points of the surfaces of a mesh, uniform over their area.
pub(crate) struct Surfaces<'a> {
    bvh: &'a Bvh,
    /// Area of all triangles up to each.
    area_to_m2: Vec<f64>,
}

/// A point of a surface, seen from its front.
struct Place {
    triangle: u32,
    point: Point,
    normal: Normal,
}

/// How far points are pulled towards the middle of their triangle: on its rim one could round to
/// the other side of the neighbour.
const OFF_THE_RIM: f64 = 1e-3;

impl<'a> Surfaces<'a> {
    pub(crate) fn new(bvh: &'a Bvh) -> Self {
        let mesh = bvh.mesh();
        let areas = (0..mesh.len() as u32).map(|k| mesh.triangle(k).area());
        let sums = areas.scan(0.0, |sum, area| {
            *sum += area;
            Some(*sum)
        });
        Self { bvh, area_to_m2: sums.collect() }
    }

    fn place(&self, random: &mut Random) -> Place {
        loop {
            let area_m2 = random.unit() * self.area_to_m2.last().copied().unwrap_or(0.0);
            let index = self.area_to_m2.partition_point(|&to| to <= area_m2);
            let index = index.min(self.bvh.mesh().len() - 1) as u32;
            let triangle = self.bvh.mesh().triangle(index);
            let (u, v) = (random.unit(), random.unit());
            let (u, v) = if u + v > 1.0 { (1.0 - u, 1.0 - v) } else { (u, v) };
            let inwards = |weight: f64| weight + (1.0 / 3.0 - weight) * OFF_THE_RIM;
            if let Some(normal) = triangle.normal() {
                let point = triangle.point(inwards(u), inwards(v));
                return Place { triangle: index, point, normal };
            }
        }
    }

    /// Rays from random points, cosine-distributed about the normal. They name the triangle they start
    /// on, as those of the engines do.
    pub(crate) fn reflected(&self, count: usize, random: &mut Random) -> Vec<Ray> {
        let ray = |_| {
            let Place { triangle, point, normal } = self.place(random);
            let direction = cosine_distributed(normal, random);
            Ray::new(self.bvh.offset_origin(point, normal), direction).skipping(triangle)
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
                let origin = self.bvh.offset_origin(from.point, from.normal);
                let end = self.bvh.offset_origin(to.point, to.normal);
                break Ray::between(origin, end).skipping(from.triangle);
            }
        };
        (0..count).map(segment).collect()
    }

    /// Rays from random points at a random point of a random edge, one in four at a corner.
    pub(crate) fn aimed_at_edges(&self, count: usize, random: &mut Random) -> Vec<Ray> {
        let ray = |_| loop {
            let Place { point, normal, .. } = self.place(random);
            let target = self.edge_point(random);
            let mesh = self.bvh.mesh();
            let origin = mesh.local_from_world(self.bvh.offset_origin(point, normal));
            let direction = [0, 1, 2].map(|axis| target[axis] - origin[axis]);
            if direction.iter().any(|x| x.abs() > 1e-3) {
                let (origin, end) = (mesh.world_from_local(origin), End::At(f32::INFINITY));
                break Ray { origin, direction, end, skip: None };
            }
        };
        (0..count).map(ray).collect()
    }

    fn edge_point(&self, random: &mut Random) -> [f32; 3] {
        let corners = self.bvh.mesh().triangles[random.below(self.bvh.mesh().len())];
        let k = random.below(3);
        let [a, b] = [k, (k + 1) % 3].map(|k| self.bvh.mesh().positions[corners[k] as usize]);
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
