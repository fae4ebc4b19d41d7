//! Pixels as files hold them.

/// Pixels that are read: 8192 by 4096.
const MOST_PIXELS: u64 = 1 << 25;

/// Pixels of a file, in its own unit.
pub(super) struct Pixels {
    pub(super) width: u32,
    pub(super) height: u32,
    pub(super) rgb: Vec<[f32; 3]>,
}

/// Whether a file of this size is read.
pub(super) fn check_size(width: u64, height: u64) -> Result<(u32, u32), String> {
    let pixels = width.checked_mul(height).filter(|&n| n > 0 && n <= MOST_PIXELS);
    let small = |side: u64| u32::try_from(side).ok();
    match (pixels, small(width), small(height)) {
        (Some(_), Some(width), Some(height)) => Ok((width, height)),
        _ => Err(format!("has {width} x {height} pixels; 1 to {MOST_PIXELS} are read")),
    }
}
