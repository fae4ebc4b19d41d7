//! The ray kernel against its specification.

mod agreement;
mod degenerate;
mod instances;
mod moved;
mod room;
mod watertight;
