//! Time and memory of building.

use crate::embree::{Embree, EmbreeScene};
use isolux_geometry::{Bvh, TriangleMesh};
use serde::Serialize;
use stats_alloc::{INSTRUMENTED_SYSTEM, Region, StatsAlloc};
use std::alloc::System;
use std::time::Instant;

#[global_allocator]
static ALLOCATOR: &StatsAlloc<System> = &INSTRUMENTED_SYSTEM;

/// What it takes to make a scene ready for rays.
#[derive(Clone, Copy, Debug, Serialize)]
pub(crate) struct Build {
    /// On the wall, all threads, the best of several: other load only adds.
    pub(crate) best_ms: f64,
    /// Held afterwards, with the positions and indices of the mesh.
    pub(crate) bytes_per_triangle: f64,
    /// Of it, beside the mesh.
    pub(crate) tree_bytes_per_triangle: f64,
}

impl Build {
    fn new(best_ms: f64, bytes: usize, mesh: &TriangleMesh) -> Self {
        let mesh_bytes = size_of_val(&*mesh.positions) + size_of_val(&*mesh.triangles);
        let per_triangle = |bytes: usize| bytes as f64 / mesh.len() as f64;
        Self {
            best_ms,
            bytes_per_triangle: per_triangle(bytes),
            tree_bytes_per_triangle: per_triangle(bytes.saturating_sub(mesh_bytes)),
        }
    }
}

/// Builds so many times, one at least; the last one stays.
pub(crate) fn isolux(mesh: &TriangleMesh, times: usize) -> (Bvh, Build) {
    let build = || {
        let region = Region::new(ALLOCATOR);
        let mesh = mesh.clone();
        let start = Instant::now();
        let bvh = Bvh::build(mesh, |_| false);
        let time_ms = 1e3 * start.elapsed().as_secs_f64();
        let change = region.change();
        (bvh, time_ms, change.bytes_allocated - change.bytes_deallocated)
    };
    let earlier = (1..times).map(|_| build().1).fold(f64::INFINITY, f64::min);
    let (bvh, time_ms, bytes) = build();
    (bvh, Build::new(earlier.min(time_ms), bytes, mesh))
}

/// The same by Embree.
pub(crate) fn embree<'a>(
    embree: &'a Embree,
    mesh: &TriangleMesh,
    times: usize,
) -> Result<(EmbreeScene<'a>, Build), String> {
    let build = || {
        let held = embree.bytes();
        let start = Instant::now();
        let scene = EmbreeScene::build(embree, mesh)?;
        let time_ms = 1e3 * start.elapsed().as_secs_f64();
        Ok::<_, String>((scene, time_ms, embree.bytes().saturating_sub(held)))
    };
    let mut best_ms = f64::INFINITY;
    for _ in 1..times {
        best_ms = best_ms.min(build()?.1);
    }
    let (scene, time_ms, bytes) = build()?;
    Ok((scene, Build::new(best_ms.min(time_ms), bytes, mesh)))
}
