//! How a file is spelt.

use super::finding::Finding;
use crate::photometric_file::PhotometricFile;
use crate::plain_text::Line;

/// Longest line of LM-63 since 1995, characters, and of a name in EULUMDAT.
const LONGEST_IES: usize = 256;
const LONGEST_LDT: usize = 78;

pub(super) fn findings(lines: &[Line], bytes: &[u8], file: &PhotometricFile) -> Vec<Finding> {
    let mut found = Vec::new();
    let longest = match file {
        PhotometricFile::Ies(_) => LONGEST_IES,
        PhotometricFile::Ldt(_) => LONGEST_LDT,
    };
    if let Some(line) = lines.iter().find(|line| line.text.chars().count() > longest) {
        let count = line.text.chars().count();
        let what = format!("a line of {count} characters; the format allows {longest}");
        found.push(Finding::note(line.number, what, "break or shorten it"));
    }
    if let Some(line) = lines.iter().find(|line| !line.text.is_ascii()) {
        let encoding = if std::str::from_utf8(bytes).is_ok() { "UTF-8" } else { "Windows-1252" };
        let what = format!("letters beyond ASCII, read as {encoding}");
        found.push(Finding::note(line.number, what, "nothing, if they look right"));
    }
    if let (PhotometricFile::Ldt(_), Some(line)) = (file, lines.iter().find(|l| is_comma(l.text))) {
        let what = format!("a decimal comma: {}", line.text.trim());
        found.push(Finding::note(line.number, what, "write points; some programs stop at a comma"));
    }
    found
}

/// Whether a line is one number with a decimal comma.
fn is_comma(text: &str) -> bool {
    let text = text.trim().trim_start_matches(['+', '-']);
    let Some((whole, decimals)) = text.split_once(',') else { return false };
    let digits = |part: &str| !part.is_empty() && part.bytes().all(|b| b.is_ascii_digit());
    digits(whole) && digits(decimals)
}
