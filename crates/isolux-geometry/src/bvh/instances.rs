//! Many copies of a few meshes: a hierarchy over their boxes, and in each the one over its triangles.

use super::Bvh;
use super::bounds::Bounds;
use super::build::{self, BinaryNode, MAX_DEPTH, Preset, Primitive};
use super::slabs::widened;
use crate::{End, Hit, Point, Ray, Transform, Vector};

/// A mesh at a place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Instance {
    /// Index of the mesh.
    pub object: u32,
    /// Where it stands.
    pub world_from_object: Transform,
}

/// Why there can be no such instance.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum InstanceProblem {
    /// There is no mesh of the index.
    NoSuchObject {
        /// Which instance.
        instance: usize,
    },
    /// The map has no inverse, is not finite, or stretches one direction more than
    /// [`InstancedBvh::MOST_STRETCHED`] times as much as another.
    NotInvertible {
        /// Which instance.
        instance: usize,
    },
    /// All instances together have 2^31 triangles or more.
    TooManyTriangles,
}

impl std::fmt::Display for InstanceProblem {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::NoSuchObject { instance } => write!(f, "instance {instance} is of no known mesh"),
            Self::NotInvertible { instance } => {
                write!(f, "instance {instance} is flattened, stretched too far, or not finite")
            }
            Self::TooManyTriangles => write!(f, "instances with 2^31 triangles or more"),
        }
    }
}

impl std::error::Error for InstanceProblem {}

/// Answers ray queries over instances of meshes, in the memory of the meshes alone.
///
/// Triangles are counted through: those of the first instance, then those of the second, and so on
/// ([`InstancedBvh::locate`] tells where one belongs). A ray meets a triangle of an instance where
/// [`InstancedBvh::ray_in`] meets that of the mesh, at the same `t`; for equal `t`, fronts count
/// before backs and then the lower index. Each mesh has an origin of its own; how far before its target a segment
/// ([`Ray::between`]) ends is told by coordinates of the world. No ray passes between triangles of one instance that share
/// an edge; between instances that touch, one may, as each rounds the ray in its own coordinates.
#[derive(Clone, Debug)]
pub struct InstancedBvh {
    objects: Vec<Bvh>,
    placed: Vec<Placed>,
    nodes: Vec<BinaryNode>,
    /// How far rounding of a ray may move a hit, for an origin at the origin, in unit roundoffs, and
    /// for each metre the origin is away.
    margin: [f64; 2],
}

/// An instance as rays need it.
#[derive(Clone, Debug)]
struct Placed {
    object: u32,
    object_from_world: Transform,
    /// Whether the map turns fronts into backs.
    mirrored: bool,
    /// Number of triangles of the instances before.
    first_triangle: u32,
}

impl InstancedBvh {
    /// Greatest condition number of the map of an instance.
    pub const MOST_STRETCHED: f64 = 1e6;

    /// Builds the hierarchy over the instances.
    pub fn build(objects: Vec<Bvh>, instances: &[Instance]) -> Result<Self, InstanceProblem> {
        let mut this = Self { objects, placed: Vec::new(), nodes: Vec::new(), margin: [0.0; 2] };
        let mut primitives = Vec::with_capacity(instances.len());
        let mut triangles = 0_usize;
        let object_bounds: Vec<Option<Bounds>> = this.objects.iter().map(bounds).collect();
        for (index, instance) in instances.iter().enumerate() {
            let object = this
                .objects
                .get(instance.object as usize)
                .ok_or(InstanceProblem::NoSuchObject { instance: index })?;
            let placed = Placed::new(instance, triangles)
                .ok_or(InstanceProblem::NotInvertible { instance: index })?;
            triangles += object.mesh().len();
            if triangles >= 1 << 31 {
                return Err(InstanceProblem::TooManyTriangles);
            }
            if let Some(bounds) = &object_bounds[instance.object as usize] {
                let placement = from_origin(&instance.world_from_object, object.mesh().origin);
                primitives.push(Primitive::new(&image(bounds, &placement), index as u32));
                this.widen_for(&placement, &placed.object_from_world, f64::from(bounds.reach()));
            }
            this.placed.push(placed);
        }
        this.nodes = build::build(Preset::Medium, primitives);
        Ok(this)
    }

