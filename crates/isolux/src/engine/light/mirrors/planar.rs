//! Planar mirrors.

use crate::scene::Scene;
use crate::units::Rgb;
use isolux_geometry::{Normal, Point, Triangle, Vector};

/// The most planes that get virtual luminaires; the largest ones are kept.
const MAX_PLANES: usize = 16;

/// The most mirrors in a chain, and the most reflections of a virtual luminaire. Longer chains are left to
/// particles or rays.
pub(crate) const MAX_CHAIN_MIRRORS: usize = 6;
/// The most chains, and the most images of a luminaire, with the empty chain and the luminaire itself. The others
/// are left to particles or rays.
pub(crate) const MAX_CHAINS: usize = 64;

/// Tolerance within which triangles lie in one plane, in distances as a share of the scene's extent and, for
/// mirrors, in normals: the rounding of `f32` coordinates.
pub(crate) const PLANE_TOLERANCE: f64 = 1e-5;

/// A plane with mirror triangles in it, seen from the reflecting side.
#[derive(Clone, Debug)]
pub(crate) struct Plane {
    pub(crate) point: Point,
    pub(crate) normal: Normal,
    pub(crate) reflectance: Rgb,
    area_m2: f64,
    /// The bounding box of its mirror triangles, by two corners.
    low: Point,
    high: Point,
}

impl Plane {
    /// Height of a point above the reflecting side, m.
    pub(crate) fn height(&self, p: Point) -> f64 {
        (p - self.point).dot(self.normal.to_vector())
    }

    /// Whether light that leaves this mirror can meet the other, because some of the other lies in front of this one.
    pub(crate) fn can_light(&self, other: &Self, tolerance_m: f64) -> bool {
        let n = self.normal.to_vector();
        let farthest = |low: f64, high: f64, n: f64| if n > 0.0 { high } else { low };
        let corner = Point::new(
            farthest(other.low.x, other.high.x, n.x),
            farthest(other.low.y, other.high.y, n.y),
            farthest(other.low.z, other.high.z, n.z),
        );
        self.height(corner) > tolerance_m
    }

    /// The point where light from `from` in the direction `towards` meets the plane from its
    /// reflecting side. `None` outside the bounding box of the mirror's triangles, widened by the
    /// rounding of heights: `tolerance_m` over the sine of the angle to the plane.
    pub(crate) fn crossing(&self, from: Point, towards: Vector, tolerance_m: f64) -> Option<Point> {
        let descent = -towards.dot(self.normal.to_vector());
        let height = self.height(from).max(0.0);
        if descent <= 0.0 {
            return None;
        }
        let at = from + towards * (height / descent);
        let margin_m = tolerance_m * (2.0 + 2.0 * towards.length() / descent);
        self.is_near(at, margin_m).then_some(at)
    }

    /// Whether a point is in the bounding box of the mirror's triangles, widened by a margin.
    pub(crate) fn is_near(&self, at: Point, margin_m: f64) -> bool {
        let within = |low: f64, x: f64, high: f64| low - margin_m <= x && x <= high + margin_m;
        within(self.low.x, at.x, self.high.x)
            && within(self.low.y, at.y, self.high.y)
            && within(self.low.z, at.z, self.high.z)
    }

    fn include(&mut self, corners: &Triangle) {
        self.area_m2 += corners.area();
        for p in corners.corners {
            (self.low, self.high) = (self.low.lesser(p), self.high.greater(p));
        }
    }

    /// The mirror image of a point.
    pub(crate) fn image(&self, p: Point) -> Point {
        p - self.normal * (2.0 * self.height(p))
    }

    /// The mirror image of a triangle. Reflection reverses its orientation; swapping two corners restores it.
    pub(crate) fn image_of_triangle(&self, [a, b, c]: [Point; 3]) -> [Point; 3] {
        [a, c, b].map(|p| self.image(p))
    }

    /// The mirror image of a free vector.
    pub(crate) fn image_vector(&self, v: Vector) -> Vector {
        v - self.normal * (2.0 * v.dot(self.normal.to_vector()))
    }
}

/// All planar mirrors of a scene.
pub(crate) struct Mirrors {
    pub(crate) planes: Vec<Plane>,
    /// For each triangle, the planes that its front and its back belong to.
    sides: Vec<[Option<u32>; 2]>,
    /// Whether some mirror is curved, or there are too many planes.
    pub(crate) leaves_some_out: bool,
    /// Heights below this are rounding, m.
    pub(crate) tolerance_m: f64,
}

impl Mirrors {
    /// Groups the mirror triangles by plane.
    pub(crate) fn find(scene: &Scene) -> Self {
        let mut found = Self {
            planes: Vec::new(),
            sides: vec![[None; 2]; scene.triangle_count() as usize],
            leaves_some_out: false,
            tolerance_m: PLANE_TOLERANCE * extent_m(scene),
        };
        for triangle in 0..scene.triangle_count() {
            for back in [false, true] {
                let finish = scene.material(triangle).finish(back);
                let reflectance = finish.map_or(Rgb::BLACK, |f| f.mirror);
                if reflectance.is_black() {
                    continue;
                }
                if scene.corner_normals(triangle).is_some_and(are_turned) {
                    found.leaves_some_out = true;
                    continue;
                }
                let plane = found.plane_of(scene, triangle, back, reflectance);
                found.sides[triangle as usize][usize::from(back)] = Some(plane);
            }
        }
        found.keep_largest();
        found
    }

    fn plane_of(&mut self, scene: &Scene, triangle: u32, back: bool, reflectance: Rgb) -> u32 {
        let tolerance_m = self.tolerance_m;
        let corners = scene.triangle(triangle);
        let front = scene.geometric_normal(triangle);
        let normal = if back { -front } else { front };
        let same = |p: &Plane| {
            p.normal.dot(normal) > 1.0 - PLANE_TOLERANCE * PLANE_TOLERANCE.sqrt()
                && corners.corners.iter().all(|&c| p.height(c).abs() <= tolerance_m)
                && p.reflectance == reflectance
        };
        let known = self.planes.iter().position(same);
        let index = known.unwrap_or_else(|| {
            let point = corners.centroid();
            let (low, high) = (point, point);
            self.planes.push(Plane { point, normal, reflectance, area_m2: 0.0, low, high });
            self.planes.len() - 1
        });
        self.planes[index].include(&corners);
        index as u32
    }

    fn keep_largest(&mut self) {
        let mut order: Vec<usize> = (0..self.planes.len()).collect();
        order.sort_by(|&a, &b| self.planes[b].area_m2.total_cmp(&self.planes[a].area_m2));
        self.leaves_some_out |= order.len() > MAX_PLANES;
        order.truncate(MAX_PLANES);
        let renumbered = |old: u32| order.iter().position(|&k| k == old as usize);
        for side in self.sides.iter_mut().flatten() {
            *side = side.and_then(renumbered).map(|k| k as u32);
        }
        self.planes = order.iter().map(|&k| self.planes[k].clone()).collect();
    }

    /// The plane that a side of a triangle belongs to.
    pub(crate) fn of(&self, triangle: u32, back: bool) -> Option<u32> {
        self.sides[triangle as usize][usize::from(back)]
    }
}

/// Whether corner normals differ beyond the rounding of normals given in `f32`.
fn are_turned([a, b, c]: [Normal; 3]) -> bool {
    a.dot(b).min(a.dot(c)) < 1.0 - 1e-9
}

fn extent_m(scene: &Scene) -> f64 {
    scene.bvh().mesh().bounds().map_or(0.0, |(low, high)| (high - low).length())
}
