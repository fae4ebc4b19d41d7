//! IES LM-63 photometric files, editions 1986, 1991, 1995, 2002 and 2019.
//!
//! [`read`] and [`parse`] give the file as written, an [`IesFile`]; [`IesFile::resolve`] gives the
//! distribution an engine uses; [`write`] makes a file. See the README beside this file for what is read how, and why.

mod across;
mod audit;
mod edition;
mod header;
mod numbers;
mod opening;
mod parse;
mod read;
mod record;
mod resolve;
mod tilt;
mod write;

pub use edition::Edition;
pub use opening::{LuminousOpening, OpeningShape};
pub use parse::parse;
pub use read::read;
pub use record::{IesFile, Keyword, LampFactor, LengthUnit, PhotometricType, RecordLines};
pub use tilt::{LampGeometry, Tilt, TiltTable};
pub use write::{Photometry, SIMULATED, UNDEFINED, write};
