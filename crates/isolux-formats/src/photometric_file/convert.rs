//! One format into the other, with a statement of what is lost.

use super::{Difference, PhotometricFile, to_ies, to_ldt};
use crate::{Problem, Problems, ies, ldt};
use std::path::Path;

/// The format to write.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Target {
    /// IES LM-63-2019.
    Ies,
    /// EULUMDAT.
    Ldt,
}

/// A file of the other format, and what it does not hold of the first.
#[derive(Clone, Debug, PartialEq)]
pub struct Conversion {
    /// The file, in UTF-8.
    pub text: String,
    /// What could not be represented, or not exactly, a sentence each.
    pub losses: Vec<String>,
    /// The distribution of the new file as read back, against that of the first.
    pub difference: Difference,
}

/// Converts a file into the other format; directions stay where they are.
pub fn convert(file: &PhotometricFile, target: Target) -> Result<Conversion, Problems> {
    let web = file.web()?;
    let (text, mut losses) = match (file, target) {
        (PhotometricFile::Ies(from), Target::Ldt) => {
            let (record, losses) = to_ldt::record(from, &web)?;
            (ldt::write(&record), losses)
        }
        (PhotometricFile::Ldt(from), Target::Ies) => {
            let (photometry, losses) = to_ies::photometry(from, &web);
            (ies::write(&photometry), losses)
        }
        (PhotometricFile::Ies(_), Target::Ies) | (PhotometricFile::Ldt(_), Target::Ldt) => {
            let what = "has that format already";
            return Err(Problem::new(file.path(), "", what, "copy it").into());
        }
    };
    if !text.is_ascii() {
        let loss = "letters beyond ASCII are written as UTF-8, which older programs show wrongly";
        losses.push(loss.into());
    }
    let back = match target {
        Target::Ies => {
            let no_tilt = &mut |_: &str| Err(Problem::new(file.path(), "", "no tilt", "none"));
            ies::parse(text.as_bytes(), Path::new("converted.ies"), no_tilt)?.value.resolve()?
        }
        Target::Ldt => ldt::parse(text.as_bytes(), Path::new("converted.ldt"))?.value.resolve()?,
    };
    let Some(difference) = Difference::to(&web, &back) else {
        return Err(Problem::new(file.path(), "", "holds no table", "give a measured file").into());
    };
    Ok(Conversion { text, losses, difference })
}
