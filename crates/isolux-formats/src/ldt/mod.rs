//! EULUMDAT photometric files (Stockmar 1990).
//!
//! [`read`] and [`parse`] give the file as written, an [`LdtFile`]; [`LdtFile::resolve`] gives the
//! distribution an engine uses; [`write()`] makes a file. See the README beside this file for what is read how, and why.

mod audit;
mod fields;
mod parse;
mod record;
mod resolve;
mod write;

pub use parse::{parse, read};
pub use record::{Header, LampSet, LdtFile, LdtSymmetry, LuminaireKind, RecordLines, Sizes};
pub use write::write;
