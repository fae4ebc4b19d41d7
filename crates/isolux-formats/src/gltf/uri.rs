//! References to data: inside the JSON, or in a file beside it (glTF 2.0, section 2.8).

use super::notes::Flaw;
use crate::Problem;
use crate::reach::{ALLOW, Reach, Root};
use std::fs::File;
use std::io::Read;
use std::path::{Component, Path, PathBuf};

/// The directory of the file being read; nothing outside of it is opened unless that is allowed.
pub(super) struct Folder(Root);

impl Folder {
    pub(super) fn of(file: &Path, reach: Reach) -> Self {
        Self(Root::of(file, reach))
    }

    /// The bytes a URI stands for, at most `limit` of them.
    pub(super) fn fetch(&self, uri: &str, limit: u64) -> Result<Vec<u8>, Flaw> {
        if scheme(uri).is_some_and(|s| s.eq_ignore_ascii_case("data")) {
            return decode_data(uri);
        }
        read_file(&self.confine(uri)?, limit)
    }

    /// The path of a file that a URI names, inside the directory even after links are followed, unless more is allowed.
    pub(super) fn confine(&self, uri: &str) -> Result<PathBuf, Flaw> {
        let path = self.0.folder().join(named_path(uri, self.0.reach())?);
        let real = path.canonicalize().map_err(|error| unreadable(&path, &error))?;
        self.0.check(&real).map_err(|_| outside(uri))?;
        Ok(path)
    }
}

/// A regular file whole, if it is not longer than the limit.
pub(super) fn read_file(path: &Path, limit: u64) -> Result<Vec<u8>, Flaw> {
    let failed = |error: std::io::Error| unreadable(path, &error);
    let meta = path.metadata().map_err(failed)?;
    if !meta.is_file() {
        let what = format!("{} is not a regular file", path.display());
        return Err(Flaw::new(what, "name a file"));
    }
    let mut bytes = Vec::new();
    File::open(path).and_then(|f| f.take(limit + 1).read_to_end(&mut bytes)).map_err(failed)?;
    if bytes.len() as u64 > limit {
        let what = format!("{} has more than {limit} bytes", path.display());
        return Err(Flaw::new(what, "split it"));
    }
    Ok(bytes)
}

fn unreadable(path: &Path, error: &std::io::Error) -> Flaw {
    let Problem { what, remedy, .. } = Problem::unreadable(path, error);
    Flaw::new(format!("file `{}` {what}", path.display()), remedy)
}

fn outside(uri: &str) -> Flaw {
    let what = format!("the URI `{}` leaves the directory of the file", shown(uri));
    Flaw::new(
        what,
        format!("put the data beside the scene and name it by a relative path; or {ALLOW}"),
    )
}

/// The scheme of an absolute URI (RFC 3986, section 3.1).
fn scheme(uri: &str) -> Option<&str> {
    let (scheme, _) = uri.split_once(':')?;
    let plain = |c: char| c.is_ascii_alphanumeric() || matches!(c, '+' | '-' | '.');
    (scheme.starts_with(|c: char| c.is_ascii_alphabetic()) && scheme.chars().all(plain))
        .then_some(scheme)
}

/// The path that a URI names, relative to the file; any path of this machine where that is allowed.
fn named_path(uri: &str, reach: Reach) -> Result<PathBuf, Flaw> {
    if let Some(scheme) = scheme(uri) {
        let what = format!("the URI `{}` is of the kind `{scheme}:`", shown(uri));
        return Err(Flaw::new(what, "only data: URIs and files beside the scene are read"));
    }
    let text = String::from_utf8(percent_decode(uri)?).map_err(|_| {
        let what = format!("the URI `{}` is not UTF-8 when decoded", shown(uri));
        Flaw::new(what, "rename the file and export again")
    })?;
    // A backslash and a drive letter are paths of their own on some systems.
    let path = Path::new(&text);
    let plain = |c: Component| matches!(c, Component::Normal(_) | Component::CurDir);
    let stays = reach == Reach::Anywhere || path.components().all(plain);
    // Two slashes begin the name of another machine.
    if text.is_empty() || text.contains(['\\', '\0', ':']) || text.starts_with("//") || !stays {
        return Err(outside(uri));
    }
    Ok(path.to_owned())
}

