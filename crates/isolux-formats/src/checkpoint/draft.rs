//! Checkpoints on their way to a file.

use super::Integer;
use serde_json::Value;
use std::fmt;
use std::io::{self, Write};

/// A checkpoint to be written. Its arrays write themselves from what they are of, so that nothing of their size is held beside that.
#[derive(Debug)]
pub struct Draft<'a> {
    pub(super) header: Value,
    pub(super) arrays: Vec<DraftArray<'a>>,
}

pub(super) struct DraftArray<'a> {
    pub(super) name: String,
    pub(super) bytes: usize,
    pub(super) write: Box<WriteArray<'a>>,
}

type WriteArray<'a> = dyn Fn(&mut dyn Write) -> io::Result<()> + 'a;

impl fmt::Debug for DraftArray<'_> {
    fn fmt(&self, to: &mut fmt::Formatter<'_>) -> fmt::Result {
        to.debug_struct("DraftArray").field("name", &self.name).finish_non_exhaustive()
    }
}

impl<'a> Draft<'a> {
    /// A checkpoint without arrays.
    pub const fn new(header: Value) -> Self {
        Self { header, arrays: Vec::new() }
    }

    /// Adds an array of rows of integers. No other may have its name.
    pub fn push<T: Integer, const N: usize>(
        &mut self,
        name: impl Into<String>,
        rows: impl ExactSizeIterator<Item = [T; N]> + Clone + 'a,
    ) {
        let bytes = rows.len() * N * T::BYTES;
        let write = move |to: &mut dyn Write| {
            rows.clone().flatten().try_for_each(|value| value.write_to(to))
        };
        self.push_written(name, bytes, write);
    }

    /// Adds an array that a function writes: always as many bytes as are said here.
    pub(super) fn push_written(
        &mut self,
        name: impl Into<String>,
        bytes: usize,
        write: impl Fn(&mut dyn Write) -> io::Result<()> + 'a,
    ) {
        self.arrays.push(DraftArray { name: name.into(), bytes, write: Box::new(write) });
    }
}
