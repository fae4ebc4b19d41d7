//! The loaded library.

use super::abi::{self, Functions, Handle};
use super::find;
use libloading::Library;
use std::ptr::null_mut;
use std::sync::atomic::{AtomicIsize, Ordering};

/// The loaded library and its device.
pub(crate) struct Embree {
    pub(super) device: Handle,
    pub(super) functions: Functions,
    /// Keeps the functions valid.
    _library: Library,
}

/// Bytes that Embree holds.
static BYTES: AtomicIsize = AtomicIsize::new(0);

/// Called by Embree, from any thread, before it takes memory and after it gives some back.
unsafe extern "C" fn count_bytes(_data: Handle, bytes: isize, _is_after: bool) -> bool {
    BYTES.fetch_add(bytes, Ordering::Relaxed);
    true
}

impl Embree {
    /// Loads the library; the error says what is missing and how to get it.
    pub(crate) fn load() -> Result<Self, String> {
        let path = find::library()?;
        let refused = |e: libloading::Error| format!("{}: {e}", path.display());
        // SAFETY: the user or `cargo xtask bench setup` named this file as Embree, whose
        // initializers only fill tables of its own.
        let library = unsafe { Library::new(&path) }.map_err(refused)?;
        // SAFETY: the names are those of Embree 4, and `version` refuses any other below.
        let functions = unsafe { Functions::of(&library) }.map_err(refused)?;
        // SAFETY: no configuration is allowed to be null.
        let device = unsafe { (functions.new_device)(std::ptr::null()) };
        if device.is_null() {
            return Err(format!("{}: Embree makes no device", path.display()));
        }
        let embree = Self { device, functions, _library: library };
        let [major, ..] = embree.version();
        if major != 4 {
            return Err(format!("{}: Embree {major}, but 4 is asked for", path.display()));
        }
        // SAFETY: the device is alive, and the function has the type asked for and no data.
        unsafe { (embree.functions.set_memory_monitor)(embree.device, count_bytes, null_mut()) };
        Ok(embree)
    }

    /// Major, minor and patch.
    pub(crate) fn version(&self) -> [isize; 3] {
        let property = self.functions.device_property;
        // SAFETY: the device is alive, and every version of Embree knows this property.
        let version = unsafe { property(self.device, abi::DEVICE_PROPERTY_VERSION) };
        [version / 10_000, version / 100 % 100, version % 100]
    }

    /// Bytes held for all scenes, with their triangles.
    pub(crate) fn bytes(&self) -> usize {
        BYTES.load(Ordering::Relaxed).max(0) as usize
    }
}

impl Drop for Embree {
    fn drop(&mut self) {
        // SAFETY: the device is alive; scenes borrow it and are gone.
        unsafe { (self.functions.release_device)(self.device) };
    }
}
