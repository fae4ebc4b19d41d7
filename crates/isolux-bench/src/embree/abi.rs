//! What of the binary interface of Embree 4 is used, after its headers `rtcore_*.h`.

use libloading::Library;
use std::ffi::{c_char, c_int, c_uint, c_void};

/// A device, a scene, a geometry or a buffer.
pub(super) type Handle = *mut c_void;
pub(super) type MemoryMonitor = unsafe extern "C" fn(Handle, isize, bool) -> bool;

pub(super) const DEVICE_PROPERTY_VERSION: c_int = 0;
pub(super) const GEOMETRY_TYPE_TRIANGLE: c_int = 0;
pub(super) const BUFFER_TYPE_INDEX: c_int = 0;
pub(super) const BUFFER_TYPE_VERTEX: c_int = 1;
pub(super) const FORMAT_UINT3: c_int = 0x5003;
pub(super) const FORMAT_FLOAT3: c_int = 0x9003;
pub(super) const SCENE_FLAG_ROBUST: c_int = 1 << 2;
pub(super) const BUILD_QUALITY_MEDIUM: c_int = 1;
pub(super) const INVALID_ID: c_uint = c_uint::MAX;

/// `RTCRay`.
#[repr(C, align(16))]
pub(super) struct RtcRay {
    pub(super) origin: [f32; 3],
    pub(super) t_near: f32,
    pub(super) direction: [f32; 3],
    pub(super) time: f32,
    pub(super) t_far: f32,
    pub(super) mask: c_uint,
    pub(super) id: c_uint,
    pub(super) flags: c_uint,
}

/// `RTCHit`, with room for the instance and its primitive of one level.
#[repr(C, align(16))]
pub(super) struct RtcHit {
    pub(super) normal: [f32; 3],
    pub(super) u: f32,
    pub(super) v: f32,
    pub(super) primitive: c_uint,
    pub(super) geometry: c_uint,
    pub(super) instance: [c_uint; 2],
}

/// `RTCRayHit`.
#[repr(C, align(16))]
pub(super) struct RtcRayHit {
    pub(super) ray: RtcRay,
    pub(super) hit: RtcHit,
}

/// Declares the functions and how they are looked up by name.
macro_rules! functions {
    ($($field:ident = $symbol:literal: fn($($argument:ty),*) $(-> $result:ty)?;)*) => {
        /// The functions of the library, valid as long as it is loaded.
        pub(super) struct Functions {
            $(pub(super) $field: unsafe extern "C" fn($($argument),*) $(-> $result)?,)*
        }

        impl Functions {
            /// # Safety
            /// The library must be Embree 4: its functions must have the types declared here.
            pub(super) unsafe fn of(library: &Library) -> Result<Self, libloading::Error> {
                // SAFETY: the caller vouches for the types, which are those of Embree's headers.
                unsafe { Ok(Self { $($field: *library.get($symbol)?,)* }) }
            }
        }
    };
}

functions! {
    new_device = "rtcNewDevice": fn(*const c_char) -> Handle;
    release_device = "rtcReleaseDevice": fn(Handle);
    device_property = "rtcGetDeviceProperty": fn(Handle, c_int) -> isize;
    device_error = "rtcGetDeviceError": fn(Handle) -> c_int;
    set_memory_monitor = "rtcSetDeviceMemoryMonitorFunction": fn(Handle, MemoryMonitor, Handle);
    new_scene = "rtcNewScene": fn(Handle) -> Handle;
    release_scene = "rtcReleaseScene": fn(Handle);
    set_scene_flags = "rtcSetSceneFlags": fn(Handle, c_int);
    set_build_quality = "rtcSetSceneBuildQuality": fn(Handle, c_int);
    new_geometry = "rtcNewGeometry": fn(Handle, c_int) -> Handle;
    release_geometry = "rtcReleaseGeometry": fn(Handle);
    new_buffer = "rtcSetNewGeometryBuffer":
        fn(Handle, c_int, c_uint, c_int, usize, usize) -> *mut c_void;
    commit_geometry = "rtcCommitGeometry": fn(Handle);
    attach_geometry = "rtcAttachGeometry": fn(Handle, Handle) -> c_uint;
    commit_scene = "rtcCommitScene": fn(Handle);
    intersect = "rtcIntersect1": fn(Handle, *mut RtcRayHit, *mut c_void);
    occluded = "rtcOccluded1": fn(Handle, *mut RtcRay, *mut c_void);
}