fn percent_decode(uri: &str) -> Result<Vec<u8>, Flaw> {
    let mut rest = uri.as_bytes();
    let mut out = Vec::with_capacity(rest.len());
    while let [first, tail @ ..] = rest {
        rest = tail;
        if *first != b'%' {
            out.push(*first);
            continue;
        }
        let byte = tail
            .first_chunk::<2>()
            .and_then(|&[high, low]| Some(hex_digit(high)? << 4 | hex_digit(low)?));
        out.push(byte.ok_or_else(|| {
            let what = format!("the URI `{}` has a `%` without two hexadecimal digits", shown(uri));
            Flaw::new(what, "write `%` itself as `%25`")
        })?);
        rest = &tail[2..];
    }
    Ok(out)
}

fn hex_digit(digit: u8) -> Option<u8> {
    char::from(digit).to_digit(16).map(|value| value as u8)
}

fn decode_data(uri: &str) -> Result<Vec<u8>, Flaw> {
    let wrong = |what: &str| {
        Flaw::new(
            format!("the data URI {what}"),
            "embed base64 data or use a file beside the scene",
        )
    };
    let (head, body) = uri.split_once(',').ok_or_else(|| wrong("has no comma"))?;
    if !head.ends_with(";base64") {
        return percent_decode(body);
    }
    decode_base64(body).ok_or_else(|| wrong("is not valid base64"))
}

/// RFC 4648, section 4; padding may be missing.
fn decode_base64(text: &str) -> Option<Vec<u8>> {
    let digits = text.trim_end_matches('=').as_bytes();
    if text.len() - digits.len() > 2 || digits.len() % 4 == 1 {
        return None;
    }
    let mut out = Vec::with_capacity(digits.len() / 4 * 3 + 2);
    for group in digits.chunks(4) {
        let mut bits = 0_u32;
        for &digit in group {
            bits = bits << 6 | base64_digit(digit)?;
        }
        bits <<= 6 * (4 - group.len());
        out.extend_from_slice(&bits.to_be_bytes()[1..group.len()]);
    }
    Some(out)
}

fn base64_digit(digit: u8) -> Option<u32> {
    let value = match digit {
        b'A'..=b'Z' => digit - b'A',
        b'a'..=b'z' => digit - b'a' + 26,
        b'0'..=b'9' => digit - b'0' + 52,
        b'+' => 62,
        b'/' => 63,
        _ => return None,
    };
    Some(u32::from(value))
}

/// A URI short enough for a message.
pub(super) fn shown(uri: &str) -> String {
    const LENGTH: usize = 80;
    if uri.chars().count() <= LENGTH {
        return uri.to_owned();
    }
    uri.chars().take(LENGTH).chain("...".chars()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn base64_of_rfc_4648_section_10() {
        let table = [
            ("", ""),
            ("f", "Zg=="),
            ("fo", "Zm8="),
            ("foo", "Zm9v"),
            ("foob", "Zm9vYg=="),
            ("fooba", "Zm9vYmE="),
            ("foobar", "Zm9vYmFy"),
        ];
        for (plain, coded) in table {
            assert_eq!(decode_base64(coded).as_deref(), Some(plain.as_bytes()));
            assert_eq!(
                decode_base64(coded.trim_end_matches('=')).as_deref(),
                Some(plain.as_bytes())
            );
        }
        for bad in ["Z", "Zg===", "Z*==", "Zm9vY", "Zg==Zg=="] {
            assert_eq!(decode_base64(bad), None, "{bad}");
        }
    }

    #[test]
    fn paths_stay_below() {
        for good in ["a.bin", "sub/a.bin", "./a.bin", "a%20b.bin", "%C3%A9.bin", "100%25.bin"] {
            assert!(named_path(good, Reach::Inside).is_ok(), "{good}");
        }
        for bad in [
            "",
            "../a.bin",
            "sub/../../a.bin",
            "%2e%2e/a.bin",
            "%2E%2E%2Fa.bin",
            "/etc/passwd",
            "%2Fetc/passwd",
            "file:///etc/passwd",
            "http://example.org/a",
            "C:/a.bin",
            "C%3A/a",
            "..%5Ca.bin",
            "a%00b",
            "%ff%fe",
            "%",
            "%4",
            "%zz",
        ] {
            assert!(named_path(bad, Reach::Inside).is_err(), "{bad}");
        }
        for allowed in ["../a.bin", "/etc/a.bin", "%2e%2e/a.bin"] {
            assert!(named_path(allowed, Reach::Anywhere).is_ok(), "{allowed}");
        }
        for bad in
            ["", "file:///a", "http://example.org/a", "C:/a.bin", "//machine/a", "%2F/machine/a"]
        {
            assert!(named_path(bad, Reach::Anywhere).is_err(), "{bad}");
        }
    }
}
