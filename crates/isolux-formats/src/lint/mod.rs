//! The audit of a photometric file: what is wrong, doubtful or unusual in it, where, and what to do.
//!
//! Thresholds are stated beside each rule; they are rules of thumb of photometric practice, and no
//! finding below an error keeps a file from being used.

mod coverage;
mod factors;
mod finding;
mod flux;
mod ies_fields;
mod ldt_fields;
mod spikes;
mod symmetry;
mod table;
mod text;

pub use finding::{Finding, Severity};

use crate::photometric_file::PhotometricFile;
use crate::plain_text::{decode, lines, read_bounded};
use crate::{Loaded, Problems};
use isolux::photometry::PhotometricWeb;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Largest file read, bytes; as for reading.
const MAX_FILE: u64 = 64 << 20;

/// What is known of a file.
#[derive(Clone, Debug)]
pub struct Audit {
    /// The file.
    pub file: PathBuf,
    /// Its content and its distribution; `None` of a file that cannot be used.
    pub usable: Option<(PhotometricFile, Arc<PhotometricWeb>)>,
    /// What was found, by severity and line.
    pub findings: Vec<Finding>,
}

impl Audit {
    /// Whether the file can be used.
    pub fn is_usable(&self) -> bool {
        self.usable.is_some()
    }
}

/// Reads and audits a file.
pub fn lint(path: &Path) -> Audit {
    // The text is read again: a record does not keep how it was spelt.
    let bytes = read_bounded(path, MAX_FILE).unwrap_or_default();
    audit(path, &bytes, PhotometricFile::read(path))
}

/// Audits what was made of the bytes of a file.
pub fn audit(path: &Path, bytes: &[u8], read: Result<Loaded<PhotometricFile>, Problems>) -> Audit {
    let mut findings = Vec::new();
    let usable = match read {
        Ok(Loaded { value, warnings }) => {
            let warning = |p: &crate::Problem| Finding::of_reading(p, path, Severity::Warning);
            findings.extend(warnings.iter().map(warning));
            match value.web() {
                Ok(web) => Some((value, web)),
                Err(problem) => {
                    findings.push(Finding::of_reading(&problem, path, Severity::Error));
                    None
                }
            }
        }
        Err(problems) => {
            let error = |p: &crate::Problem| Finding::of_reading(p, path, Severity::Error);
            findings.extend(problems.0.iter().map(error));
            None
        }
    };
    if let Some((file, web)) = &usable {
        findings.extend(of_content(file, web));
        if let Ok(text) = decode(bytes, path) {
            findings.extend(text::findings(&lines(&text), bytes, file));
        }
    }
    findings.sort_by_key(|f| (f.severity, f.line));
    Audit { file: path.to_owned(), usable, findings }
}

fn of_content(file: &PhotometricFile, web: &PhotometricWeb) -> Vec<Finding> {
    let table = table::Table::of(file);
    let mut findings = flux::findings(file, web);
    findings.extend(symmetry::findings(file, &table));
    findings.extend(coverage::findings(&table));
    findings.extend(spikes::findings(&table));
    findings.extend(match file {
        PhotometricFile::Ies(ies) => [factors::of_ies(ies), ies_fields::findings(ies)].concat(),
        PhotometricFile::Ldt(ldt) => {
            [factors::of_ldt(ldt), ldt_fields::findings(ldt, web)].concat()
        }
    });
    findings
}
