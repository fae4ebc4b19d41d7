//! Profiles of displays: known values, round trips, files made here, and files that are none.
#![allow(clippy::unwrap_used, reason = "tests may stop at the first surprise")]

mod hostile;
mod known;
mod made;
mod round_trips;