    /// `placement` takes coordinates that count from the origin of the mesh, `inverse` gives those of the object.
    /// Rounding the origin and the direction to `f32` in the former moves the ray
    /// there by up to u (2 |o| + M), with o the origin and M the largest coordinate in them, u =
    /// 2^-24; what the kernel adds is 20 u (M + |o|). The world sees it enlarged by the norm of the
    /// map, and |o| is at most the norm of the inverse times the distance of origin and instance.
    fn widen_for(&mut self, placement: &Transform, inverse: &Transform, reach: f64) {
        const ROUNDINGS: f64 = 24.0;
        let (norm, inverse_norm) = (norm(placement), norm(inverse));
        let per_metre = ROUNDINGS * norm * inverse_norm;
        let at_origin = ROUNDINGS * norm * reach + per_metre * largest(placement.translation);
        self.margin[0] = self.margin[0].max(at_origin);
        self.margin[1] = self.margin[1].max(per_metre);
    }

    /// The meshes.
    pub fn objects(&self) -> &[Bvh] {
        &self.objects
    }

    /// Number of instances.
    pub fn len(&self) -> usize {
        self.placed.len()
    }

    /// Whether there is no instance.
    pub fn is_empty(&self) -> bool {
        self.placed.is_empty()
    }

    /// Bytes held beside the meshes: the trees over them, and the instances.
    pub fn bytes(&self) -> usize {
        self.objects.iter().map(Bvh::bytes).sum::<usize>()
            + size_of_val(&*self.placed)
            + size_of_val(&*self.nodes)
    }

    /// The instance that a triangle belongs to, and its index in the mesh; `None` for no triangle.
    pub fn locate(&self, triangle: u32) -> Option<(usize, u32)> {
        let after = self.placed.partition_point(|placed| placed.first_triangle <= triangle);
        let instance = after.checked_sub(1)?;
        let placed = &self.placed[instance];
        let local = triangle - placed.first_triangle;
        let count = self.objects[placed.object as usize].mesh().len();
        ((local as usize) < count).then_some((instance, local))
    }

    /// The ray in the coordinates of the mesh of an instance.
    ///
    /// # Panics
    /// If there is no such instance.
    pub fn ray_in(&self, instance: usize, ray: &Ray) -> Ray {
        let Placed { object, object_from_world, first_triangle, .. } = &self.placed[instance];
        let count = self.objects[*object as usize].mesh().len() as u32;
        let local = |triangle: u32| triangle.checked_sub(*first_triangle).filter(|&k| k < count);
        let direction = object_from_world.vector(Vector::from(ray.direction));
        Ray {
            origin: object_from_world.point(ray.origin),
            direction: direction.to_f32(),
            end: End::At(ray.t_max(Point::ORIGIN)),
            skip: ray.skip.and_then(local),
        }
    }

    /// The first triangle that the ray meets, transparent or not.
    pub fn closest_hit(&self, ray: &Ray) -> Option<Hit> {
        let mut closest: Option<Hit> = None;
        let end = ray.t_max(Point::ORIGIN);
        self.visit(ray, |instance| {
            // Ties are looked at, too.
            let t_max = closest.map_or(end, |hit| hit.t.next_up().min(end));
            let placed = &self.placed[instance];
            let local = self.ray_in(instance, &ray.up_to(t_max));
            if let Some(hit) = self.objects[placed.object as usize].closest_hit(&local) {
                let triangle = placed.first_triangle + hit.triangle;
                let hit = Hit { triangle, back: hit.back != placed.mirrored, ..hit };
                if closest.is_none_or(|best| rank(&hit) < rank(&best)) {
                    closest = Some(hit);
                }
            }
            closest.map_or(end, |hit| hit.t)
        });
        closest
    }

    /// Whether the ray meets any triangle that is not transparent.
    pub fn any_hit(&self, ray: &Ray) -> bool {
        let mut is_hit = false;
        let end = ray.t_max(Point::ORIGIN);
        self.visit(ray, |instance| {
            let object = self.placed[instance].object as usize;
            is_hit = self.objects[object].any_hit(&self.ray_in(instance, ray));
            if is_hit { f32::NEG_INFINITY } else { end }
        });
        is_hit
    }

    /// Shows the instances whose boxes the ray may meet up to `t_far`, which `look` returns, about
    /// the nearest first.
    fn visit(&self, ray: &Ray, mut look: impl FnMut(usize) -> f32) {
        let Some(slabs) = WideSlabs::new(ray, self.margin) else { return };
        let mut t_far = f64::from(ray.t_max(Point::ORIGIN));
        let mut stack = [(0, 0.0); MAX_DEPTH as usize + 2];
        let mut waiting = 0;
        if let Some(t) = self.nodes.first().and_then(|root| slabs.enter(&root.bounds)) {
            stack[0] = (0, t);
            waiting = 1;
        }
        while waiting > 0 {
            waiting -= 1;
            let (index, t) = stack[waiting];
            if t > t_far {
                continue;
            }
            let Some(children) = self.nodes[index].children(index) else {
                t_far = f64::from(look(self.nodes[index].triangle() as usize));
                continue;
            };
            let [a, b] = children.map(|child| (child, slabs.enter(&self.nodes[child].bounds)));
            let [near, far] = if a.1 <= b.1 { [a, b] } else { [b, a] };
            for (child, t) in [far, near].into_iter().filter_map(|(child, t)| Some((child, t?))) {
                stack[waiting] = (child, t);
                waiting += 1;
            }
        }
    }
}

