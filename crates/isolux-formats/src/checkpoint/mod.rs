//! Checkpoints: the state of a run, enough to go on bit for bit.
//!
//! There are three kinds: the state of a run, the result of a pilot, and parts of a run (increments made apart).
//!
//! A header in JSON (hash of the scene, settings, version, counters: the engine's business) and
//! named arrays of integers. In the file: `ISOLUXCK`, the format version and the length of a JSON
//! text as `u32`, the text (`header`, and `name` and `bytes` of each array), the arrays one after
//! another, the BLAKE3 hash of all before it. Everything is little-endian.

mod draft;
mod file;
mod integer;
mod run;

pub use draft::Draft;
pub use file::{from_bytes, is_checkpoint, read, to_bytes, write};
pub use integer::Integer;
pub use run::{Contents, Part, contents, of_part, of_pilot, of_state, part, pilot, state};

use serde_json::Value;
use std::ops::Range;

/// A checkpoint that was read. Its arrays stay where they were in the file.
#[derive(Clone, Debug, PartialEq)]
pub struct Checkpoint {
    /// What the arrays belong to.
    pub header: Value,
    bytes: Vec<u8>,
    /// Names and places of the arrays; no name twice.
    arrays: Vec<(String, Range<usize>)>,
}

/// Why an array cannot be had.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum ArrayError {
    /// There is none of this name.
    #[error("the checkpoint has no array `{0}`")]
    Missing(String),
    /// It is not made of rows of this size.
    #[error("array `{name}` of the checkpoint has {bytes} bytes, not a multiple of {size}")]
    Size {
        /// Name of the array.
        name: String,
        /// Its length.
        bytes: usize,
        /// Bytes of one row.
        size: usize,
    },
}

impl Checkpoint {
    /// The bytes of an array.
    pub fn array(&self, name: &str) -> Result<&[u8], ArrayError> {
        let array = self.arrays.iter().find(|(found, _)| found == name);
        let (_, place) = array.ok_or_else(|| ArrayError::Missing(name.to_owned()))?;
        Ok(&self.bytes[place.clone()])
    }

    /// The rows of an array: so many integers each.
    pub fn rows<'c, T: Integer, const N: usize>(
        &'c self,
        name: &str,
    ) -> Result<impl Iterator<Item = [T; N]> + use<'c, T, N>, ArrayError> {
        let (bytes, size) = (self.array(name)?, N * T::BYTES);
        if bytes.len() % size != 0 {
            let (name, bytes) = (name.to_owned(), bytes.len());
            return Err(ArrayError::Size { name, bytes, size });
        }
        let row =
            |row: &[u8]| std::array::from_fn(|k| T::from_chunk(&row[k * T::BYTES..][..T::BYTES]));
        Ok(bytes.chunks_exact(size).map(row))
    }
}
