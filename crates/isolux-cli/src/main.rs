//! The isolux command.
fn main() {}
