//! Checkpoints as files.

use super::Checkpoint;
use super::draft::{Draft, DraftArray};
use crate::{Problem, atomic};
use blake3::Hasher;
use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::collections::HashSet;
use std::fs::{self, File};
use std::io::{self, BufWriter, IntoInnerError, Read, Write};
use std::mem;
use std::ops::Range;
use std::path::Path;

const MAGIC: &[u8; 8] = b"ISOLUXCK";
const VERSION: u32 = 2;
const PREFIX_BYTES: usize = 16;
const HASH_BYTES: usize = blake3::OUT_LEN;
/// What is hashed and written at once.
const BUFFER_BYTES: usize = 1 << 16;
const NO_CHECKPOINT: &str = "it is not a checkpoint, a pilot or a part of a run of isolux";
const START_ANEW: &str = "remove it, and compute anew what it was of";

#[derive(Serialize, Deserialize)]
struct Contents<H> {
    header: H,
    arrays: Vec<Entry>,
}

#[derive(Serialize, Deserialize)]
struct Entry {
    name: String,
    bytes: usize,
}

/// Writes a checkpoint in place of an older one: at any moment one of the two is there, whole.
pub fn write(path: &Path, draft: &Draft<'_>) -> Result<(), Problem> {
    let head = head(draft).map_err(|what| Problem::new(path, "header", what, "keep less in it"))?;
    atomic::write_with(path, &|to| write_to(draft, &head, to))
}

/// The bytes of a checkpoint as a file. The error is a header of more than 4 GiB.
pub fn to_bytes(draft: &Draft<'_>) -> Result<Vec<u8>, String> {
    let head = head(draft)?;
    let arrays: usize = draft.arrays.iter().map(|array| array.bytes).sum();
    let mut bytes = Vec::with_capacity(head.len() + arrays + HASH_BYTES);
    write_to(draft, &head, &mut bytes).map_err(|error| error.to_string())?;
    Ok(bytes)
}

/// What stands in front of the arrays.
fn head(draft: &Draft<'_>) -> Result<Vec<u8>, String> {
    let entry = |array: &DraftArray<'_>| Entry { name: array.name.clone(), bytes: array.bytes };
    let contents =
        Contents { header: &draft.header, arrays: draft.arrays.iter().map(entry).collect() };
    let json = serde_json::to_vec(&contents).expect("JSON of JSON with names for keys");
    let Ok(json_length) = u32::try_from(json.len()) else {
        return Err(format!("the header takes {} bytes, more than 4 GiB", json.len()));
    };
    Ok([&MAGIC[..], &VERSION.to_le_bytes(), &json_length.to_le_bytes(), &json].concat())
}

fn write_to(draft: &Draft<'_>, head: &[u8], to: &mut dyn Write) -> io::Result<()> {
    let mut file = BufWriter::with_capacity(BUFFER_BYTES, Hashed { hasher: Hasher::new(), to });
    file.write_all(head)?;
    draft.arrays.iter().try_for_each(|array| (array.write)(&mut file))?;
    let Hashed { hasher, to } = file.into_inner().map_err(IntoInnerError::into_error)?;
    to.write_all(hasher.finalize().as_bytes())
}

/// A file that knows the hash of what was written to it.
struct Hashed<'a> {
    hasher: Hasher,
    to: &'a mut dyn Write,
}

impl Write for Hashed<'_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let written = self.to.write(bytes)?;
        self.hasher.update(&bytes[..written]);
        Ok(written)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.to.flush()
    }
}

/// Whether a file is a checkpoint, by how it begins.
pub fn is_checkpoint(path: &Path) -> bool {
    let mut magic = [0; MAGIC.len()];
    let is_file = fs::metadata(path).is_ok_and(|known| known.is_file());
    is_file
        && File::open(path).and_then(|mut file| file.read_exact(&mut magic)).is_ok()
        && &magic == MAGIC
}

