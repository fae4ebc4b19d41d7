//! The ray kernel against its specification.

mod agreement;
mod degenerate;
mod instances;
mod room;
mod watertight;
