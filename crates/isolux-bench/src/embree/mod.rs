//! Embree 4, loaded at run time where there is one: the outside measure of the ray kernel.
#![expect(unsafe_code, reason = "a C library cannot be called otherwise; only the bench does")]

mod abi;
mod device;
mod find;
mod scene;

pub(crate) use device::Embree;
pub(crate) use scene::EmbreeScene;