/// Reads a checkpoint of any origin that is no longer than `max_bytes`.
pub fn read(path: &Path, max_bytes: u64) -> Result<Checkpoint, Problem> {
    let bytes = whole(path, max_bytes)?;
    if !bytes.starts_with(MAGIC) {
        return Err(Problem::new(path, "", NO_CHECKPOINT, "give another file"));
    }
    from_bytes(bytes).map_err(|what| Problem::new(path, "", what, START_ANEW))
}

fn whole(path: &Path, max_bytes: u64) -> Result<Vec<u8>, Problem> {
    let unreadable = |error: std::io::Error| Problem::unreadable(path, &error);
    let known = fs::metadata(path).map_err(unreadable)?;
    if !known.is_file() {
        return Err(Problem::new(path, "", "is not a regular file", START_ANEW));
    }
    if known.len() > max_bytes {
        let what = format!("takes {} bytes, more than the {max_bytes} allowed", known.len());
        return Err(Problem::new(path, "", what, "allow more memory"));
    }
    let mut bytes = Vec::with_capacity(known.len() as usize);
    let file = File::open(path).map_err(unreadable)?;
    file.take(known.len()).read_to_end(&mut bytes).map_err(unreadable)?;
    Ok(bytes)
}

/// The checkpoint in bytes of any origin. The error says what is wrong with them.
pub fn from_bytes(bytes: impl Into<Vec<u8>>) -> Result<Checkpoint, String> {
    const CUT: &str = "the checkpoint is cut short";
    let bytes = bytes.into();
    if !bytes.starts_with(MAGIC) {
        return Err(NO_CHECKPOINT.into());
    }
    let length = bytes.len().checked_sub(HASH_BYTES).ok_or(CUT)?;
    let (content, hash) = bytes.split_at(length);
    let (prefix, rest) = content.split_at_checked(PREFIX_BYTES).ok_or(CUT)?;
    let word = |at: usize| {
        u32::from_le_bytes([prefix[at], prefix[at + 1], prefix[at + 2], prefix[at + 3]])
    };
    if word(8) != VERSION {
        return Err(format!("it has format {}; this version reads format {VERSION}", word(8)));
    }
    if blake3::hash(content).as_bytes() != hash {
        return Err("its contents do not match their checksum: it is damaged or cut short".into());
    }
    let (json, _) = rest.split_at_checked(word(12) as usize).ok_or(CUT)?;
    let Contents { header, arrays }: Contents<Value> =
        serde_json::from_slice(json).map_err(|error| format!("its header is broken: {error}"))?;
    let arrays = places(PREFIX_BYTES + json.len()..length, arrays)?;
    Ok(Checkpoint { header, bytes, arrays })
}

