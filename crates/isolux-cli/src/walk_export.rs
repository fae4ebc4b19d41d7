//! `isolux export` of a walk-through: one file that opens in any browser.

use crate::console::{facts, print, print_json};
use crate::failure::{Failure, Outcome};
use crate::flags::ExportFlags;
use crate::output::OutputPath;
use crate::quantity::show_bytes;
use crate::walk::{self, Opened};
use serde::Serialize;

/// Writes the page with the map in it.
pub(crate) fn run(flags: &ExportFlags, json: bool) -> Result<Outcome, Failure> {
    let output = OutputPath::check(&flags.output, "html")?;
    let mut maps = vec![Opened::read(&flags.map)?];
    if let Some(beside) = &flags.beside {
        maps.push(Opened::read(beside)?);
    }
    let page = walk::file(&maps, flags.finer)?;
    output.write(page.as_bytes())?;
    let report = Report { file: output.path().display().to_string(), bytes: page.len() as u64 };
    if json {
        print_json(&report)?
    } else {
        print(&report.text())?
    }
    Ok(Outcome::Done)
}

#[derive(Serialize)]
struct Report {
    file: String,
    bytes: u64,
}

impl Report {
    fn text(&self) -> String {
        facts(&[("file", self.file.clone()), ("size", show_bytes(self.bytes))])
    }
}
