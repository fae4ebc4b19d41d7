//! What compressed parts of a file hold, and how much that may be.

use super::limits;
use super::notes::Flaw;
use std::collections::HashMap;

/// What compressed parts of the file hold.
#[derive(Default)]
pub(super) struct Unpacked {
    /// Bytes of buffer views, by index.
    pub(super) views: HashMap<usize, Vec<u8>>,
    /// Elements of accessors, by index.
    pub(super) accessors: HashMap<usize, Elements>,
}

/// Elements of an accessor one after the other, in its own format.
pub(super) struct Elements {
    pub(super) count: usize,
    pub(super) bytes: Vec<u8>,
    /// The primitive they were stored with.
    pub(super) source: (usize, usize),
}

/// Bytes that may still be unpacked: what small files make large is bounded for all of them together.
pub(super) struct Budget(u64);

impl Budget {
    pub(super) const fn new() -> Self {
        Self(limits::UNPACKED_BYTES)
    }

    pub(super) fn spend(&mut self, bytes: Option<u64>) -> Result<(), Flaw> {
        self.0 = bytes.and_then(|bytes| self.0.checked_sub(bytes)).ok_or_else(|| {
            let what = format!("compressed data of more than {} bytes", limits::UNPACKED_BYTES);
            Flaw::new(what, "split the scene")
        })?;
        Ok(())
    }

    pub(super) const fn left(&self) -> u64 {
        self.0
    }
}
