//! Memory of the tree: whole cache lines, on huge pages where the system has them.
#![allow(unsafe_code, reason = "lines seen as words, and advice to the system")]

/// Words of 32 bits of a line.
pub(super) const LINE: usize = 16;

/// A cache line.
#[derive(Clone, Copy, Debug, Default)]
#[repr(C, align(64))]
pub(super) struct Line([u32; LINE]);

/// An empty vector with room for so many lines.
pub(super) fn with_capacity(lines: usize) -> Vec<Line> {
    let lines = Vec::with_capacity(lines);
    ask_for_huge_pages(&lines);
    lines
}

/// All words of some lines, to be written.
pub(super) fn words_mut(lines: &mut [Line]) -> &mut [u32] {
    // SAFETY: a line is its words in a row, without padding.
    unsafe { std::slice::from_raw_parts_mut(lines.as_mut_ptr().cast(), lines.len() * LINE) }
}

/// Fewer bytes fit the translation buffers of processors in ordinary pages.
#[cfg(target_os = "linux")]
const LARGE: usize = 4 << 20;

/// Rays jump all over a large tree: with 512 times fewer pages, fewer of their addresses must be
/// looked up.
#[cfg(target_os = "linux")]
fn ask_for_huge_pages(lines: &Vec<Line>) {
    use rustix::mm::{Advice, madvise};
    let (page, bytes) = (rustix::param::page_size(), lines.capacity() * size_of::<Line>());
    let to_page = lines.as_ptr().cast::<u8>().align_offset(page);
    if bytes < LARGE + to_page {
        return;
    }
    let start = lines.as_ptr().cast::<u8>().wrapping_add(to_page).cast_mut();
    let whole_pages = (bytes - to_page) / page * page;
    // SAFETY: the pages lie within the capacity of `lines`, and the advice changes nothing but how
    // they are backed. That it may be refused does not matter.
    let _refused = unsafe { madvise(start.cast(), whole_pages, Advice::LinuxHugepage) };
}

#[cfg(not(target_os = "linux"))]
fn ask_for_huge_pages(_: &Vec<Line>) {}
