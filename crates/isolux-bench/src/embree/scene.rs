//! A scene of Embree and the rays through it.

use super::abi::{self, Handle, RtcHit, RtcRay, RtcRayHit};
use super::device::Embree;
use crate::kernel::{Kernel, Meeting};
use isolux_geometry::{Point, Ray, TriangleMesh};
use std::ffi::c_int;
use std::ptr::null_mut;

/// A committed scene of one mesh.
pub(crate) struct EmbreeScene<'a> {
    embree: &'a Embree,
    scene: Handle,
    /// Embree reads coordinates as our kernel does: counted from here.
    origin: Point,
}

// SAFETY: the scene is committed before it is shared and never changed, and Embree allows queries
// of a committed scene from any number of threads.
unsafe impl Sync for EmbreeScene<'_> {}

impl<'a> EmbreeScene<'a> {
    /// The robust scene of a mesh, built at medium quality by all threads.
    pub(crate) fn build(embree: &'a Embree, mesh: &TriangleMesh) -> Result<Self, String> {
        let f = &embree.functions;
        // SAFETY: the device is alive; the scene lives until it is dropped, the geometry until it is
        // released, and the scene keeps what is attached to it.
        unsafe {
            let scene = (f.new_scene)(embree.device);
            (f.set_scene_flags)(scene, abi::SCENE_FLAG_ROBUST);
            (f.set_build_quality)(scene, abi::BUILD_QUALITY_MEDIUM);
            let geometry = (f.new_geometry)(embree.device, abi::GEOMETRY_TYPE_TRIANGLE);
            fill(embree, geometry, abi::BUFFER_TYPE_VERTEX, abi::FORMAT_FLOAT3, &mesh.positions);
            fill(embree, geometry, abi::BUFFER_TYPE_INDEX, abi::FORMAT_UINT3, &mesh.triangles);
            (f.commit_geometry)(geometry);
            (f.attach_geometry)(scene, geometry);
            (f.release_geometry)(geometry);
            (f.commit_scene)(scene);
            match (f.device_error)(embree.device) {
                0 => Ok(Self { embree, scene, origin: mesh.origin }),
                code => Err(format!("Embree could not build the scene: error {code}")),
            }
        }
    }
}

/// Makes a buffer of a geometry and copies the values into it; without memory Embree makes none
/// and reports the error to whoever asks the device.
///
/// # Safety
/// The geometry must be alive, and `T` of the format.
unsafe fn fill<T: Copy>(
    embree: &Embree,
    geometry: Handle,
    kind: c_int,
    format: c_int,
    values: &[T],
) {
    let new_buffer = embree.functions.new_buffer;
    // SAFETY: the caller vouches for the geometry; the buffer holds as many values as are copied
    // and nobody else knows it yet.
    unsafe {
        let buffer = new_buffer(geometry, kind, 0, format, size_of::<T>(), values.len());
        if !buffer.is_null() {
            std::ptr::copy_nonoverlapping(values.as_ptr(), buffer.cast::<T>(), values.len());
        }
    }
}

fn to_rtc(ray: &Ray, origin: Point) -> RtcRay {
    RtcRay {
        origin: (ray.origin - origin).to_f32(),
        t_near: 0.0,
        direction: ray.direction,
        time: 0.0,
        t_far: ray.t_max(origin),
        mask: u32::MAX,
        id: 0,
        flags: 0,
    }
}

const NO_HIT: RtcHit = RtcHit {
    normal: [0.0; 3],
    u: 0.0,
    v: 0.0,
    primitive: abi::INVALID_ID,
    geometry: abi::INVALID_ID,
    instance: [abi::INVALID_ID; 2],
};

impl Kernel for EmbreeScene<'_> {
    #[inline]
    fn closest(&self, ray: &Ray) -> Option<Meeting> {
        let mut query = RtcRayHit { ray: to_rtc(ray, self.origin), hit: NO_HIT };
        // SAFETY: the scene is committed, the query is as large and aligned as Embree asks, and
        // null stands for the default arguments.
        unsafe { (self.embree.functions.intersect)(self.scene, &raw mut query, null_mut()) };
        let RtcHit { u, v, primitive, geometry, .. } = query.hit;
        let meeting = Meeting { t: query.ray.t_far, u, v, triangle: primitive };
        (geometry != abi::INVALID_ID).then_some(meeting)
    }

    #[inline]
    fn any(&self, ray: &Ray) -> bool {
        let mut query = to_rtc(ray, self.origin);
        // SAFETY: as for `closest`.
        unsafe { (self.embree.functions.occluded)(self.scene, &raw mut query, null_mut()) };
        query.t_far == f32::NEG_INFINITY
    }
}

impl Drop for EmbreeScene<'_> {
    fn drop(&mut self) {
        // SAFETY: the scene is alive and released once.
        unsafe { (self.embree.functions.release_scene)(self.scene) };
    }
}
