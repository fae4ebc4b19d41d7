//! Figures with their intervals of 95 %, by the name that most of the command has for them.

pub(crate) use isolux::map::{Figure as Interval, Verdict};
