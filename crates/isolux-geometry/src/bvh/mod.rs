//! The bounding volume hierarchy over a triangle mesh.
//!
//! What a ray hits is defined by [`brute_force`] over the triangle test; everything else only saves
//! work and changes no bit of the answer.

#[cfg(target_arch = "x86_64")]
mod avx2;
#[cfg(target_arch = "x86_64")]
mod avx512;
mod batch;
mod bounds;
pub mod brute_force;
mod build;
mod collapse;
mod extent;
mod instances;
mod instructions;
mod local;
mod memory;
mod portable;
mod slabs;
mod traverse;
mod triangle_test;
mod wide;

use crate::{Hit, Normal, Point, Ray, TriangleMesh, Vector};
pub use build::Preset;
pub use instances::{Instance, InstanceProblem, InstancedBvh};
pub use instructions::InstructionSet;

use build::Primitive;
use instructions::Kernel;
use local::Local;
use rayon::prelude::*;
use traverse::{Any, Closest, Query};
use triangle_test::corners;
use wide::{Labelled, TRANSPARENT};

/// Answers ray queries over a triangle mesh.
///
/// A ray meets a triangle from either side, at `0 < t < t_max`; where several triangles are met at
/// the same `t`, a front counts before a back and then the lower index. Between triangles that
/// share an edge (the same two positions, bit for bit) or a corner no ray passes.
///
/// The kernel works in coordinates that count from the origin of the mesh: wherever that lies, hits
/// are the same bits as those of the same positions, and of rays moved alike, at the origin of the world.
///
/// Rays that are not finite meet nothing, nor do those whose origin is more than 2^38 m away from there or
/// whose direction is shorter than 2^-38 or longer than 2^38. Triangles with a corner that is not
/// finite or has a coordinate beyond 2^38 m from there are never met, nor are triangles without area.
#[derive(Clone, Debug)]
pub struct Bvh {
    mesh: TriangleMesh,
    kernel: Kernel,
    /// Whether rays that come together are walked together.
    in_flight: bool,
}

/// Trees of up to so many bytes, where a walk is a few steps, each waiting for the one before.
const TINY: usize = 8 << 10;

/// Trees beyond so many bytes, where a step waits for memory: about the second-level cache of a core.
const BEYOND_CACHE: usize = 2 << 20;

impl Bvh {
    /// Builds the hierarchy. `is_transparent` says for every triangle whether [`Bvh::any_hit`]
    /// looks through it.
    ///
    /// # Panics
    /// If there are more than 2^28 triangles.
    pub fn build(mesh: TriangleMesh, is_transparent: impl Fn(u32) -> bool + Sync) -> Self {
        let preset = Preset::for_triangles(mesh.len());
        Self::build_with(preset, InstructionSet::fastest(), mesh, is_transparent)
    }

    /// The same with a preset and instructions other than those that suit the scene and the
    /// processor, for measurement and tests.
    ///
    /// # Panics
    /// Also where this processor lacks the instructions.
    pub fn build_with(
        preset: Preset,
        instructions: InstructionSet,
        mesh: TriangleMesh,
        is_transparent: impl Fn(u32) -> bool + Sync,
    ) -> Self {
        assert!(mesh.len() <= build::MAX_TRIANGLES, "more than 2^28 triangles");
        let primitives = (0..mesh.len() as u32).into_par_iter().filter_map(|triangle| {
            let corners = corners(&mesh, triangle)?;
            Some(Primitive::new(&slabs::widened(&corners), triangle))
        });
        let binary = build::build(preset, primitives.collect());
        let labelled = |triangle: u32| {
            let mark = if is_transparent(triangle) { TRANSPARENT } else { 0 };
            let corners = corners(&mesh, triangle).unwrap_or_default();
            Labelled { corners, label: triangle | mark }
        };
        let kernel = Kernel::collapse(preset, instructions, &binary, labelled);
        let kernel = kernel.expect("fewer lines than references reach");
        let in_flight = kernel.bytes() <= TINY || kernel.bytes() > BEYOND_CACHE;
        Self { mesh, kernel, in_flight }
    }

    /// Has [`Bvh::closest_hits`] and [`Bvh::any_hits`] walk several rays in turn, or not, whatever
    /// suits the size of the tree: for measurement and tests.
    pub fn in_flight(self, in_flight: bool) -> Self {
        Self { in_flight, ..self }
    }

    /// The triangles.
    pub fn mesh(&self) -> &TriangleMesh {
        &self.mesh
    }

    /// Bytes of the tree, beside the mesh.
    pub fn bytes(&self) -> usize {
        self.kernel.bytes()
    }

    /// The point from which to trace a ray that leaves a surface at `point` on the side of `normal`:
    /// moved along the normal by [`Bvh::offset_m`].
    pub fn offset_origin(&self, point: Point, normal: Normal) -> Point {
        point + normal * self.offset_m(point)
    }

    /// A bound of the kernel's rounding errors at a place of this mesh, metres: a ray that starts so
    /// far beside a surface starts on its side of it, and the walk leaves it alone (after Pharr, Jakob,
    /// Humphreys, "Physically Based Rendering", 4th ed., 6.8.6).
    pub fn offset_m(&self, point: Point) -> f64 {
        let from_origin = point - self.mesh.origin;
        let margin = slabs::margin(&self.kernel.bounds(), from_origin.to_f32());
        // Rounding the origin, and the boxes.
        let more = 4.0 * f64::from(f32::EPSILON) * largest(from_origin);
        1.25 * f64::from(margin) + more
    }

    /// The first triangle that the ray meets, transparent or not.
    #[inline]
    pub fn closest_hit(&self, ray: &Ray) -> Option<Hit> {
        self.kernel.trace::<Closest>(&self.local(ray))
    }

    /// Whether the ray meets any triangle that is not transparent.
    #[inline]
    pub fn any_hit(&self, ray: &Ray) -> bool {
        self.kernel.trace::<Any>(&self.local(ray))
    }

    /// [`Bvh::closest_hit`] of many rays: faster than one by one in tiny scenes and in large ones.
    ///
    /// # Panics
    /// If there are not as many places for hits as rays.
    pub fn closest_hits(&self, rays: &[Ray], hits: &mut [Option<Hit>]) {
        self.trace_all::<Closest>(rays, hits);
    }

    /// [`Bvh::any_hit`] of many rays.
    ///
    /// # Panics
    /// If there are not as many places for answers as rays.
    pub fn any_hits(&self, rays: &[Ray], are_hit: &mut [bool]) {
        self.trace_all::<Any>(rays, are_hit);
    }

    #[inline(always)]
    fn local(&self, ray: &Ray) -> Local {
        Local::of(ray, self.mesh.origin)
    }

    fn trace_all<Q: Query>(&self, rays: &[Ray], answers: &mut [Q::Answer]) {
        assert_eq!(rays.len(), answers.len(), "a place for every answer");
        if self.in_flight {
            self.kernel
                .trace_many::<Q>((rays, self.mesh.origin), |place, answer| answers[place] = answer);
        } else {
            for (ray, answer) in rays.iter().zip(answers) {
                *answer = self.kernel.trace::<Q>(&self.local(ray));
            }
        }
    }
}

/// The largest component without its sign.
fn largest(v: Vector) -> f64 {
    v.x.abs().max(v.y.abs()).max(v.z.abs())
}
