//! Rays aimed at edges and corners of a closed room: each must meet something.

use crate::kernel::Kernel;
use crate::random::Random;
use crate::rays::Surfaces;
use isolux_geometry::Bvh;
use rayon::prelude::*;
use serde::Serialize;

/// Rays that met nothing.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub(crate) struct Misses {
    pub(crate) closest_hit: u64,
    pub(crate) any_hit: u64,
}

/// Misses of both kernels.
#[derive(Clone, Copy, Debug, Default, Serialize)]
pub(crate) struct Leaks {
    pub(crate) rays: u64,
    pub(crate) isolux: Misses,
    pub(crate) embree: Option<Misses>,
}

/// Rays made and traced at a time.
const CHUNK: u64 = 1 << 14;

/// Counts over so many rays, with all threads; the same rays for any number of them.
pub(crate) fn count(isolux: &Bvh, embree: Option<&impl Kernel>, rays: u64) -> Leaks {
    let surfaces = Surfaces::new(isolux);
    let chunk = |index: u64| {
        let count = CHUNK.min(rays - index * CHUNK);
        let rays = surfaces.aimed_at_edges(count as usize, &mut Random::new(LEAKS ^ index << 32));
        let misses = |kernel: &dyn Kernel| Misses {
            closest_hit: rays.iter().filter(|ray| kernel.closest(ray).is_none()).count() as u64,
            any_hit: rays.iter().filter(|ray| !kernel.any(ray)).count() as u64,
        };
        Leaks { rays: count, isolux: misses(isolux), embree: embree.map(|e| misses(e)) }
    };
    let chunks = (0..rays.div_ceil(CHUNK)).into_par_iter().map(chunk);
    chunks.reduce_with(Leaks::plus).unwrap_or_default()
}

/// Where the random numbers of this count begin.
const LEAKS: u64 = 0x1ea5;

impl Leaks {
    fn plus(self, other: Self) -> Self {
        Self {
            rays: self.rays + other.rays,
            isolux: self.isolux.plus(other.isolux),
            embree: self.embree.zip(other.embree).map(|(a, b)| a.plus(b)),
        }
    }
}

impl Misses {
    fn plus(self, other: Self) -> Self {
        Self {
            closest_hit: self.closest_hit + other.closest_hit,
            any_hit: self.any_hit + other.any_hit,
        }
    }
}
