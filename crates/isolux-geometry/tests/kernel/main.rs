//! The ray kernel against its specification.

mod agreement;
mod degenerate;
mod room;
mod watertight;