impl Placed {
    /// `None` where the map has no inverse worth the name.
    fn new(instance: &Instance, triangles_before: usize) -> Option<Self> {
        let placement = &instance.world_from_object;
        let object_from_world = placement.inverse()?;
        let condition = norm(placement) * norm(&object_from_world);
        let is_finite = largest(placement.translation).is_finite();
        (is_finite && condition <= InstancedBvh::MOST_STRETCHED).then(|| Self {
            object: instance.object,
            object_from_world,
            mirrored: placement.determinant() < 0.0,
            first_triangle: triangles_before as u32,
        })
    }
}

/// Nearer first, then fronts, then the lower index.
fn rank(hit: &Hit) -> (f32, bool, u32) {
    (hit.t, hit.back, hit.triangle)
}

/// Where a ray enters boxes, in `f64`.
struct WideSlabs {
    origin: [f64; 3],
    inverse: [f64; 3],
    margin: f64,
}

impl WideSlabs {
    /// `None` for rays that can meet nothing.
    fn new(ray: &Ray, [at_origin, per_metre]: [f64; 2]) -> Option<Self> {
        let (origin, direction) = (<[f64; 3]>::from(ray.origin), ray.direction.map(f64::from));
        let distance = origin.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
        let is_ray = origin.iter().chain(&direction).all(|x| x.is_finite())
            && ray.t_max(Point::ORIGIN) > 0.0;
        is_ray.then(|| Self {
            origin,
            // Infinite along an axis that the ray does not move along.
            inverse: direction.map(f64::recip),
            margin: 0.5 * f64::from(f32::EPSILON) * (at_origin + per_metre * distance),
        })
    }

    /// Where the ray enters the box, widened by the margin; `None` if it does not.
    fn enter(&self, bounds: &Bounds) -> Option<f64> {
        let (mut enter, mut leave) = (0.0_f64, f64::INFINITY);
        for axis in 0..3 {
            let low = f64::from(bounds.low[axis]) - self.margin - self.origin[axis];
            let high = f64::from(bounds.high[axis]) + self.margin - self.origin[axis];
            if self.inverse[axis].is_infinite() {
                if low > 0.0 || high < 0.0 {
                    return None;
                }
                continue;
            }
            let (a, b) = (low * self.inverse[axis], high * self.inverse[axis]);
            // Three roundings of `f64`, and as much again.
            enter = enter.max(a.min(b) * (1.0 - 8.0 * f64::EPSILON));
            leave = leave.min(a.max(b) * (1.0 + 8.0 * f64::EPSILON));
        }
        (enter <= leave).then_some(enter)
    }
}

/// The same map of coordinates that count from an origin.
fn from_origin(map: &Transform, origin: Point) -> Transform {
    Transform { translation: map.point(origin).to_vector(), ..*map }
}

/// The box around what can be met of a mesh, in its own coordinates; `None` for nothing.
fn bounds(object: &Bvh) -> Option<Bounds> {
    let mesh = object.mesh();
    let triangles = (0..mesh.len() as u32).filter_map(|k| super::triangle_test::corners(mesh, k));
    triangles.map(|corners| widened(&corners)).reduce(Bounds::union)
}

/// The box around the image of a box.
fn image(bounds: &Bounds, map: &Transform) -> Bounds {
    let corner = |k: usize| {
        let at = |axis: usize| {
            f64::from(if k >> axis & 1 == 0 { bounds.low[axis] } else { bounds.high[axis] })
        };
        map.point(Point::new(at(0), at(1), at(2))).to_f32()
    };
    // The corners were rounded: to neighbours at most.
    Bounds::around(&[0, 1, 2, 3, 4, 5, 6, 7].map(corner)).widened(0.0)
}

/// The greatest sum of a row of the linear part, without signs: how far it enlarges the largest
/// component of a vector.
fn norm(map: &Transform) -> f64 {
    let row = |k: usize| map.columns.iter().map(|column| column.component(k).abs()).sum::<f64>();
    row(0).max(row(1)).max(row(2))
}

fn largest(v: Vector) -> f64 {
    v.x.abs().max(v.y.abs()).max(v.z.abs())
}
