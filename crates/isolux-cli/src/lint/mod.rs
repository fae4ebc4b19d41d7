//! `isolux lint`: audit of photometric files.

mod audited;
mod converted;
mod ratings;

use crate::console::{print, print_json};
use crate::failure::{Failure, Outcome};
use crate::flags::LintFlags;
use crate::output::OutputPath;
use audited::Audited;
use converted::{Converted, target};
use isolux::photometry::IntensityDistribution;
use isolux_formats::lint::{Audit, lint};
use isolux_formats::photometric_file::{Target, convert};
use isolux_view::PolarDiagram;
use serde::Serialize;

/// Runs the subcommand.
pub(crate) fn run(flags: &LintFlags, json: bool) -> Result<Outcome, Failure> {
    let request = Request::of(flags)?;
    let audits: Vec<Audit> = flags.files.iter().map(|file| lint(file)).collect();
    let mut report = Report { files: Vec::new(), conversion: None };
    for audit in &audits {
        report.files.push(Audited::of(audit, flags.ugr.then_some(flags.spacing_to_height)));
    }
    let mut text = report.text();
    if let [audit] = audits.as_slice() {
        request.draw_polar(audit)?;
        report.conversion = request.convert(audit)?;
    }
    if flags.draw {
        text = audits.iter().zip(&report.files).map(|(a, f)| f.text() + &drawing(a)).collect();
    }
    if let Some(conversion) = &report.conversion {
        text += &conversion.text();
    }
    if json {
        print_json(&report)?
    } else {
        print(&text)?
    }
    let all_usable = audits.iter().all(Audit::is_usable);
    Ok(if all_usable { Outcome::Done } else { Outcome::Unusable })
}

/// What is printed.
#[derive(Serialize)]
struct Report {
    files: Vec<Audited>,
    conversion: Option<Converted>,
}

impl Report {
    fn text(&self) -> String {
        self.files.iter().map(Audited::text).collect()
    }
}

/// What to write, checked before anything is read.
struct Request {
    polar: Option<OutputPath>,
    convert: Option<(OutputPath, Target)>,
}

impl Request {
    fn of(flags: &LintFlags) -> Result<Self, Failure> {
        let one = flags.files.len() == 1;
        for (flag, given) in
            [("--polar", flags.polar.is_some()), ("--convert", flags.convert.is_some())]
        {
            if given && !one {
                let what = format!("{flag} takes one file, not {}", flags.files.len());
                return Err(Failure::bad_input(format!("{what}; give them one by one")));
            }
        }
        let polar = flags.polar.as_deref().map(|p| OutputPath::check(p, "svg")).transpose()?;
        let convert = flags.convert.as_deref().map(target).transpose()?;
        for output in polar.iter().chain(convert.iter().map(|(output, _)| output)) {
            flags.files.iter().try_for_each(|file| output.differs_from(file))?;
        }
        Ok(Self { polar, convert })
    }

    fn draw_polar(&self, audit: &Audit) -> Result<(), Failure> {
        let (Some(output), Some((_, web))) = (&self.polar, &audit.usable) else { return Ok(()) };
        let distribution = IntensityDistribution::Web(web.clone());
        let name = audit.file.file_name().unwrap_or_default().to_string_lossy();
        let facts = audited::in_short(web);
        output.write(PolarDiagram::of(&distribution).svg(&name, &facts).as_bytes())
    }

    fn convert(&self, audit: &Audit) -> Result<Option<Converted>, Failure> {
        let (Some((output, target)), Some((file, web))) = (&self.convert, &audit.usable) else {
            return Ok(None);
        };
        let conversion = convert(file, *target).map_err(crate::source::bad_file)?;
        output.write(conversion.text.as_bytes())?;
        Ok(Some(Converted::of(&conversion, output, web)))
    }
}

/// Characters across of a diagram in the terminal.
const COLUMNS: usize = 64;

/// The polar diagram of a file that can be used.
fn drawing(audit: &Audit) -> String {
    let Some((_, web)) = &audit.usable else { return String::new() };
    let distribution = IntensityDistribution::Web(web.clone());
    format!("\n{}\n", PolarDiagram::of(&distribution).text(COLUMNS))
}
