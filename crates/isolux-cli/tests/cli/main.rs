//! The command as a user runs it: exit codes, messages, and the shape of what it prints.
#![allow(clippy::unwrap_used, reason = "tests may stop at the first surprise")]

mod all_round;
mod arriving;
mod bad_input;
#[cfg(unix)]
mod caches;
mod dark;
mod daylight;
mod days;
mod degenerate;
mod emergency;
mod engines;
mod errors;
mod glare;
mod grids;
mod groups;
#[cfg(unix)]
mod interrupted;
mod lightmaps;
mod lint;
mod luminances;
mod parts;
mod pictures;
mod plans;
mod power;
mod ran;
#[cfg(unix)]
mod readme;
mod reports;
mod results;
mod rooms;
mod several;
mod skies;
mod tables;
mod views;
#[cfg(unix)]
mod walking;
