//! Rays as the kernel reads them: in its own coordinates.

use crate::{Point, Ray};

/// A ray in the coordinates of a kernel.
#[derive(Clone, Copy, Debug)]
pub(super) struct Local {
    /// Start, metres from the origin of the kernel.
    pub(super) origin: [f32; 3],
    pub(super) direction: [f32; 3],
    /// Open end of the interval searched.
    pub(super) t_max: f32,
    pub(super) skip: Option<u32>,
}

impl Local {
    /// A ray as a kernel of this origin reads it.
    #[inline(always)]
    pub(super) fn of(ray: &Ray, kernel_origin: Point) -> Self {
        Self {
            origin: (ray.origin - kernel_origin).to_f32(),
            direction: ray.direction,
            t_max: ray.t_max(kernel_origin),
            skip: ray.skip,
        }
    }
}