/// The places of the arrays, which must fill their part of the file to the last byte.
fn places(part: Range<usize>, entries: Vec<Entry>) -> Result<Vec<(String, Range<usize>)>, String> {
    let mut start = part.start;
    let mut names = HashSet::new();
    let mut place = |Entry { name, bytes }: Entry| {
        let end = start.checked_add(bytes).filter(|&end| end <= part.end);
        let end = end.ok_or_else(|| format!("array `{name}` reaches beyond the end"))?;
        if !names.insert(name.clone()) {
            return Err(format!("array `{name}` is there twice"));
        }
        Ok((name, mem::replace(&mut start, end)..end))
    };
    let places = entries.into_iter().map(&mut place).collect::<Result<_, String>>()?;
    if start == part.end { Ok(places) } else { Err("bytes are left over behind the arrays".into()) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::checkpoint::ArrayError;
    use serde_json::json;

    const ENOUGH: u64 = 1 << 20;

    fn example() -> Draft<'static> {
        let mut draft = Draft::new(json!({"scene_hash": "ab", "seed": u64::MAX}));
        draft.push("counters", [[1_u64], [2], [u64::MAX]].into_iter());
        draft.push("sums", [[i128::MIN, -1], [0, i128::MAX]].into_iter());
        draft.push("nothing", [[0_i64; 3]; 0].into_iter());
        draft
    }

    fn packed(draft: &Draft<'_>) -> Vec<u8> {
        let directory = tempfile::tempdir().unwrap();
        let path = directory.path().join("run.ckpt");
        write(&path, draft).unwrap();
        let bytes = fs::read(&path).unwrap();
        assert_eq!(bytes, to_bytes(draft).unwrap());
        assert_eq!(read(&path, ENOUGH).unwrap().header, draft.header);
        bytes
    }

    /// With the checksum it should have.
    fn sealed(mut content: Vec<u8>) -> Vec<u8> {
        let hash = blake3::hash(&content);
        content.extend(hash.as_bytes());
        content
    }

    #[test]
    fn integers_come_back() {
        packed(&Draft::new(json!(null)));
        let found = from_bytes(packed(&example())).unwrap();
        let counters: Vec<[u64; 3]> = found.rows("counters").unwrap().collect();
        assert_eq!(counters, [[1, 2, u64::MAX]]);
        let sums: Vec<[i128; 1]> = found.rows("sums").unwrap().collect();
        assert_eq!(sums, [[i128::MIN], [-1], [0], [i128::MAX]]);
        assert_eq!(found.rows::<i64, 2>("nothing").unwrap().count(), 0);
        let error = |name: &str| found.rows::<i128, 1>(name).map(drop).unwrap_err();
        assert_eq!(error("none"), ArrayError::Missing("none".into()));
        let size = ArrayError::Size { name: "counters".into(), bytes: 24, size: 16 };
        assert_eq!(error("counters"), size);
    }

    #[test]
    fn every_cut_and_every_changed_byte_is_noticed() {
        let whole = packed(&example());
        for length in 0..whole.len() {
            assert!(from_bytes(&whole[..length]).is_err(), "cut at {length}");
        }
        for at in 0..whole.len() {
            let mut bytes = whole.clone();
            bytes[at] ^= 0x10;
            assert!(from_bytes(bytes).is_err(), "byte {at}");
        }
    }

    #[test]
    fn false_declarations_are_refused_even_with_a_checksum() {
        let with_json = |json: &str, arrays: &[u8]| {
            let length = (json.len() as u32).to_le_bytes();
            sealed([MAGIC, &VERSION.to_le_bytes()[..], &length, json.as_bytes(), arrays].concat())
        };
        for (json, arrays, said) in [
            (r#"{"header":1,"arrays":[{"name":"a","bytes":9}]}"#, 8, "beyond the end"),
            (r#"{"header":1,"arrays":[{"name":"a","bytes":18446744073709551615}]}"#, 8, "beyond"),
            (r#"{"header":1,"arrays":[{"name":"a","bytes":-1}]}"#, 8, "broken"),
            (r#"{"header":1,"arrays":[{"name":"a","bytes":7}]}"#, 8, "left over"),
            (
                r#"{"header":1,"arrays":[{"name":"a","bytes":4},{"name":"a","bytes":4}]}"#,
                8,
                "twice",
            ),
            (r#"{"header":1}"#, 0, "broken"),
            ("", 0, "broken"),
        ] {
            let found = from_bytes(with_json(json, &vec![0; arrays])).unwrap_err();
            assert!(found.contains(said), "{json}: {found}");
        }
        let huge = [MAGIC, &VERSION.to_le_bytes()[..], &[0xff; 4]].concat();
        assert!(from_bytes(sealed(huge)).unwrap_err().contains("cut short"));
        let newer = [MAGIC, &7_u32.to_le_bytes()[..], &[0; 4]].concat();
        assert!(from_bytes(sealed(newer)).unwrap_err().contains("format 7"));
    }

    #[test]
    fn what_is_no_checkpoint_is_refused_before_it_is_read() {
        let directory = tempfile::tempdir().unwrap();
        let found = read(directory.path(), ENOUGH).unwrap_err();
        assert!(found.what.contains("not a regular file"), "{found}");
        let missing = read(&directory.path().join("none"), ENOUGH).unwrap_err();
        assert!(missing.what.contains("does not exist"), "{missing}");
        let path = directory.path().join("run.ckpt");
        write(&path, &example()).unwrap();
        assert!(read(&path, 10).unwrap_err().what.contains("more than the 10 allowed"));
    }
}
