//! Fields that LM-63 does not know, or misses.

use super::finding::Finding;
use crate::counted;
use crate::ies::{Edition, IesFile, LampFactor};

/// Keywords that every file must have since 1991, and since 2002, and since 2019.
const NEEDED_1991: [&str; 2] = ["TEST", "MANUFAC"];
const NEEDED_2002: [&str; 4] = ["TEST", "TESTLAB", "ISSUEDATE", "MANUFAC"];
const NEEDED_2019: [&str; 6] = ["TEST", "TESTLAB", "ISSUEDATE", "MANUFAC", "LUMCAT", "LUMINAIRE"];

/// All keywords of any edition.
const KNOWN: [&str; 35] = [
    "TEST",
    "TESTLAB",
    "TESTDATE",
    "TESTMETHOD",
    "ISSUEDATE",
    "MANUFAC",
    "LUMCAT",
    "LUMINAIRE",
    "LAMPCAT",
    "LAMP",
    "BALLAST",
    "BALLASTCAT",
    "MAINTCAT",
    "DISTRIBUTION",
    "FLASHAREA",
    "COLORCONSTANT",
    "LAMPPOSITION",
    "NEARFIELD",
    "FILEGENINFO",
    "OTHER",
    "SEARCH",
    "MORE",
    "BLOCK",
    "ENDBLOCK",
    "DATE",
    "LUMDIFF",
    "LAMPTYPE",
    "COLORTEMP",
    "CRI",
    "REPORT",
    "REPORTNO",
    "LAMPCOLOR",
    "ABSOLUTE",
    "PRODUCTID",
    "ABSTRACT",
];

/// Units that some files of ultraviolet sources put into the place of candela.
const RADIOMETRIC: [&str; 3] = ["_INTENSITYUNITS", "INTENSITYUNITS", "_RADIATIONTYPE"];

pub(super) fn findings(file: &IesFile) -> Vec<Finding> {
    let mut found = Vec::new();
    found.extend(missing_keywords(file));
    found.extend(unknown_keywords(file));
    found.extend(labels(file));
    found.extend(generation_type(file));
    found.extend(no_candela(file));
    if file.input_watts < 0.0 {
        let what = format!("the input power is {} W", file.input_watts);
        found.push(Finding::warning(file.lines.lamps, what, "write 0 if it is not known"));
    }
    if file.lamps == 0 {
        let remedy = "write 1; for absolute photometry 1 lamp of -1 lumens";
        found.push(Finding::note(file.lines.lamps, "the number of lamps is 0", remedy));
    }
    found
}

fn missing_keywords(file: &IesFile) -> Option<Finding> {
    let needed: &[&str] = match file.edition {
        Edition::E1986 => &[],
        Edition::E1991 | Edition::E1995 => &NEEDED_1991,
        Edition::E2002 => &NEEDED_2002,
        Edition::E2019 => &NEEDED_2019,
    };
    let missing: Vec<&str> =
        needed.iter().copied().filter(|name| file.keyword(name).is_none()).collect();
    (!missing.is_empty()).then(|| {
        let what = format!("required keywords are missing: {}", missing.join(", "));
        Finding::note(1, what, "add them; nothing is computed from them")
    })
}

/// Keywords of one's own begin with an underscore.
fn unknown_keywords(file: &IesFile) -> Option<Finding> {
    if file.edition < Edition::E1991 {
        return None;
    }
    let is_known = |name: &str| {
        name.starts_with('_') || KNOWN.iter().any(|known| known.eq_ignore_ascii_case(name))
    };
    let unknown: Vec<_> = file.keywords.iter().filter(|k| !is_known(&k.name)).collect();
    let first = unknown.first()?;
    let names: Vec<&str> = unknown.iter().map(|k| k.name.as_str()).take(10).collect();
    let what = format!("keywords outside the standard: {}", names.join(", "));
    Some(Finding::note(first.line, what, "begin keywords of your own with an underscore"))
}

fn labels(file: &IesFile) -> Option<Finding> {
    (file.edition > Edition::E1986 && !file.labels.is_empty()).then(|| {
        let what = counted(
            file.labels.len(),
            "line before TILT= is no keyword",
            "lines before TILT= are no keywords",
        );
        Finding::note(0, what, "write [OTHER] before each, or [MORE] to continue a line")
    })
}

fn generation_type(file: &IesFile) -> Option<Finding> {
    let LampFactor::GenerationType(code) = file.lamp_factor else { return None };
    // A 1 and five decimals, each a flag (LM-63-19, table 2).
    let text = format!("{code:.5}");
    let flags = text.strip_prefix("1.").unwrap_or_default();
    // Any further decimal is no flag.
    let is_whole = (code * 1e5 - (code * 1e5).round()).abs() < 1e-4;
    let is_known = is_whole && flags.len() == 5 && flags.bytes().all(|b| b"01".contains(&b));
    (!is_known).then(|| {
        let what = format!("the file generation type {code} is none of the standard's");
        Finding::note(file.lines.lamps, what, "write 1.00001 if it is not known")
    })
}

fn no_candela(file: &IesFile) -> Option<Finding> {
    let is_radiometric = |name: &str| RADIOMETRIC.iter().any(|r| r.eq_ignore_ascii_case(name));
    let keyword = file.keywords.iter().find(|k| is_radiometric(&k.name))?;
    Some(Finding::warning(
        keyword.line,
        format!("[{}] {}: intensities are not candela", keyword.name, keyword.value),
        "do not use it as light: what is computed is in the unit of the file",
    ))
}
