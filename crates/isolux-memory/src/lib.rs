//! Memory of the program: how much is in use, a bound on it, and an end in words where there is no more.
//!
//! A program whose allocation fails is aborted by the standard library. [`Counted`] calls a function of the program
//! first, which may end it with an exit code and a message. Threads count what they take by themselves, and add it up
//! in steps of 64 KiB; so the sums are right to that for each thread, and small allocations cost no more than before.
#![expect(unsafe_code, reason = "an allocator cannot be written otherwise")]

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicBool, AtomicIsize, Ordering};
use std::time::Duration;

/// Bytes that a thread takes or gives back before it adds them to those of all.
const STEP: isize = 64 << 10;
/// Between two looks of a thread that waits for the end.
const NAP: Duration = Duration::from_secs(1);

/// Bytes in use, the most so far, and the most allowed.
static USED: AtomicIsize = AtomicIsize::new(0);
static PEAK: AtomicIsize = AtomicIsize::new(0);
static ALLOWED: AtomicIsize = AtomicIsize::new(isize::MAX);
/// Whether the program is being ended.
static IS_ENDING: AtomicBool = AtomicBool::new(false);
static END: OnceLock<End> = OnceLock::new();

thread_local! {
    /// Bytes of this thread that are not in `USED` yet.
    static OWN: Cell<isize> = const { Cell::new(0) };
    /// Whether it is this thread that ends the program.
    static ENDS: Cell<bool> = const { Cell::new(false) };
}

/// What ends a program that lacks memory.
pub type End = fn(Lack) -> !;

/// The lack of memory.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Lack {
    /// Bytes that were asked for.
    pub wanted: usize,
    /// Bytes in use.
    pub used: usize,
    /// The bound that they would pass; `None` where the machine gives no more.
    pub allowed: Option<usize>,
}

/// The allocator of the system, counted and bounded.
pub struct Counted;

/// Bounds the memory of the program, bytes. What is in use already stays.
pub fn allow(bytes: u64) {
    ALLOWED.store(isize::try_from(bytes).unwrap_or(isize::MAX), Ordering::Relaxed);
}

/// From now on this ends the program where memory is lacking. The first function that is given stays.
pub fn end_by(end: End) {
    let _ = END.set(end);
}

/// The most bytes that were in use at a time.
pub fn peak_bytes() -> u64 {
    PEAK.load(Ordering::Relaxed).max(0) as u64
}

impl Counted {
    /// Whether so many bytes more are allowed; they count as used then.
    fn take(bytes: usize) -> bool {
        let bytes = isize::try_from(bytes).unwrap_or(isize::MAX);
        let own = OWN.get().saturating_add(bytes);
        if own < STEP {
            OWN.set(own);
            return true;
        }
        let used = USED.fetch_add(own, Ordering::Relaxed).saturating_add(own);
        OWN.set(0);
        if used > ALLOWED.load(Ordering::Relaxed) && !ENDS.get() {
            return false;
        }
        if used > PEAK.load(Ordering::Relaxed) {
            PEAK.fetch_max(used, Ordering::Relaxed);
        }
        true
    }

    fn give_back(bytes: usize) {
        let own = OWN.get().saturating_sub(isize::try_from(bytes).unwrap_or(isize::MAX));
        if own > -STEP {
            OWN.set(own);
            return;
        }
        USED.fetch_add(own, Ordering::Relaxed);
        OWN.set(0);
    }

    /// Ends the program, if it can be ended in words.
    fn lack(wanted: usize, allowed: Option<isize>) {
        let (Some(end), false) = (END.get(), ENDS.get()) else { return };
        if IS_ENDING.swap(true, Ordering::Relaxed) {
            // Another thread does it.
            loop {
                std::thread::sleep(NAP);
            }
        }
        // What the end takes is not refused.
        ENDS.set(true);
        let of = |bytes: isize| usize::try_from(bytes).unwrap_or(0);
        let used = of(USED.load(Ordering::Relaxed)).saturating_sub(wanted);
        end(Lack { wanted, used, allowed: allowed.map(of) })
    }

    fn within_bound(bytes: usize) {
        if !Self::take(bytes) {
            Self::lack(bytes, Some(ALLOWED.load(Ordering::Relaxed)));
        }
    }

    fn there(pointer: *mut u8, bytes: usize) -> *mut u8 {
        if pointer.is_null() {
            Self::lack(bytes, None);
        }
        pointer
    }
}

// SAFETY: all memory is that of the allocator of the system, which is asked with the layouts that came in.
unsafe impl GlobalAlloc for Counted {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        Self::within_bound(layout.size());
        // SAFETY: the caller vouches for the layout.
        Self::there(unsafe { System.alloc(layout) }, layout.size())
    }

    unsafe fn alloc_zeroed(&self, layout: Layout) -> *mut u8 {
        Self::within_bound(layout.size());
        // SAFETY: the caller vouches for the layout.
        Self::there(unsafe { System.alloc_zeroed(layout) }, layout.size())
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        Self::give_back(layout.size());
        // SAFETY: the pointer came from `System`, with this layout.
        unsafe { System.dealloc(pointer, layout) }
    }

    unsafe fn realloc(&self, pointer: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        // The old piece may have to be there until the new one is filled.
        Self::within_bound(size);
        // SAFETY: the pointer came from `System`, with this layout; the caller vouches for the size.
        let moved = Self::there(unsafe { System.realloc(pointer, layout, size) }, size);
        Self::give_back(if moved.is_null() { size } else { layout.size() });
        moved
    }
}
