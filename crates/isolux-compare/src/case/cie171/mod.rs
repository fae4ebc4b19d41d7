//! The analytic cases of CIE 171:2006, "Test cases to assess the accuracy of lighting computer programs",
//! 5.2 to 5.14.
//!
//! Each follows the idea of a case of the standard; its geometry is our own but for the room of 4 m by
//! 4 m by 3 m, and every answer is derived anew: closed forms or quadrature, in the file of the case. No table of
//! the standard is copied.

mod area;
mod facade;
mod flux;
mod internal;
mod listing;
mod pane;
mod panel;
mod point;
mod reflection;
mod roof;
mod room;
mod sky;
mod street;
mod visible;
mod window;

pub use listing::{CASES, LeftOut, Listed, left_out};

use crate::expectation::Case;

/// All of them, by the number of the standard.
pub fn cases() -> Vec<Case> {
    let mut all = Vec::from(point::cases());
    all.extend([area::case(), flux::case(), pane::case()]);
    all.extend(reflection::cases());
    all.extend(internal::cases());
    all.extend(roof::cases());
    let [unglazed, glazed, slab, wall] = facade::cases();
    all.push(unglazed);
    all.extend(window::cases());
    all.extend([glazed, slab, wall]);
    all
}
