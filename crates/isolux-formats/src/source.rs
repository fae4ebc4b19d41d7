//! Reading files that others wrote, and files that such files name.

use crate::Problem;
use std::fs::File;
use std::io::{ErrorKind, Read};
use std::path::{Component, Path, PathBuf};

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

/// Whether bytes begin as Windows begins text in UTF-16.
pub(crate) fn is_utf16(bytes: &[u8]) -> bool {
    bytes.starts_with(b"\xff\xfe") || bytes.starts_with(b"\xfe\xff")
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

/// The text of bytes that begin with the mark of UTF-16, without it.
pub(crate) fn from_utf16(bytes: &[u8]) -> Option<String> {
    let unit: fn([u8; 2]) -> u16 = match bytes {
        [0xff, 0xfe, ..] => u16::from_le_bytes,
        [0xfe, 0xff, ..] => u16::from_be_bytes,
        _ => return None,
    };
    let (pairs, _) = bytes[2..].as_chunks();
    let units = pairs.iter().map(|&pair| unit(pair));
    Some(char::decode_utf16(units).map(|c| c.unwrap_or(char::REPLACEMENT_CHARACTER)).collect())
}

/// The directory of a file.
pub(crate) fn directory_of(path: &Path) -> &Path {
    match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    }
}

/// Why a file named in another file is not opened.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Unreachable {
    /// It would lie outside the directory tree of the file that names it.
    Outside,
    /// There is no such file.
    Missing,
    /// It is a directory.
    Directory,
}

impl Unreachable {
    /// What is wrong, and how to mend it.
    pub(crate) fn explain(self, name: &str) -> (String, &'static str) {
        match self {
            Self::Outside => (
                format!("file `{name}` lies outside the directory of the file that names it"),
                "put it into that directory or below, and name it relative to it",
            ),
            Self::Missing => {
                (format!("file `{name}` does not exist"), "check the name and its case")
            }
            Self::Directory => (format!("`{name}` is a directory"), "name a file in it"),
        }
    }
}

/// The path of a file named relative to `base`, which may not leave the tree below `root`, neither
/// by `..` nor by a symbolic link. Both separators are understood.
pub(crate) fn within(root: &Path, base: &Path, name: &str) -> Result<PathBuf, Unreachable> {
    let name = name.replace('\\', "/");
    let relative = Path::new(&name);
    let has_drive = name.as_bytes().get(1) == Some(&b':');
    let stays =
        |c: Component| matches!(c, Component::Normal(_) | Component::CurDir | Component::ParentDir);
    if has_drive || !relative.components().all(stays) {
        return Err(Unreachable::Outside);
    }
    let path = base.join(relative);
    let real = path.canonicalize().map_err(|_| Unreachable::Missing)?;
    let real_root = root.canonicalize().map_err(|_| Unreachable::Missing)?;
    if !real.starts_with(real_root) {
        return Err(Unreachable::Outside);
    }
    if real.is_dir() { Err(Unreachable::Directory) } else { Ok(path) }
}

/// A file whose name differs from a missing one in the case of its letters, as it may on a disk of Windows.
pub(crate) fn in_other_case(root: &Path, base: &Path, name: &str) -> Option<PathBuf> {
    let name = name.replace('\\', "/");
    let relative = Path::new(&name);
    let wanted = relative.file_name()?.to_str()?;
    let folder = relative.parent().filter(|folder| !folder.as_os_str().is_empty());
    let beside = std::fs::read_dir(base.join(folder.unwrap_or(Path::new(".")))).ok()?;
    let names = beside.filter_map(|entry| entry.ok()?.file_name().into_string().ok());
    let mut alike: Vec<String> = names.filter(|own| own.eq_ignore_ascii_case(wanted)).collect();
    alike.sort_unstable();
    let found = relative.with_file_name(alike.first()?);
    within(root, base, found.to_str()?).ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn named_files_stay_in_the_tree() {
        let outer = tempfile::tempdir().unwrap();
        let root = outer.path().join("scene");
        std::fs::create_dir_all(root.join("sub")).unwrap();
        std::fs::write(root.join("sub/a.txt"), "a").unwrap();
        std::fs::write(outer.path().join("secret.txt"), "s").unwrap();
        let reach = |name: &str| within(&root, &root, name);
        assert!(reach("sub/a.txt").is_ok());
        assert!(reach("sub\\a.txt").is_ok());
        assert!(reach("sub/../sub/a.txt").is_ok());
        assert_eq!(reach("../secret.txt"), Err(Unreachable::Outside));
        assert_eq!(reach("/etc/hostname"), Err(Unreachable::Outside));
        assert_eq!(reach("C:\\a.txt"), Err(Unreachable::Outside));
        assert_eq!(reach("sub/b.txt"), Err(Unreachable::Missing));
        assert_eq!(reach("sub"), Err(Unreachable::Directory));
        let other = |name: &str| in_other_case(&root, &root, name);
        assert_eq!(other("sub\\A.TXT"), Some(root.join("sub/a.txt")));
        assert_eq!(other("../SECRET.txt"), None);
        assert_eq!(within(&root, &root.join("sub"), "../../secret.txt"), Err(Unreachable::Outside));
        #[cfg(unix)]
        {
            std::os::unix::fs::symlink(outer.path().join("secret.txt"), root.join("l")).unwrap();
            assert_eq!(reach("l"), Err(Unreachable::Outside));
        }
    }

    #[test]
    fn text_of_every_encoding() {
        let text = "v 1 ü\nf 𝄞\n";
        for (mark, to_bytes) in [
            (&b"\xff\xfe"[..], u16::to_le_bytes as fn(u16) -> [u8; 2]),
            (b"\xfe\xff", u16::to_be_bytes),
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
