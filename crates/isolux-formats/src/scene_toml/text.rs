//! The text of a file.

use crate::{Problem, source};
use std::path::Path;

const MOST_BYTES: u64 = 64 << 20;

/// Reads UTF-8 or UTF-16, with or without a byte order mark.
pub(super) fn of(path: &Path) -> Result<String, Problem> {
    let bytes = source::read_bytes(path, MOST_BYTES)?;
    if source::is_utf16(&bytes) {
        return Ok(source::decoded(bytes));
    }
    let bytes = source::without_mark(&bytes);
    let text = std::str::from_utf8(bytes).map_err(|error| {
        let line = 1 + bytes[..error.valid_up_to()].iter().filter(|&&byte| byte == b'\n').count();
        Problem::new(path, format!("line {line}"), "is not UTF-8", "save the file as UTF-8")
    })?;
    Ok(text.to_owned())
}
