//! Checkpoints: the state of a run, enough to go on bit for bit.
//!
//! There are three kinds: the state of a run, the result of a pilot, and parts of a run (increments made apart).
//!
//! A header in JSON (hash of the scene, settings, version, counters: the engine's business) and
//! named arrays of integers. In the file: `ISOLUXCK`, the format version and the length of a JSON
//! text as `u32`, the text (`header`, and `name` and `bytes` of each array), the arrays one after
//! another, the BLAKE3 hash of all before it. Everything is little-endian.

mod file;
mod integer;
mod run;

pub use file::{from_bytes, is_checkpoint, read, to_bytes, write};
pub use integer::Integer;
pub use run::{Contents, Part, contents, of_part, of_pilot, of_state, part, pilot, state};

use serde_json::Value;

/// The state of a run.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Checkpoint {
    /// What the arrays belong to.
    pub header: Value,
    /// Names and contents, little-endian; no name twice.
    pub arrays: Vec<(String, Vec<u8>)>,
}

/// Why an array cannot be had.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum ArrayError {
    /// There is none of this name.
    #[error("the checkpoint has no array `{0}`")]
    Missing(String),
    /// It is not made of integers of this size.
    #[error("array `{name}` of the checkpoint has {bytes} bytes, not a multiple of {size}")]
    Size {
        /// Name of the array.
        name: String,
        /// Its length.
        bytes: usize,
        /// Bytes of one integer.
        size: usize,
    },
}

impl Checkpoint {
    /// A checkpoint without arrays.
    pub fn new(header: Value) -> Self {
        Self { header, arrays: Vec::new() }
    }

    /// Adds an array, in place of one of the same name.
    pub fn push<T: Integer>(&mut self, name: impl Into<String>, values: &[T]) {
        let name = name.into();
        self.arrays.retain(|(known, _)| *known != name);
        let mut bytes = Vec::with_capacity(values.len() * T::BYTES);
        for value in values {
            value.append_to(&mut bytes);
        }
        self.arrays.push((name, bytes));
    }

    /// The bytes of an array.
    pub fn array(&self, name: &str) -> Result<&[u8], ArrayError> {
        let array = self.arrays.iter().find(|(found, _)| found == name);
        array.map(|(_, bytes)| bytes.as_slice()).ok_or_else(|| ArrayError::Missing(name.to_owned()))
    }

    /// The integers of an array.
    pub fn integers<T: Integer>(&self, name: &str) -> Result<Vec<T>, ArrayError> {
        let bytes = self.array(name)?;
        if bytes.len() % T::BYTES != 0 {
            let (name, bytes) = (name.to_owned(), bytes.len());
            return Err(ArrayError::Size { name, bytes, size: T::BYTES });
        }
        Ok(bytes.chunks_exact(T::BYTES).map(T::from_chunk).collect())
    }
}
