//! Binary STL: 80 bytes of anything, the number of triangles, and 50 bytes for each, little-endian.

use super::record::Solid;
use crate::findings::Findings;
use crate::source::{is_utf16, without_mark};

const HEADER: usize = 80;
const START: usize = HEADER + 4;
const TRIANGLE: usize = 50;

/// Whether a file is binary. Both kinds may begin with `solid`; a binary one is as long as its count
/// says, or holds a zero byte, which text does not.
pub(super) fn is_binary(bytes: &[u8]) -> bool {
    let is_as_long_as_told =
        count(bytes).is_some_and(|n| (bytes.len() - START) as u64 == n * TRIANGLE as u64);
    if is_utf16(bytes) && !is_as_long_as_told {
        return false;
    }
    let text = without_mark(bytes).trim_ascii_start();
    let begins_as_text = text.get(..5).is_some_and(|word| word.eq_ignore_ascii_case(b"solid"));
    is_as_long_as_told || !begins_as_text || bytes.contains(&0)
}

fn count(bytes: &[u8]) -> Option<u64> {
    let count = bytes.get(HEADER..START)?.try_into().ok()?;
    Some(u64::from(u32::from_le_bytes(count)))
}

/// Bytes that are looked at to tell text from other things.
const BEGINNING: usize = 1024;

/// Whether bytes are words of another kind of file.
fn is_other_text(bytes: &[u8]) -> bool {
    let beginning = &bytes[..bytes.len().min(BEGINNING)];
    !beginning.is_empty() && beginning.iter().all(|b| matches!(b, b'\t'..=b'\r' | b' '..=b'~'))
}

pub(super) fn parse(bytes: &[u8], findings: &mut Findings) -> Vec<Solid> {
    if is_other_text(bytes) {
        let what = "is text that does not begin with `solid`: it is no STL";
        findings.problem("line 1", what, "check its name, or export the geometry as STL");
        return Vec::new();
    }
    let Some(told) = count(bytes) else {
        let what = format!("{} bytes are neither text nor binary STL", bytes.len());
        findings.problem("", what, "export the geometry again");
        return Vec::new();
    };
    let body = &bytes[START..];
    let whole = (body.len() / TRIANGLE) as u64;
    if told > whole {
        let what =
            format!("says it has {told} triangles and holds {whole}: it is cut off, or no STL");
        findings.problem("byte 80", what, "copy or export it again");
        return Vec::new();
    }
    let rest = body.len() as u64 - told * TRIANGLE as u64;
    if rest > 0 {
        let what =
            format!("{rest} bytes follow the {told} triangles it says it has, and are not read");
        findings.warning("byte 80", what, "export the geometry again if triangles are missing");
    }
    let mut solid = Solid::default();
    for (number, record) in body.chunks_exact(TRIANGLE).take(told as usize).enumerate() {
        let [normal, a, b, c] = vectors(record);
        let corners = [a, b, c];
        if corners.iter().flatten().all(|x| x.is_finite()) {
            solid.add(normal, corners);
        } else {
            let place = format!("triangle {}", number + 1);
            let what = "a coordinate that is not a finite number";
            findings.problem(place, what, "export the geometry again");
        }
    }
    vec![solid]
}

/// Normal and corners; what may follow, two bytes of colour in some dialects, is not read.
fn vectors(record: &[u8]) -> [[f64; 3]; 4] {
    let number = |k: usize| {
        let bytes = std::array::from_fn(|byte| record[4 * k + byte]);
        f64::from(f32::from_le_bytes(bytes))
    };
    std::array::from_fn(|vector| std::array::from_fn(|axis| number(3 * vector + axis)))
}
