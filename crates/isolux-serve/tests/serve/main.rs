//! A server on a loopback address, and clients that write bytes to it.
#![allow(clippy::unwrap_used, reason = "tests may stop at the first surprise")]

mod client;
mod endpoints;
mod events;
mod fake;
mod hostile;
mod random;
mod running;
mod slow;
mod viewer;
