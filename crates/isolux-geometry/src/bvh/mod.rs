//! The bounding volume hierarchy over a triangle mesh.
//!
//! What a ray hits is defined by [`brute_force`] over the triangle test; everything else only saves
//! work and changes no bit of the answer.

#[cfg(target_arch = "x86_64")]
mod avx2;
mod bounds;
pub mod brute_force;
mod build;
mod collapse;
mod instructions;
mod portable;
mod slabs;
mod traverse;
mod triangle_test;
mod wide;

use crate::{Hit, Ray, TriangleMesh};
pub use instructions::InstructionSet;

use bounds::Bounds;
use build::Primitive;
use instructions::Kernel;
use wide::{Block, WideTree};

/// Answers ray queries over a triangle mesh.
///
/// A ray meets a triangle from either side, at `0 < t < t_max`; where several triangles are met at
/// the same `t`, a front counts before a back and then the lower index. Between triangles that
/// share an edge (the same two positions, bit for bit) or a corner no ray passes.
///
/// Rays that are not finite meet nothing, nor do those whose origin is more than 2^40 m away or
/// whose direction is shorter than 2^-40 or longer than 2^40. Triangles with a corner that is not
/// finite or has a coordinate beyond 2^40 m are never met, nor are triangles without area.
#[derive(Clone, Debug)]
pub struct Bvh {
    mesh: TriangleMesh,
    tree: WideTree,
    kernel: Kernel,
}

impl Bvh {
    /// Builds the hierarchy. `is_transparent` says for every triangle whether [`Bvh::any_hit`]
    /// looks through it.
    ///
    /// # Panics
    /// If there are more than 2^28 triangles.
    pub fn build(mesh: TriangleMesh, is_transparent: impl Fn(u32) -> bool) -> Self {
        assert!(mesh.len() <= build::MAX_TRIANGLES, "more than 2^28 triangles");
        let primitives = (0..mesh.len() as u32).filter_map(|triangle| {
            let corners = triangle_test::corners(&mesh, triangle)?;
            Some(Primitive { bounds: Bounds::around(&corners), triangle })
        });
        let binary = build::build(primitives.collect());
        let tree =
            collapse::collapse(&binary, |triangles| block(&mesh, &is_transparent, triangles));
        Self { mesh, tree, kernel: Kernel::fastest() }
    }

    /// The same hierarchy walked with the given instructions instead of the fastest, for
    /// measurement and tests; `None` where this processor lacks them.
    pub fn with_instructions(self, set: InstructionSet) -> Option<Self> {
        Some(Self { kernel: Kernel::of(set)?, ..self })
    }

    /// The triangles.
    pub fn mesh(&self) -> &TriangleMesh {
        &self.mesh
    }

    /// The first triangle that the ray meets, transparent or not.
    pub fn closest_hit(&self, ray: &Ray) -> Option<Hit> {
        self.kernel.closest_hit(&self.tree, ray)
    }

    /// Whether the ray meets any triangle that is not transparent.
    pub fn any_hit(&self, ray: &Ray) -> bool {
        self.kernel.any_hit(&self.tree, ray)
    }
}

/// The block of up to eight triangles.
fn block(mesh: &TriangleMesh, is_transparent: &impl Fn(u32) -> bool, triangles: &[u32]) -> Block {
    let mut block = Block::EMPTY;
    for (lane, &triangle) in triangles.iter().enumerate() {
        let Some(corners) = triangle_test::corners(mesh, triangle) else { continue };
        for (lanes, position) in block.corners.iter_mut().flatten().zip(corners.iter().flatten()) {
            lanes[lane] = *position;
        }
        let mark = if is_transparent(triangle) { Block::TRANSPARENT } else { 0 };
        block.labels[lane] = triangle | mark;
    }
    block
}
