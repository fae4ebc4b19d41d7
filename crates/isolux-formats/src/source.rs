//! Reading files that others wrote.

use crate::Problem;
use std::fs::File;
use std::io::{ErrorKind, Read};
use std::path::Path;

/// The bytes of a regular file of at most `limit` bytes.
pub(crate) fn read_bytes(path: &Path, limit: u64) -> Result<Vec<u8>, Problem> {
    let refused = |what: String, remedy: &str| Problem::new(path, "", what, remedy);
    let unreadable = |error: std::io::Error| Problem::unreadable(path, &error);
    let about = std::fs::metadata(path).map_err(unreadable)?;
    if !about.is_file() {
        return Err(refused("is not a regular file".into(), "name a file"));
    }
    let file = File::open(path).map_err(unreadable)?;
    let mut bytes = Vec::new();
    // The size asked above may be stale; only what is read counts.
    file.take(limit + 1).read_to_end(&mut bytes).map_err(unreadable)?;
    if bytes.len() as u64 > limit {
        let what = format!("is larger than {} MiB, the most that is read", limit >> 20);
        return Err(refused(what, "split it, or reduce its detail"));
    }
    Ok(bytes)
}

/// Says first of all that there is no file, whatever its name would make of it.
pub(crate) fn check_present(path: &Path) -> Result<(), Problem> {
    match std::fs::metadata(path) {
        Ok(known) if known.is_dir() => {
            Err(Problem::unreadable(path, &ErrorKind::IsADirectory.into()))
        }
        Err(error) if matches!(error.kind(), ErrorKind::NotFound | ErrorKind::NotADirectory) => {
            Err(Problem::unreadable(path, &error))
        }
        _ => Ok(()),
    }
}

/// Whether bytes begin as text in UTF-16.
pub(crate) fn is_utf16(bytes: &[u8]) -> bool {
    units_of(bytes).is_some()
}

/// A unit of UTF-16 from its bytes.
type Unit = fn([u8; 2]) -> u16;

/// How the units of UTF-16 are read, and where they begin: after the mark, or at the first of two characters of ASCII.
fn units_of(bytes: &[u8]) -> Option<(Unit, usize)> {
    let is_text =
        |a: u8, b: u8| [a, b].iter().all(|c| matches!(c, b'\t' | b'\n' | b'\r' | b' '..=b'~'));
    match *bytes {
        [0xff, 0xfe, ..] => Some((u16::from_le_bytes, 2)),
        [0xfe, 0xff, ..] => Some((u16::from_be_bytes, 2)),
        [a, 0, b, 0, ..] if is_text(a, b) => Some((u16::from_le_bytes, 0)),
        [0, a, 0, b, ..] if is_text(a, b) => Some((u16::from_be_bytes, 0)),
        _ => None,
    }
}

/// Bytes of text without the mark that Windows editors put before UTF-8.
pub(crate) fn without_mark(bytes: &[u8]) -> &[u8] {
    bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes)
}

/// The text of a file, as [`decoded`] says.
pub(crate) fn read_text(path: &Path, limit: u64) -> Result<String, Problem> {
    Ok(decoded(read_bytes(path, limit)?))
}

/// The text of bytes in UTF-8 or, by their mark, UTF-16, with lines that end in a line feed; what is neither becomes replacement
/// characters.
pub(crate) fn decoded(bytes: Vec<u8>) -> String {
    let text = from_utf16(&bytes).unwrap_or_else(|| {
        String::from_utf8(bytes)
            .unwrap_or_else(|error| String::from_utf8_lossy(error.as_bytes()).into_owned())
    });
    let text = text.strip_prefix('\u{feff}').map(str::to_owned).unwrap_or(text);
    // Programs of the first Macintosh ended lines in a carriage return alone.
    if text.contains('\r') && !text.contains('\n') { text.replace('\r', "\n") } else { text }
}

/// The text of bytes in UTF-16, without its mark.
pub(crate) fn from_utf16(bytes: &[u8]) -> Option<String> {
    let (unit, mark) = units_of(bytes)?;
    let (pairs, _) = bytes[mark..].as_chunks();
    let units = pairs.iter().map(|&pair| unit(pair));
    Some(char::decode_utf16(units).map(|c| c.unwrap_or(char::REPLACEMENT_CHARACTER)).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_of_every_encoding() {
        let text = "v 1 ü\nf 𝄞\n";
        for (mark, to_bytes) in [
            (&b"\xff\xfe"[..], u16::to_le_bytes as fn(u16) -> [u8; 2]),
            (b"\xfe\xff", u16::to_be_bytes),
            (b"", u16::to_le_bytes),
            (b"", u16::to_be_bytes),
        ] {
            let units: Vec<[u8; 2]> = text.encode_utf16().map(to_bytes).collect();
            assert_eq!(decoded([mark, units.as_flattened()].concat()), text);
        }
        assert_eq!(decoded(format!("\u{feff}{text}").into_bytes()), text);
        assert_eq!(decoded(b"a\rb\r".to_vec()), "a\nb\n");
        assert_eq!(decoded(b"a\r\nb\rc".to_vec()), "a\r\nb\rc");
        assert_eq!(decoded(b"\xff\xfe\0\xd8a".to_vec()), "\u{fffd}");
    }

    #[test]
    fn size_and_kind_are_bounded() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("a");
        std::fs::write(&path, [0; 17]).unwrap();
        assert_eq!(read_bytes(&path, 17).unwrap().len(), 17);
        assert!(read_bytes(&path, 16).unwrap_err().what.contains("larger"));
        assert!(read_bytes(dir.path(), 16).unwrap_err().what.contains("regular"));
        let missing = read_bytes(&dir.path().join("b"), 16).unwrap_err().to_string();
        assert!(missing.ends_with("b: does not exist; check the name and its case"));
        assert!(check_present(&path).is_ok());
        let none = "does not exist";
        for (name, what) in [("b", none), ("a/b", none), ("", "is a directory")] {
            assert_eq!(check_present(&dir.path().join(name)).unwrap_err().what, what, "{name}");
        }
    }
}
